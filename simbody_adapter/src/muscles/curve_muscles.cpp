// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/curve_muscles.h"

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"

namespace tautline {
namespace {

constexpr double kMostPassiveForce = 10;  ///< of a RigidTendonMuscle
constexpr double kSchutteShape = 0.15, kSchutteSlope = 0.13, kSchutteLengthening = 1.4;
constexpr double kLeastDelpActivation = 0.01;
constexpr double kPushSlope = 0.2;  ///< of Delp's f_V below -V_max: that of his table's first interval

/** Integral over [0, to] by Gauss's rule of three points on panels: of tables, whose pieces are cubic, to some 1e-7. */
template <class Function>
double integrateTo(Function&& f, double from, double to) {
    constexpr int kPanels = 64;
    const double half = 0.5 * (to - from) / kPanels, node = half * std::sqrt(0.6);
    double sum = 0;
    for (int i = 0; i < kPanels; ++i) {
        const double middle = from + (2 * i + 1) * half;
        sum += 8 * f(middle) + 5 * (f(middle - node) + f(middle + node));
    }
    return sum * half / 9;
}

MuscleCurve requireCurve(MuscleCurve curve, const char* what) {
    require(curve != nullptr, what, " is missing");
    return curve;
}

/** Without compliance and dynamics, as a RigidTendonMuscle is. */
CurveMuscleParameters makeRigid(CurveMuscleParameters parameters) {
    parameters.ignoresTendonCompliance = true;
    parameters.ignoresActivationDynamics = true;
    const double velocity = parameters.maxContractionVelocity;
    parameters.timeScale = 1 / velocity;
    return parameters;
}

CurveMuscleParameters adopt(CurveMuscleParameters parameters) {
    parameters.adopt();
    return parameters;
}

/** An undamped fiber without mass and activation would have any velocity. */
CurveMuscleParameters keepActive(CurveMuscleParameters parameters) {
    parameters.minimumActivation = std::max(parameters.minimumActivation, kLeastDelpActivation);
    return parameters;
}

CurveMuscleParameters completeSchutte(CurveMuscleParameters parameters) {
    if (!parameters.passiveForceLength)
        parameters.passiveForceLength = [](double l) { return 1 + calcBoundedExpm1(8 * (l - 1) - 4); };
    return adopt(parameters);
}

}  // namespace

void CurveMuscleParameters::adopt() {
    requirePositive(timeScale, "timeScale");
    requireNotNegative(activation1, "activation1");
    requirePositive(activation2, "activation2");
    requireCurve(activeForceLength, "activeForceLength");
    requireCurve(passiveForceLength, "passiveForceLength");
    maxContractionVelocity = 1 / timeScale;
    validate();
    if (!ignoresTendonCompliance && tendonSlackLength > 0) requireCurve(tendonForceStrain, "tendonForceStrain");
}

double CurveMuscle::calcActiveForceLength(double fiberLength) const {
    return std::max(0.0, m_parameters.activeForceLength(fiberLength));
}

double CurveMuscle::calcPassiveForceLength(double fiberLength) const {
    return std::max(0.0, m_parameters.passiveForceLength(fiberLength));
}

double CurveMuscle::calcTendonForceLength(double tendonLength) const {
    return tendonLength > 1 ? std::max(0.0, m_parameters.tendonForceStrain(tendonLength - 1)) : 0;
}

double CurveMuscle::calcPassiveEnergy(double fiberLength) const {
    return integrateTo([this](double l) { return calcPassiveForceLength(l); }, 0, fiberLength);
}

double CurveMuscle::calcTendonEnergy(double tendonLength) const {
    if (!(tendonLength > 1)) return 0;
    return integrateTo([this](double l) { return calcTendonForceLength(l); }, 1, tendonLength);
}

double CurveMuscle::calcActivationRate(double excitation, double activation) const {
    const double ramp = excitation >= activation ? m_parameters.activation1 * excitation : 0;
    return (excitation - activation) * (ramp + m_parameters.activation2) / m_parameters.timeScale;
}

Schutte1993::Schutte1993(CurveMuscleParameters parameters) : CurveMuscle(completeSchutte(std::move(parameters))) {}

double Schutte1993::calcForceVelocity(double velocity, double) const {
    const double m = kSchutteSlope * kSchutteShape / (1 + kSchutteShape);
    if (velocity <= -1) return 0;
    return velocity <= 0 ? (1 + velocity) / (1 - velocity / kSchutteShape)
                         : (m + kSchutteLengthening * velocity) / (m + velocity);
}

Delp1990::Delp1990(CurveMuscleParameters parameters, MuscleCurve forceVelocity)
    : CurveMuscle(adopt(keepActive(std::move(parameters)))),
      m_forceVelocity(requireCurve(std::move(forceVelocity), "forceVelocity")) {}

double Delp1990::calcForceVelocity(double velocity, double) const {
    return velocity < -1 ? kPushSlope * (velocity + 1) : std::max(0.0, m_forceVelocity(velocity));
}

RigidTendonMuscle::RigidTendonMuscle(CurveMuscleParameters parameters, MuscleCurve forceVelocity)
    : CurveMuscle(adopt(makeRigid(std::move(parameters)))),
      m_forceVelocity(requireCurve(std::move(forceVelocity), "forceVelocity")) {}

double RigidTendonMuscle::calcForceVelocity(double velocity, double) const {
    return std::max(0.0, m_forceVelocity(velocity));
}

double RigidTendonMuscle::calcPassiveForceLength(double fiberLength) const {
    return std::min(CurveMuscle::calcPassiveForceLength(fiberLength), kMostPassiveForce);
}

}  // namespace tautline
