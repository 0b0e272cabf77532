#pragma once
#include "tautline/cylinder.h"
#include "tautline/parametric_twin.h"

namespace tautline {

/** Circular cylinder of infinite length about the z axis of S: angle u from the x axis, height v (thesis
Eqn. 3.67). Helices in closed form; u counts turns. */
class ParametricCylinder final : public ParametricTwin<ParametricCylinder, Cylinder> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit ParametricCylinder(double radius) : ParametricTwin(Cylinder(radius)) {}

    double getRadius() const { return m_twin.getRadius(); }
    ParametricValue calcParametric(const Vec2& uv, int) const {
        const double c = getRadius() * std::cos(uv[0]), s = getRadius() * std::sin(uv[0]);
        return {{c, s, uv[1]}, {-s, c, 0}, Vec3::UnitZ(), {-c, -s, 0}, Vec3::Zero(), Vec3::Zero()};
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int) const { return {std::atan2(p_S.y(), p_S.x()), p_S.z()}; }
    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override {
        GeodesicStart from = start;
        if (!from.point.p.allFinite()) from.point = resolve(start.point);  // given by (u, v) alone
        m_twin.shootGeodesic(from, options, geodesic);
        const double hoop = geodesic.P.t.y() * geodesic.P.N.x() - geodesic.P.t.x() * geodesic.P.N.y();
        geodesic.endPoint.uv = from.point.uv + start.length * Vec2(hoop / getRadius(), geodesic.P.t.z());
    }
};

extern template class ParametricShape<ParametricCylinder>;
extern template class ParametricTwin<ParametricCylinder, Cylinder>;

}  // namespace tautline
