// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/thelen_2003.h"

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr double kToeShape = 3, kToeForce = 0.33;  // Thelen 2003, Eqn. 5
constexpr double kLeastActiveForce = 1e-8;         ///< a f_L below which the velocity is taken as at this [F_0]

/** Of the speeds the share that is there at an activation (Eqn. 6). */
double calcSpeedShare(double activation) {
    return 0.25 + 0.75 * activation;
}

}  // namespace

void Thelen2003Parameters::validate() const {
    MuscleParameters::validate();
    requirePositive(tendonStrain, "tendonStrain");
    requirePositive(passiveStrain, "passiveStrain");
    requirePositive(activeWidth, "activeWidth");
    requirePositive(passiveShape, "passiveShape");
    requirePositive(velocityShape, "velocityShape");
    requireAboveOne(lengtheningForce, "lengtheningForce");
    require(linearThreshold > 1 / lengtheningForce && linearThreshold < 1,
            "linearThreshold must be above 1/lengtheningForce and below 1, but is ", linearThreshold);
}

Thelen2003::Thelen2003(const Thelen2003Parameters& parameters) : m_parameters(parameters) {
    parameters.validate();
    const double e = std::exp(kToeShape);
    m_toeStrain = 99 * e * parameters.tendonStrain / (166 * e - 67);
    m_stiffness = (1 - kToeForce) / (parameters.tendonStrain - m_toeStrain);
}

double Thelen2003::calcActiveForceLength(double fiberLength) const {
    return std::exp(-(fiberLength - 1) * (fiberLength - 1) / m_parameters.activeWidth);
}

double Thelen2003::calcPassiveForceLength(double fiberLength) const {
    if (!(fiberLength > 1)) return 0;
    const double k = m_parameters.passiveShape;
    return calcBoundedExpm1(k * (fiberLength - 1) / m_parameters.passiveStrain) / std::expm1(k);
}

double Thelen2003::calcPassiveEnergy(double fiberLength) const {
    if (!(fiberLength > 1)) return 0;
    const double k = m_parameters.passiveShape, strain = fiberLength - 1, length = m_parameters.passiveStrain / k;
    return (length * calcBoundedExpm1(strain / length) - strain) / std::expm1(k);
}

double Thelen2003::calcTendonForceLength(double tendonLength) const {
    const double strain = tendonLength - 1;
    if (!(strain > 0)) return 0;
    if (strain > m_toeStrain) return kToeForce + m_stiffness * (strain - m_toeStrain);
    return kToeForce * std::expm1(kToeShape * strain / m_toeStrain) / std::expm1(kToeShape);
}

double Thelen2003::calcTendonEnergy(double tendonLength) const {
    const double strain = tendonLength - 1;
    if (!(strain > 0)) return 0;
    const double toe = std::min(strain, m_toeStrain), beyond = strain - toe, length = m_toeStrain / kToeShape;
    const double inToe = kToeForce * (length * std::expm1(toe / length) - toe) / std::expm1(kToeShape);
    return inToe + beyond * (kToeForce + 0.5 * m_stiffness * beyond);
}

double Thelen2003::calcForceVelocity(double velocity, double activation) const {
    const double s = calcSpeedShare(activation), af = m_parameters.velocityShape, flen = m_parameters.lengtheningForce;
    if (velocity < -s) return (velocity + s) / (s * (1 + 1 / af));
    if (velocity <= 0) return (s + velocity) / (s - velocity / af);
    const double k = (2 + 2 / af) / (flen - 1), last = m_parameters.linearThreshold * flen;
    const double lastVelocity = s * (last - 1) / (k * (flen - last));
    if (velocity <= lastVelocity) return (s + velocity * k * flen) / (s + velocity * k);
    return last + (velocity - lastVelocity) * k * (flen - last) * (flen - last) / (s * (flen - 1));
}

double Thelen2003::calcFiberVelocity(double force, double activation, double activeForceLength) const {
    if (m_parameters.fiberDamping > 0) return MuscleModel::calcFiberVelocity(force, activation, activeForceLength);
    const double s = calcSpeedShare(activation), af = m_parameters.velocityShape, flen = m_parameters.lengtheningForce;
    const double f = force / std::max(activation * activeForceLength, kLeastActiveForce);
    const double k = (2 + 2 / af) / (flen - 1), last = m_parameters.linearThreshold * flen;
    double v = 0;
    if (f < 0)
        v = -s + f * s * (1 + 1 / af);
    else if (f <= 1)
        v = s * (f - 1) / (1 + f / af);
    else if (f <= last)
        v = s * (f - 1) / (k * (flen - f));
    else
        v = s * ((last - 1) / (k * (flen - last)) + (f - last) * (flen - 1) / (k * (flen - last) * (flen - last)));
    return std::clamp(v, -kFastest, kFastest);
}

}  // namespace tautline
