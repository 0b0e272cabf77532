// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/cylinder.h"

#include <algorithm>
#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Cylinder>;
template class ParametricShape<ParametricCylinder>;
template class ParametricTwin<ParametricCylinder, Cylinder>;

Cylinder::Cylinder(double radius) : m_radius(radius) {
    requireLength(radius, "cylinder: radius");
}

std::string Cylinder::getDescription() const {
    return describeShape("cylinder(radius=", m_radius, ")");
}

double Cylinder::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    const double rho = p_S.head<2>().norm();
    N_S = rho > 0 ? Vector3(p_S.x() / rho, p_S.y() / rho, 0) : Vector3(Vector3::UnitX());
    return rho - m_radius;
}

SurfacePoint Cylinder::findSurfacePoint(const Vector3& p_S) const {
    Vector3 N;
    calcHeightAndNormal(p_S, N);
    return {Vector3(m_radius * N.x(), m_radius * N.y(), p_S.z())};
}

/** N turns by the part of a displacement that is across the axis, over rho. */
DarbouxFrame Cylinder::calcFrame(const SurfacePoint& point, const Vector3& direction_S) const {
    DarbouxFrame frame;
    const double rho = point.p.head<2>().norm();
    frame.x = point.p, frame.N = Vector3(point.p.x() / rho, point.p.y() / rho, 0);
    frame.t = makeTangent(direction_S, frame.N), frame.B = frame.t.cross(frame.N);
    const Vector2 dN_t = frame.t.head<2>() / rho, dN_B = frame.B.head<2>() / rho;
    frame.kappaN = -frame.t.head<2>().dot(dN_t), frame.tauG = frame.B.head<2>().dot(dN_t);
    frame.kappaB = -frame.B.head<2>().dot(dN_B);
    return frame;
}

void Cylinder::shootGeodesic(const GeodesicStart& start, const ShootingOptions&, ShotGeodesic& geodesic) const {
    geodesic.P = Cylinder::calcFrame(start.point, start.tangent);
    const DarbouxFrame& P = geodesic.P;
    const double hoop = P.t.y() * P.N.x() - P.t.x() * P.N.y();  // of t along the parallel
    const double angle = hoop * start.length / m_radius, c = std::cos(angle), s = std::sin(angle);
    const auto turn = [c, s](const Vector3& v) { return Vector3(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()); };
    geodesic.Q = P;
    geodesic.Q.x = turn(P.x) + P.t.z() * start.length * Vector3::UnitZ();
    geodesic.Q.t = turn(P.t), geodesic.Q.N = turn(P.N), geodesic.Q.B = turn(P.B);
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = geodesic.r = start.length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = P.kappaN;
}

void Cylinder::findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const {
    // D and the axis point nearest it span the common normal of line and axis.
    const double sine2 = e_S.x() * e_S.x() + e_S.y() * e_S.y();
    const bool isAlongAxis = sine2 < 1e-24;
    const double s = isAlongAxis ? 0 : -(A_S.x() * e_S.x() + A_S.y() * e_S.y()) / sine2;
    const Vector3 D = A_S + s * e_S;
    Vector3 N = isAlongAxis ? makeTangent(D, Vector3::UnitZ()) : Vector3(e_S.y(), -e_S.x(), 0).normalized();
    const double side = clearance.N.allFinite() ? N.dot(clearance.N) : N.dot(D);
    if (side < 0) N = -N;
    const Vector3 C(m_radius * N.x(), m_radius * N.y(), D.z());
    // kappa_n along the line vanishes with sine2; 1/size stands in for it then.
    clearance.C = {C}, clearance.N = N, clearance.lineCoordinate = s;
    clearance.distance = (D - C).dot(N), clearance.scale = 1 / m_radius, clearance.found = true;
}

double Cylinder::findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const {
    const double sine2 = e_S.head<2>().squaredNorm();
    return sine2 > 0 ? std::clamp(-A_S.head<2>().dot(e_S.head<2>()) / sine2, 0.0, length) : 0;
}

}  // namespace tautline
