// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/torus.h"

#include <cmath>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<Torus>;
template class ParametricShape<ParametricTorus>;
template class ParametricTwin<ParametricTorus, Torus>;

Torus::Torus(double ringRadius, double tubeRadius) : m_ringRadius(ringRadius), m_tubeRadius(tubeRadius) {
    requireLength(ringRadius, "torus: ring radius");
    requireLength(tubeRadius, "torus: tube radius");
    require(tubeRadius < ringRadius, "torus: tube radius ", tubeRadius, " must be less than the ring radius ",
            ringRadius);
}

std::string Torus::getDescription() const {
    return describeShape("torus(ring radius=", m_ringRadius, ", tube radius=", m_tubeRadius, ")");
}

double Torus::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    const double rho = std::hypot(p_S.x(), p_S.y());
    const Vector3 radial = rho > 0 ? Vector3(p_S.x() / rho, p_S.y() / rho, 0) : Vector3(Vector3::UnitX());
    const Vector3 fromTube = p_S - m_ringRadius * radial;
    const double distance = fromTube.norm();
    N_S = distance > 0 ? Vector3(fromTube / distance) : Vector3(Vector3::UnitZ());
    return distance - m_tubeRadius;
}

}  // namespace tautline
