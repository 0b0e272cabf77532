// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/capsule.h"

#include <algorithm>
#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Capsule>;
template class ParametricShape<ParametricCapsule>;
template class ParametricTwin<ParametricCapsule, Capsule>;

Capsule::Capsule(double radius, double length, double capHeight)
    : m_radius(radius), m_length(length), m_capHeight(capHeight) {
    requireLength(radius, "capsule: radius");
    require(std::isfinite(length) && length >= 0, "capsule: length must be finite and not negative, but is ", length);
    requireLength(capHeight, "capsule: cap height");
}

SurfacePoint Capsule::findSurfacePoint(const Vector3& p_S) const {
    const Vector3 onAxis(0, 0, std::clamp(p_S.z(), -0.5 * m_length, 0.5 * m_length)), q = p_S - onAxis;
    const double b = q.head<2>().squaredNorm() / (m_radius * m_radius), w = q.z() / m_capHeight, a = w * w * w * w;
    if (a < 1 && b < 0.25 * (1 - a)) {
        // About the axis the steepest descent leads out through the tip, however far that is: begin half way to the
        // side.
        const double rho = p_S.head<2>().norm(), half = 0.5 * m_radius * std::sqrt(1 - a);
        const Vector2 outward = rho > 0 ? Vector2(p_S.head<2>() / rho) : Vector2(Vector2::UnitX());
        return ImplicitShape::findSurfacePoint(Vector3(half * outward.x(), half * outward.y(), p_S.z()));
    }
    if (!(b + a > 4)) return ImplicitShape::findSurfacePoint(p_S);
    // onAxis + k q with a k^4 + b k^2 = 1, then the foot of a point that lies on the surface but for rounding
    const double k = std::sqrt(2 / (b + std::sqrt(b * b + 4 * a)));
    return ImplicitShape::findSurfacePoint(onAxis + k * q);
}

std::string Capsule::getDescription() const {
    return describeShape("capsule(radius=", m_radius, ", length=", m_length, ", cap height=", m_capHeight, ")");
}

/** On the side rho = r sqrt(1 - w^4), w = (|v| - L/2)/c; at the tips |z| = L/2 + c (1 - rho^2/r^2)^(1/4). */
ParametricValue ParametricCapsule::calcParametric(const Vector2& uv, int chart) const {
    const double r = getTwin().getRadius(), c = getTwin().getCapHeight(), half = 0.5 * getTwin().getLength();
    if (chart == 0) {
        const double side = uv[1] < 0 ? -1 : 1, w = std::max(std::abs(uv[1]) - half, 0.0) / c, w2 = w * w;
        const double root = std::sqrt(1 - w2 * w2);
        const double rho = r * root, rho1 = -2 * r * side / c * w2 * w / root;
        const double rho2 = -2 * r / (c * c) * w2 * (3 - w2 * w2) / (root * root * root);
        const double cu = std::cos(uv[0]), su = std::sin(uv[0]);
        return {{rho * cu, rho * su, uv[1]}, {-rho * su, rho * cu, 0},   {rho1 * cu, rho1 * su, 1},
                {-rho * cu, -rho * su, 0},   {-rho1 * su, rho1 * cu, 0}, {rho2 * cu, rho2 * su, 0}};
    }
    // In chart 2 u and v change places, so that xu x xv points outward there too.
    const double side = chart == 1 ? 1 : -1, k = 1 / (r * r), q = 1 - k * uv.squaredNorm();
    const double quarter = std::sqrt(std::sqrt(q)), slope = -0.5 * side * c * k * quarter / q;  // dz/dx = slope x
    const double bend = 1.5 * k / q;  // d slope/dx / slope / x
    const double u = uv[0], v = uv[1], z = side * (half + c * quarter);
    const double zuu = slope * (1 + bend * u * u), zuv = slope * bend * u * v, zvv = slope * (1 + bend * v * v);
    if (chart == 1) return {{u, v, z}, {1, 0, slope * u}, {0, 1, slope * v}, {0, 0, zuu}, {0, 0, zuv}, {0, 0, zvv}};
    return {{v, u, z}, {0, 1, slope * u}, {1, 0, slope * v}, {0, 0, zuu}, {0, 0, zuv}, {0, 0, zvv}};
}

/** Kept to where the chart has slopes. */
Vector2 ParametricCapsule::calcNearbyParameters(const Vector3& p_S, int chart) const {
    constexpr double kEdge = 0.95;
    if (chart == 0) {
        const double end = 0.5 * getTwin().getLength() + kEdge * getTwin().getCapHeight();
        return {std::atan2(p_S.y(), p_S.x()), std::clamp(p_S.z(), -end, end)};
    }
    const double rho = p_S.head<2>().norm(), most = kEdge * getTwin().getRadius(), k = rho > most ? most / rho : 1;
    return chart == 1 ? Vector2(k * p_S.x(), k * p_S.y()) : Vector2(k * p_S.y(), k * p_S.x());
}

/** By the distance from the axis: in the middle of a cap either kind of chart will do. */
int ParametricCapsule::chooseChart(const Vector3& p_S, const Vector3& /*t_S*/, int current) const {
    const double rho2 = p_S.head<2>().squaredNorm() / (getTwin().getRadius() * getTwin().getRadius());
    const int tip = p_S.z() < 0 ? 2 : 1;
    if (std::abs(p_S.z()) <= 0.5 * getTwin().getLength() || rho2 > 0.8) return 0;
    if (rho2 < 0.5) return tip;
    return current == 0 ? 0 : tip;
}

}  // namespace tautline
