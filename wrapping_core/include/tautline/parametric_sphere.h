#pragma once
#include "tautline/ellipsoid_charts.h"
#include "tautline/parametric_twin.h"
#include "tautline/sphere.h"

namespace tautline {

/** Sphere in longitude and latitude, three charts (see EllipsoidCharts). Great circles in closed form. */
class ParametricSphere final : public ParametricTwin<ParametricSphere, Sphere> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit ParametricSphere(double radius) : ParametricTwin(Sphere(radius)), m_charts(Vec3::Constant(radius)) {}

    double getRadius() const { return m_twin.getRadius(); }
    ParametricValue calcParametric(const Vec2& uv, int chart) const { return m_charts.calcParametric(uv, chart); }
    ParametricValue calcTurned(const Vec2& uv, int chart) const { return m_charts.calcTurned(uv, chart); }
    Vec2 calcNearbyParameters(const Vec3& p_S, int chart) const { return m_charts.calcNearbyParameters(p_S, chart); }
    int chooseChart(const Vec3& p_S, const Vec3& t_S, int current) const {
        return m_charts.chooseChart(p_S, t_S, current);
    }
    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override {
        GeodesicStart from = start;
        if (!from.point.p.allFinite()) from.point = resolve(start.point);  // given by (u, v) alone
        m_twin.shootGeodesic(from, options, geodesic);
        geodesic.endPoint = calcCoordinates(geodesic.Q.x);
    }

private:
    EllipsoidCharts m_charts;
};

extern template class ParametricShape<ParametricSphere>;
extern template class ParametricTwin<ParametricSphere, Sphere>;

}  // namespace tautline
