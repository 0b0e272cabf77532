// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/half_space.h"

#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<HalfSpace>;
template class ParametricShape<ParametricHalfSpace>;
template class ParametricTwin<ParametricHalfSpace, HalfSpace>;

HalfSpace::HalfSpace(double size) : m_size(size) {
    requireLength(size, "half-space: size");
}

std::string HalfSpace::getDescription() const {
    return describeShape("half-space(size=", m_size, ")");
}

void HalfSpace::shootGeodesic(const GeodesicStart& start, const ShootingOptions&, ShotGeodesic& geodesic) const {
    geodesic.P = geodesic.Q = calcFrame(start.point, start.tangent);
    geodesic.Q.x += start.length * geodesic.P.t;
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = geodesic.r = start.length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = 0;
}

void HalfSpace::findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const {
    clearance.found = false;
    constexpr double kParallel = 1e-15;  // rounding of a unit vector
    if (!(std::abs(e_S.z()) <= kParallel)) return;
    clearance.C = findSurfacePoint(A_S), clearance.N = Vector3::UnitZ(), clearance.lineCoordinate = 0;
    clearance.distance = A_S.z(), clearance.scale = 1 / m_size, clearance.found = true;
}

double HalfSpace::findLowestPoint(const Vector3&, const Vector3& e_S, double length) const {
    return e_S.z() < 0 ? length : 0;
}

}  // namespace tautline
