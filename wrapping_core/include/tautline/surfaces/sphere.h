// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/ellipsoid_charts.h"
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Sphere about the origin of S. Geodesics are great circles, in closed form. */
class Sphere final : public ImplicitShape<Sphere> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit Sphere(double radius);

    double getRadius() const { return m_radius; }
    double getSize() const override { return m_radius; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override;

    /** f = (|p|^2 - r^2)/(2r), so that the gradient is unit on the surface. */
    DiagonalImplicitValue calcImplicit(const Vector3& p) const {
        return {(p.squaredNorm() - m_radius * m_radius) / (2 * m_radius), p / m_radius,
                Vector3::Constant(1 / m_radius)};
    }
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override;
    DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const override;
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override;
    void findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const override;

private:
    double m_radius;
};

extern template class ImplicitShape<Sphere>;

/** Sphere in longitude and latitude, three charts (see EllipsoidCharts). Great circles in closed form. */
class ParametricSphere final : public ParametricTwin<ParametricSphere, Sphere> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit ParametricSphere(double radius) : ParametricTwin(Sphere(radius)), m_charts(Vector3::Constant(radius)) {}

    double getRadius() const { return getTwin().getRadius(); }
    ParametricValue calcParametric(const Vector2& uv, int chart) const { return m_charts.calcParametric(uv, chart); }
    ParametricValue calcTurned(const Vector2& uv, int chart) const { return m_charts.calcTurned(uv, chart); }
    Vector2 calcNearbyParameters(const Vector3& p_S, int chart) const {
        return m_charts.calcNearbyParameters(p_S, chart);
    }
    int chooseChart(const Vector3& p_S, const Vector3& t_S, int current) const {
        return m_charts.chooseChart(p_S, t_S, current);
    }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        GeodesicStart from = start;
        if (!from.point.p.allFinite()) from.point = resolve(start.point);  // given by (u, v) alone
        getTwin().shootGeodesic(from, options, geodesic);
        geodesic.endPoint = calcCoordinates(geodesic.Q.x);
    }

private:
    EllipsoidCharts m_charts;
};

extern template class ParametricShape<ParametricSphere>;
extern template class ParametricTwin<ParametricSphere, Sphere>;

}  // namespace tautline
