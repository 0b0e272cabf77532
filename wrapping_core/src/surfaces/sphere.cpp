// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/sphere.h"

#include <algorithm>
#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Sphere>;
template class ParametricShape<ParametricSphere>;
template class ParametricTwin<ParametricSphere, Sphere>;

Sphere::Sphere(double radius) : m_radius(radius) {
    requireLength(radius, "sphere: radius");
}

std::string Sphere::getDescription() const {
    return describeShape("sphere(radius=", m_radius, ")");
}

double Sphere::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    const double distance = p_S.norm();
    N_S = distance > 0 ? Vector3(p_S / distance) : Vector3(Vector3::UnitX());
    return distance - m_radius;
}

SurfacePoint Sphere::findSurfacePoint(const Vector3& p_S) const {
    Vector3 N;
    calcHeightAndNormal(p_S, N);
    return {m_radius * N};
}

DarbouxFrame Sphere::calcFrame(const SurfacePoint& point, const Vector3& direction_S) const {
    DarbouxFrame frame;
    const double distance = point.p.norm();
    frame.x = point.p, frame.N = point.p / distance;
    frame.t = makeTangent(direction_S, frame.N), frame.B = frame.t.cross(frame.N);
    frame.kappaN = frame.kappaB = -1 / distance, frame.tauG = 0;
    return frame;
}

void Sphere::shootGeodesic(const GeodesicStart& start, const ShootingOptions&, ShotGeodesic& geodesic) const {
    const double angle = start.length / m_radius, c = std::cos(angle), s = std::sin(angle);
    const DarbouxFrame P = Sphere::calcFrame(start.point, start.tangent);
    geodesic.P = geodesic.Q = P;
    geodesic.Q.N = c * P.N + s * P.t;  // B stays: a great circle has no torsion
    geodesic.Q.t = c * P.t - s * P.N;
    geodesic.Q.x = m_radius * geodesic.Q.N;
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = start.length;
    geodesic.a = c, geodesic.aDot = -s / m_radius;
    geodesic.r = m_radius * s, geodesic.rDot = c;
    geodesic.steps = 0, geodesic.converged = true;
    geodesic.hasConjugatePoint = std::abs(angle) >= kPi;
    geodesic.maxKappaN = P.kappaN;
}

void Sphere::findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const {
    const double s = -A_S.dot(e_S);
    const Vector3 D = A_S + s * e_S;  // nearest the center
    Vector3 N = makeTangent(D, e_S);
    if (N.dot(clearance.N) < 0) N = -N;  // of the two critical points, the one on the side that is kept
    clearance.C = {m_radius * N}, clearance.N = N, clearance.lineCoordinate = s;
    clearance.distance = D.dot(N) - m_radius, clearance.scale = 1 / m_radius, clearance.found = true;
}

double Sphere::findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const {
    return std::clamp(-A_S.dot(e_S), 0.0, length);
}

}  // namespace tautline
