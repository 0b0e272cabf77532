// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/thelen_2003_deprecated.h"

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"

namespace tautline {
namespace {

constexpr double kToeShape = 3, kToeForce = 0.333333, kToeShare = 0.609, kLinearSlope = 1.712;
constexpr double kNeverSlack = 0.001;
constexpr double kStraightFrom = 0.95;  ///< of Flen
constexpr double kLeastActiveForce = 1e-8;

}  // namespace

void Thelen2003DeprecatedParameters::validate() const {
    MuscleParameters::validate();
    requirePositive(velocityAtRest, "velocityAtRest");
    requirePositive(tendonStrain, "tendonStrain");
    requirePositive(passiveStrain, "passiveStrain");
    requirePositive(activeWidth, "activeWidth");
    requirePositive(passiveShape, "passiveShape");
    requireNotNegative(damping, "damping");
    requirePositive(velocityShape, "velocityShape");
    requireAboveOne(lengtheningForce, "lengtheningForce");
}

Thelen2003Deprecated::Thelen2003Deprecated(const Thelen2003DeprecatedParameters& parameters)
    : m_parameters(parameters) {
    parameters.validate();
}

double Thelen2003Deprecated::calcActiveForceLength(double fiberLength) const {
    return std::exp(-(fiberLength - 1) * (fiberLength - 1) / m_parameters.activeWidth);
}

double Thelen2003Deprecated::calcPassiveForceLength(double fiberLength) const {
    const double slope = m_parameters.passiveShape / m_parameters.passiveStrain;
    const double beyond = fiberLength - 1 - m_parameters.passiveStrain;
    return beyond > 0 ? 1 + slope * beyond : std::exp(slope * beyond);
}

double Thelen2003Deprecated::calcPassiveEnergy(double fiberLength) const {
    const double slope = m_parameters.passiveShape / m_parameters.passiveStrain;
    const double beyond = fiberLength - 1 - m_parameters.passiveStrain;
    return beyond > 0 ? 1 / slope + beyond * (1 + 0.5 * slope * beyond) : std::exp(slope * beyond) / slope;
}

double Thelen2003Deprecated::calcTendonForceLength(double tendonLength) const {
    const double strain = tendonLength - 1, toe = kToeShare * m_parameters.tendonStrain;
    double force = kNeverSlack * std::max(tendonLength, 0.0);
    if (strain > toe)
        force += kToeForce + kLinearSlope / m_parameters.tendonStrain * (strain - toe);
    else if (strain > 0)
        force += kToeForce * std::expm1(kToeShape * strain / toe) / std::expm1(kToeShape);
    return force;
}

double Thelen2003Deprecated::calcTendonEnergy(double tendonLength) const {
    const double toeStrain = kToeShare * m_parameters.tendonStrain, length = toeStrain / kToeShape;
    const double strain = std::max(tendonLength - 1, 0.0), toe = std::min(strain, toeStrain), beyond = strain - toe;
    const double l = std::max(tendonLength, 0.0);
    return 0.5 * kNeverSlack * (l * l - 1) +
           kToeForce * (length * std::expm1(toe / length) - toe) / std::expm1(kToeShape) +
           beyond * (kToeForce + 0.5 * kLinearSlope / m_parameters.tendonStrain * beyond);
}

double Thelen2003Deprecated::calcSpeedShare(double activation) const {
    const double v0 = m_parameters.velocityAtRest, vmax = m_parameters.maxContractionVelocity;
    return (v0 + activation * (vmax - v0)) / vmax;
}

double Thelen2003Deprecated::calcForceVelocity(double velocity, double activation) const {
    const double v = velocity / calcSpeedShare(activation), af = m_parameters.velocityShape;
    const double flen = m_parameters.lengtheningForce, k = (2 + 2 / af) / (flen - 1);
    if (v <= -1) return 0;
    return v <= 0 ? (1 + v) / (1 - v / af) : (1 + v * k * flen) / (1 + v * k);
}

/** Thelen 2003, Eqns. 6 and 7, with the damping in the denominator. @param peak   a f_L, at which v = 0 */
double Thelen2003Deprecated::calcHillVelocity(double force, double peak) const {
    const double af = m_parameters.velocityShape, flen = m_parameters.lengtheningForce;
    const double b = force <= peak ? peak + force / af : (2 + 2 / af) * (peak * flen - force) / (flen - 1);
    return (force - peak) / (b + m_parameters.damping);
}

double Thelen2003Deprecated::calcFiberVelocity(double force, double activation, double activeForceLength) const {
    const double peak = std::max(activation * activeForceLength, kLeastActiveForce);
    const double last = kStraightFrom * peak * m_parameters.lengtheningForce;
    const double from = std::clamp(force, 0.0, last);
    double v = calcHillVelocity(from, peak);
    if (force != from) {  // on straight, with the slope there; OpenSim takes it from a difference over 1e-6
        const double af = m_parameters.velocityShape, flen = m_parameters.lengtheningForce;
        const bool isShortening = force < 0;
        const double b = isShortening ? peak : (2 + 2 / af) * (peak * flen - from) / (flen - 1);
        const double slopeOfB = isShortening ? 1 / af : -(2 + 2 / af) / (flen - 1);
        const double c = b + m_parameters.damping;
        v += (force - from) * (c - (from - peak) * slopeOfB) / (c * c);
    }
    return std::clamp(v * calcSpeedShare(activation), -kFastest, kFastest);
}

double Thelen2003Deprecated::calcActivationRate(double excitation, double activation) const {
    const double difference = excitation - activation;
    return difference / (difference >= 0 ? m_parameters.activationTime : m_parameters.deactivationTime);
}

}  // namespace tautline
