#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** Circular cylinder of infinite length about the z axis of S. Geodesics are helices, in closed form. */
class Cylinder final : public ImplicitShape<Cylinder> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit Cylinder(double radius);

    double getRadius() const { return m_radius; }
    double getSize() const override { return m_radius; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override;

    /** f = (x^2 + y^2 - r^2)/(2r), so that the gradient is unit on the surface. */
    DiagonalImplicitValue calcImplicit(const Vec3& p) const {
        const Vec3 hessian(1 / m_radius, 1 / m_radius, 0);
        return {(p.x() * p.x() + p.y() * p.y() - m_radius * m_radius) / (2 * m_radius), hessian.cwiseProduct(p),
                hessian};
    }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override;
    SurfacePoint findSurfacePoint(const Vec3& p_S) const override;
    DarbouxFrame calcFrame(const SurfacePoint& point, const Vec3& direction_S) const override;
    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override;
    void findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const override;

private:
    double m_radius;
};

extern template class ImplicitShape<Cylinder>;

}  // namespace tautline
