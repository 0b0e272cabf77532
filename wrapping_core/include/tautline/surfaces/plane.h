// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

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

    DiagonalImplicitValue calcImplicit(const Vec3& p) const { return {p.z(), Vec3::UnitZ(), Vec3::Zero()}; }
    double calcHeightAndNormal(const Vec3& p_S, Vec3& N_S) const override {
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

extern template class ImplicitShape<Plane>;

/** The same plane with u = x, v = y. */
class ParametricPlane final : public ParametricTwin<ParametricPlane, Plane> {
public:
    explicit ParametricPlane(double size) : ParametricTwin(Plane(size)) {}

    ParametricValue calcParametric(const Vec2& uv, int) const {
        return {{uv[0], uv[1], 0}, Vec3::UnitX(), Vec3::UnitY(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int) const { return p_S.head<2>(); }
    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override {
        getTwin().shootGeodesic({resolve(start.point), start.tangent, start.length}, options, geodesic);
        geodesic.endPoint = calcCoordinates(geodesic.Q.x);
    }
};

extern template class ParametricShape<ParametricPlane>;
extern template class ParametricTwin<ParametricPlane, Plane>;

}  // namespace tautline
