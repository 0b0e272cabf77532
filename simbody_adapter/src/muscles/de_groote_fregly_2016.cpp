// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/de_groote_fregly_2016.h"

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"

namespace tautline {
namespace {

/** One of the three bells of f_L. */
struct Bell {
    double b1, b2, b3, b4;
};
constexpr Bell kBells[] = {{0.8150671134243542, 1.055033428970575, 0.162384573599574, 0.063303448465465},
                           {0.433004984392647, 0.716775413397760, -0.029947116970696, 0.200356847296188},
                           {0.1, 1.0, 0.353553390593274, 0.0}};
constexpr double kD1 = -0.3211346127989808, kD2 = -8.149, kD3 = -0.374, kD4 = 0.8825327733249912;
constexpr double kPassiveShape = 4, kMinFiberLength = 0.2;
constexpr double kTendonScale = 0.2;  // c1 = c3
constexpr double kTanhSteepness = 0.1;
constexpr double kLeastActiveForce = 1e-8;  ///< a f_L below which the velocity is taken as at this [F_0]

}  // namespace

void DeGrooteFregly2016Parameters::validate() const {
    MuscleParameters::validate();
    require(std::isfinite(activeForceWidthScale) && activeForceWidthScale >= 1,
            "activeForceWidthScale must be finite and at least 1, but is ", activeForceWidthScale);
    requirePositive(passiveFiberStrain, "passiveFiberStrain");
    requirePositive(tendonStrain, "tendonStrain");
}

DeGrooteFregly2016::DeGrooteFregly2016(const DeGrooteFregly2016Parameters& parameters) : m_parameters(parameters) {
    parameters.validate();
    m_tendonShape = std::log((1 + kTendonScale) / kTendonScale) / parameters.tendonStrain;
    m_passiveOffset = std::expm1(kPassiveShape * (kMinFiberLength - 1) / parameters.passiveFiberStrain);
}

double DeGrooteFregly2016::calcActiveForceLength(double fiberLength) const {
    const double x = (fiberLength - 1) / m_parameters.activeForceWidthScale + 1;
    double sum = 0;
    for (const Bell& bell : kBells) {
        const double deviation = (x - bell.b2) / (bell.b3 + bell.b4 * x);
        sum += bell.b1 * std::exp(-0.5 * deviation * deviation);
    }
    return sum;
}

double DeGrooteFregly2016::calcPassiveForceLength(double fiberLength) const {
    if (m_parameters.ignoresPassiveFiberForce || fiberLength <= kMinFiberLength) return 0;
    const double exponent = kPassiveShape * (fiberLength - 1) / m_parameters.passiveFiberStrain;
    return (calcBoundedExpm1(exponent) - m_passiveOffset) / (std::expm1(kPassiveShape) - m_passiveOffset);
}

double DeGrooteFregly2016::calcPassiveEnergy(double fiberLength) const {
    if (m_parameters.ignoresPassiveFiberForce || fiberLength <= kMinFiberLength) return 0;
    const double length = m_parameters.passiveFiberStrain / kPassiveShape;
    const double grown = calcBoundedExpm1((fiberLength - 1) / length) - m_passiveOffset;
    const double base = (1 + m_passiveOffset) * (fiberLength - kMinFiberLength);
    return (length * grown - base) / (std::expm1(kPassiveShape) - m_passiveOffset);
}

double DeGrooteFregly2016::calcTendonForceLength(double tendonLength) const {
    return tendonLength > 1 ? kTendonScale * calcBoundedExpm1(m_tendonShape * (tendonLength - 1)) : 0;
}

double DeGrooteFregly2016::calcTendonEnergy(double tendonLength) const {
    if (!(tendonLength > 1)) return 0;
    const double strain = tendonLength - 1;
    return kTendonScale * (calcBoundedExpm1(m_tendonShape * strain) / m_tendonShape - strain);
}

double DeGrooteFregly2016::calcForceVelocity(double velocity, double) const {
    return kD1 * std::asinh(kD2 * velocity + kD3) + kD4;
}

double DeGrooteFregly2016::calcFiberVelocity(double force, double activation, double activeForceLength) const {
    if (m_parameters.fiberDamping > 0) return MuscleModel::calcFiberVelocity(force, activation, activeForceLength);
    const double f = force / std::max(activation * activeForceLength, kLeastActiveForce);
    const double argument = std::clamp((f - kD4) / kD1, -100.0, 100.0);  // far beyond kFastest
    return std::clamp((std::sinh(argument) - kD3) / kD2, -kFastest, kFastest);
}

double DeGrooteFregly2016::calcActivationRate(double excitation, double activation) const {
    const double z = 0.5 + 1.5 * activation, difference = excitation - activation;
    const double f = 0.5 * std::tanh(kTanhSteepness * difference);
    return difference * ((0.5 + f) / (m_parameters.activationTime * z) + (0.5 - f) * z / m_parameters.deactivationTime);
}

double DeGrooteFregly2016::calcMinimumFiberLength() const {
    return std::max(kMinFiberLength, MuscleModel::calcMinimumFiberLength());
}

}  // namespace tautline
