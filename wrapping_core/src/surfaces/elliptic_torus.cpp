// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/elliptic_torus.h"

#include <algorithm>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<EllipticTorus>;
template class ParametricShape<ParametricEllipticTorus>;
template class ParametricTwin<ParametricEllipticTorus, EllipticTorus>;

EllipticTorus::EllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis)
    : m_ringRadius(ringRadius),
      m_radial(radialSemiAxis),
      m_axial(axialSemiAxis),
      m_size(std::min(radialSemiAxis, axialSemiAxis)) {
    requireLength(ringRadius, "elliptic torus: ring radius");
    requireLength(radialSemiAxis, "elliptic torus: radial semi-axis");
    requireLength(axialSemiAxis, "elliptic torus: axial semi-axis");
    require(radialSemiAxis < ringRadius, "elliptic torus: radial semi-axis ", radialSemiAxis,
            " must be less than the ring radius ", ringRadius);
}

std::string EllipticTorus::getDescription() const {
    return describeShape("elliptic torus(ring radius=", m_ringRadius, ", radial semi-axis=", m_radial,
                         ", axial semi-axis=", m_axial, ")");
}

}  // namespace tautline
