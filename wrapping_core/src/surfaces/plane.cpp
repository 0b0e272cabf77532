// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/plane.h"

#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Plane>;
template class ParametricShape<ParametricPlane>;
template class ParametricTwin<ParametricPlane, Plane>;

Plane::Plane(double size) : m_size(size) {
    requireLength(size, "plane: size");
}

std::string Plane::getDescription() const {
    return describeShape("plane(size=", m_size, ")");
}

void Plane::shootGeodesic(const GeodesicStart& start, const GeodesicOptions&, Geodesic& geodesic) const {
    geodesic.P = geodesic.Q = calcFrame(start.point, start.tangent);
    geodesic.Q.x += start.length * geodesic.P.t;
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = geodesic.r = start.length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = 0;
}

void Plane::findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const {
    clearance.found = false;
    constexpr double kParallel = 1e-15;  // rounding of a unit vector
    if (!(std::abs(e_S.z()) <= kParallel)) return;
    clearance.C = findSurfacePoint(A_S), clearance.N = Vec3::UnitZ(), clearance.lineCoordinate = 0;
    clearance.distance = A_S.z(), clearance.scale = 1 / m_size, clearance.found = true;
}

double Plane::findLowestPoint(const Vec3&, const Vec3& e_S, double length) const {
    return e_S.z() < 0 ? length : 0;
}

}  // namespace tautline
