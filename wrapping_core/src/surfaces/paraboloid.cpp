// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/paraboloid.h"

#include <algorithm>
#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Paraboloid>;
template class ParametricShape<ParametricParaboloid>;
template class ParametricTwin<ParametricParaboloid, Paraboloid>;

Paraboloid::Paraboloid(double A, double B) : m_A(A), m_B(B) {
    requireLength(A, "paraboloid: A");
    requireLength(B, "paraboloid: B");
}

std::string Paraboloid::getDescription() const {
    return describeShape("paraboloid(A=", m_A, ", B=", m_B, ")");
}

/** The minimum of the quadratic f along the line, or the lower end of a line along the axis. */
double Paraboloid::findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const {
    const double quadratic = e_S.x() * e_S.x() / m_A + e_S.y() * e_S.y() / m_B;
    const double linear = 2 * (A_S.x() * e_S.x() / m_A + A_S.y() * e_S.y() / m_B) - e_S.z();
    const double lowest = -linear / (2 * quadratic);
    if (std::isfinite(lowest)) return std::clamp(lowest, 0.0, length);
    return linear < 0 ? length : 0;
}

}  // namespace tautline
