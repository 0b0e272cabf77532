// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/cone.h"

#include <algorithm>
#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Cone>;
template class ParametricShape<ParametricCone>;
template class ParametricTwin<ParametricCone, Cone>;

Cone::Cone(double halfAngle, double radius, double edgeRadius)
    : m_halfAngle(halfAngle),
      m_radius(radius),
      m_edgeRadius(edgeRadius),
      m_sine(std::sin(halfAngle)),
      m_cosine(std::cos(halfAngle)) {
    require(halfAngle > 0 && halfAngle < 0.5 * kPi, "cone: half angle must be between 0 and pi/2, but is ", halfAngle);
    requireLength(radius, "cone: radius");
    require(edgeRadius >= 0 && edgeRadius < radius, "cone: edge radius must be in [0, ", radius, "), but is ",
            edgeRadius);
}

std::string Cone::getDescription() const {
    return describeShape("cone(half angle=", m_halfAngle, ", radius=", m_radius, ", edge radius=", m_edgeRadius, ")");
}

double Cone::calcDomainMargin(const SurfacePoint& point) const {
    constexpr double kApex = 1e-6;  // in radii: closer, curvature is beyond use
    const double margin = std::hypot(point.p.x(), point.p.y()) - std::max(m_edgeRadius, kApex * m_radius);
    return point.p.z() > 0 ? margin : std::min(margin, point.p.z() - kApex * m_radius);
}

/** The nearest point; beside the apex where that is nearest. */
SurfacePoint Cone::findSurfacePoint(const Vector3& p_S) const {
    constexpr double kBesideApex = 1e-9;  // in radii: has a normal, and is out of the domain
    const double rho = std::hypot(p_S.x(), p_S.y());
    const Vector3 radial = rho > 0 ? Vector3(p_S.x() / rho, p_S.y() / rho, 0) : Vector3(Vector3::UnitX());
    const double fromApex = std::max(rho * m_sine + p_S.z() * m_cosine, kBesideApex * m_radius);
    return {fromApex * (m_sine * radial + m_cosine * Vector3::UnitZ())};
}

/** On the unrolled cone, with polar coordinates (distance from the apex, angle about it = turning about the
axis times sin(alpha)), the geodesic is straight: m0 + s cos(psi) along the start's ray, s sin(psi) across. */
void Cone::shootGeodesic(const GeodesicStart& start, const ShootingOptions&, ShotGeodesic& geodesic) const {
    const DarbouxFrame P = calcFrame(start.point, start.tangent);
    const double rho = std::hypot(P.x.x(), P.x.y()), m0 = P.x.norm(), length = start.length;
    const Vector3 radial(P.x.x() / rho, P.x.y() / rho, 0), hoop(-radial.y(), radial.x(), 0);
    const Vector3 ray = m_sine * radial + m_cosine * Vector3::UnitZ();
    const double along = P.t.dot(ray), across = P.t.dot(hoop);
    const double x = m0 + length * along, y = length * across, m1 = std::hypot(x, y);
    const double unrolled = std::atan2(y, x), turn = unrolled / m_sine;
    const Vector3 endRadial = std::cos(turn) * radial + std::sin(turn) * hoop;
    const Vector3 endHoop = std::cos(turn) * hoop - std::sin(turn) * radial;
    const Vector3 endRay = m_sine * endRadial + m_cosine * Vector3::UnitZ();
    const double c = std::cos(unrolled), s = std::sin(unrolled);
    geodesic.P = P;
    geodesic.endPoint = {m1 * endRay};
    geodesic.Q = calcFrame(geodesic.endPoint, (c * along + s * across) * endRay + (c * across - s * along) * endHoop);
    geodesic.length = geodesic.r = length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = std::max(P.kappaN, geodesic.Q.kappaN);
}

}  // namespace tautline
