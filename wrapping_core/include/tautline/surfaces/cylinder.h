// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

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
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override;

    /** f = (x^2 + y^2 - r^2)/(2r), so that the gradient is unit on the surface. */
    DiagonalImplicitValue calcImplicit(const Vector3& p) const {
        const Vector3 hessian(1 / m_radius, 1 / m_radius, 0);
        return {(p.x() * p.x() + p.y() * p.y() - m_radius * m_radius) / (2 * m_radius), hessian.cwiseProduct(p),
                hessian};
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

extern template class ImplicitShape<Cylinder>;

/** Circular cylinder of infinite length about the z axis of S: angle u from the x axis, height v (thesis
Eqn. 3.67). Helices in closed form; u counts turns. */
class ParametricCylinder final : public ParametricTwin<ParametricCylinder, Cylinder> {
public:
    /** @param radius   [m], positive; InvalidInput otherwise */
    explicit ParametricCylinder(double radius) : ParametricTwin(Cylinder(radius)) {}

    double getRadius() const { return getTwin().getRadius(); }
    ParametricValue calcParametric(const Vector2& uv, int) const {
        const double c = getRadius() * std::cos(uv[0]), s = getRadius() * std::sin(uv[0]);
        return {{c, s, uv[1]}, {-s, c, 0}, Vector3::UnitZ(), {-c, -s, 0}, Vector3::Zero(), Vector3::Zero()};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const { return {std::atan2(p_S.y(), p_S.x()), p_S.z()}; }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        GeodesicStart from = start;
        if (!from.point.p.allFinite()) from.point = resolve(start.point);  // given by (u, v) alone
        getTwin().shootGeodesic(from, options, geodesic);
        const double hoop = geodesic.P.t.y() * geodesic.P.N.x() - geodesic.P.t.x() * geodesic.P.N.y();
        geodesic.endPoint.uv = from.point.uv + start.length * Vector2(hoop / getRadius(), geodesic.P.t.z());
    }
};

extern template class ParametricShape<ParametricCylinder>;
extern template class ParametricTwin<ParametricCylinder, Cylinder>;

}  // namespace tautline
