// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Circular cone about the z axis of S, apex at the origin, opening along +z without end. It is developable:
geodesics are straight lines on the unrolled cone, in closed form. The apex is not part of the domain. */
class Cone final : public ImplicitShape<Cone> {
public:
    /** @param halfAngle    between axis and surface [rad], in (0, pi/2); InvalidInput otherwise
    @param radius       a typical distance of the path from the axis [m], positive: the surface's size
    @param edgeRadius   of the circle where the domain begins [m], in [0, radius) */
    Cone(double halfAngle, double radius, double edgeRadius = 0);

    double getHalfAngle() const { return m_halfAngle; }
    double getSize() const override { return m_radius; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    double calcDomainMargin(const SurfacePoint& point) const override;

    /** f = rho cos(alpha) - z sin(alpha), rho the distance from the axis: the distance itself where the foot is
    on the cone, positive below the apex. On the axis the gradient is that of a point beside it. */
    ImplicitValue calcImplicit(const Vector3& p) const {
        const double tiny = 1e-12 * m_radius, rhoTrue = std::sqrt(p.x() * p.x() + p.y() * p.y());
        const Vector3 radial =
            rhoTrue > tiny ? Vector3(p.x() / rhoTrue, p.y() / rhoTrue, 0) : Vector3(Vector3::UnitX());
        const double h = m_cosine / std::max(rhoTrue, tiny);
        const double xx = radial.x() * radial.x(), xy = radial.x() * radial.y(), yy = radial.y() * radial.y();
        ImplicitValue value;
        value.f = rhoTrue * m_cosine - p.z() * m_sine;
        value.gradient = Vector3(m_cosine * radial.x(), m_cosine * radial.y(), -m_sine);
        value.hessian << h * yy, -h * xy, 0, -h * xy, h * xx, 0, 0, 0, 0;
        return value;
    }
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override;
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override;

private:
    double m_halfAngle, m_radius, m_edgeRadius, m_sine, m_cosine;
};

extern template class ImplicitShape<Cone>;

/** The same cone: v (sin(alpha) cos u, sin(alpha) sin u, cos(alpha)), v the distance from the apex; u counts turns. */
class ParametricCone final : public ParametricTwin<ParametricCone, Cone> {
public:
    ParametricCone(double halfAngle, double radius, double edgeRadius = 0)
        : ParametricTwin(Cone(halfAngle, radius, edgeRadius)),
          m_sine(std::sin(halfAngle)),
          m_cosine(std::cos(halfAngle)) {}

    double getNormalSign() const { return 1; }
    ParametricValue calcParametric(const Vector2& uv, int) const {
        const double c = m_sine * std::cos(uv[0]), s = m_sine * std::sin(uv[0]), v = uv[1];
        return {{v * c, v * s, v * m_cosine}, {-v * s, v * c, 0}, {c, s, m_cosine},
                {-v * c, -v * s, 0},          {-s, c, 0},         Vector3::Zero()};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const {
        return {std::atan2(p_S.y(), p_S.x()), p_S.head<2>().norm() * m_sine + p_S.z() * m_cosine};
    }

private:
    double m_sine, m_cosine;
};

extern template class ParametricShape<ParametricCone>;
extern template class ParametricTwin<ParametricCone, Cone>;

}  // namespace tautline
