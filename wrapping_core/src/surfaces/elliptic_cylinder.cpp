// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/elliptic_cylinder.h"

#include <algorithm>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<EllipticCylinder>;
template class ParametricShape<ParametricEllipticCylinder>;
template class ParametricTwin<ParametricEllipticCylinder, EllipticCylinder>;

EllipticCylinder::EllipticCylinder(double semiAxisX, double semiAxisY)
    : CentralQuadric({1 / (semiAxisX * semiAxisX), 1 / (semiAxisY * semiAxisY), 0}, std::min(semiAxisX, semiAxisY)),
      m_semiAxes(semiAxisX, semiAxisY) {
    requireLength(semiAxisX, "elliptic cylinder: semi-axis x");
    requireLength(semiAxisY, "elliptic cylinder: semi-axis y");
}

std::string EllipticCylinder::getDescription() const {
    return describeShape("elliptic cylinder(semi-axes=", m_semiAxes.x(), ", ", m_semiAxes.y(), ")");
}

}  // namespace tautline
