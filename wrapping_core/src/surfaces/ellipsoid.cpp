// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/ellipsoid.h"

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Ellipsoid>;
template class ParametricShape<ParametricEllipsoid>;
template class ParametricTwin<ParametricEllipsoid, Ellipsoid>;

Ellipsoid::Ellipsoid(const Vector3& semiAxes)
    : CentralQuadric(semiAxes.cwiseProduct(semiAxes).cwiseInverse(), semiAxes.minCoeff()), m_semiAxes(semiAxes) {
    requireLength(semiAxes.x(), "ellipsoid: semi-axis x");
    requireLength(semiAxes.y(), "ellipsoid: semi-axis y");
    requireLength(semiAxes.z(), "ellipsoid: semi-axis z");
}

std::string Ellipsoid::getDescription() const {
    return describeShape("ellipsoid(semi-axes=", m_semiAxes.x(), ", ", m_semiAxes.y(), ", ", m_semiAxes.z(), ")");
}

}  // namespace tautline
