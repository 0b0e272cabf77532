#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** The plane z = 0 of S, N = +z. Geodesics are straight. A taut string never presses on a plane, so an obstacle
of this shape only reports whether the path stays above it. */
class Plane final : public ImplicitShape<Plane> {
public:
    /** @param size   scale of lengths near the plane [m], positive; InvalidInput otherwise */
    explicit Plane(double size);

    double getSize() const override { return m_size; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }

    ImplicitValue calcImplicit(const Vec3& p) const { return {p.z(), Vec3::UnitZ(), Mat3::Zero()}; }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override {
        N_S = Vec3::UnitZ();
        return p_S.z();
    }
    SurfacePoint findSurfacePoint(const Vec3& p_S) const override { return {Vec3(p_S.x(), p_S.y(), 0)}; }
    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override;
    /** Only a line parallel to the plane has critical points: all of its points are. */
    void findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const override;
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override;

private:
    double m_size;
};

}  // namespace tautline
