// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/muscle_model.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "parameter_checks.h"
#include "root_in_bracket.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr double kHalfPi = 1.5707963267948966;
constexpr double kAngleRounding = 1e-6;  ///< of pi/2 in files [rad]
constexpr double kLeastCosine = 0.01;    ///< of a pennation that is not given so steep at the optimal length
constexpr double kStartStretch = 1.01;   ///< of the tendon, where the search for an equilibrium begins
constexpr double kScanStep = 0.02;       ///< of that search [l_0]; equilibria closer together count as one
constexpr double kMostScanSteps = 500;   ///< then the steps get longer
constexpr double kSlackRounding = 1e-9;  ///< [l_S]: by so much a rigid tendon may be short and yet be taut

double square(double x) {
    return x * x;
}

/** A fiber that creeps, in search of where it and its tendon pull alike. */
class FiberWalk {
public:
    /** @param calcExcessPull   of a fiber length [m] @param step   of the search [m] */
    FiberWalk(std::function<double(double)> calcExcessPull, double from, double step)
        : m_calcExcessPull(std::move(calcExcessPull)), m_step(step), m_length(from), m_excess(m_calcExcessPull(from)) {}

    double getLength() const { return m_length; }
    double getExcessPull() const { return m_excess; }

    /** Goes to `to`, or only to the first change of sign on the way there. @return whether there was one */
    bool settle(double to) {
        const double from = m_length, steps = std::ceil(std::abs(to - from) / m_step);
        const int numSteps = static_cast<int>(std::clamp(steps, 1.0, kMostScanSteps));
        for (int i = 1; i <= numSteps; ++i)
            if (step(i == numSteps ? to : from + (to - from) * i / numSteps)) return true;
        return false;
    }

private:
    bool step(double to) {
        const double excess = m_calcExcessPull(to);
        const bool changes = (excess > 0) != (m_excess > 0);
        m_length = changes ? findRootInBracket(m_calcExcessPull, m_length, m_excess, to, excess) : to;
        m_excess = changes ? 0 : excess;
        return changes;
    }

    std::function<double(double)> m_calcExcessPull;
    double m_step, m_length, m_excess;
};

}  // namespace

void MuscleParameters::validate() const {
    requirePositive(maxIsometricForce, "maxIsometricForce");
    requirePositive(optimalFiberLength, "optimalFiberLength");
    requireNotNegative(tendonSlackLength, "tendonSlackLength");
    require(pennationAtOptimal >= 0 && pennationAtOptimal < kHalfPi, "pennationAtOptimal must be in [0, pi/2), but is ",
            pennationAtOptimal);
    requirePositive(maxContractionVelocity, "maxContractionVelocity");
    require(maximumPennation >= 0 && maximumPennation <= kHalfPi + kAngleRounding,
            "maximumPennation must be in [0, pi/2], but is ", maximumPennation);
    requirePositive(activationTime, "activationTime");
    requirePositive(deactivationTime, "deactivationTime");
    require(minimumActivation >= 0 && minimumActivation < 1, "minimumActivation must be in [0, 1), but is ",
            minimumActivation);
    requireFraction(defaultActivation, "defaultActivation");
    requireFraction(defaultExcitation, "defaultExcitation");
    requireNotNegative(fiberDamping, "fiberDamping");
}

std::string getName(EquilibriumStatus status) {
    return status == EquilibriumStatus::Found ? "equilibrium" : "fiber at its lower bound";
}

double MuscleLengths::calcPennation() const {
    return std::atan2(sinPennation, cosPennation);
}

double MuscleModel::calcActivationRate(double excitation, double activation) const {
    const MuscleParameters& p = getParameters();
    const double scale = 0.5 + 1.5 * activation;
    const double time = excitation > activation ? p.activationTime * scale : p.deactivationTime / scale;
    return (excitation - activation) / time;
}

double MuscleModel::calcMinimumFiberLength() const {
    const double height = std::sin(getParameters().pennationAtOptimal);
    return height > 0 ? height / calcSteepestSine() : 0;
}

/** Of the maximal pennation, which leaves the fiber a share of its force along the tendon. */
double MuscleModel::calcSteepestSine() const {
    const MuscleParameters& p = getParameters();
    return std::sin(std::max(std::min(p.maximumPennation, kHalfPi - kLeastCosine), p.pennationAtOptimal));
}

bool MuscleModel::hasRigidTendon() const {
    return getParameters().ignoresTendonCompliance || getParameters().tendonSlackLength == 0;
}

double MuscleModel::clampActivation(double activation) const {
    return std::clamp(activation, getParameters().minimumActivation, 1.0);
}

double MuscleModel::calcFiberVelocity(double force, double activation, double activeForceLength) const {
    const double damping = getParameters().fiberDamping;
    const auto calcExcess = [&](double v) {
        return activation * activeForceLength * calcForceVelocity(v, activation) + damping * v - force;
    };
    const double atRest = calcExcess(0);
    if (atRest == 0) return 0;
    const double direction = atRest > 0 ? -1 : 1;
    double inside = 0, insideExcess = atRest;
    for (double v = direction; std::abs(v) <= kFastest; v *= 4) {
        const double excess = calcExcess(v);
        if ((excess > 0) != (atRest > 0)) return findRootInBracket(calcExcess, inside, insideExcess, v, excess);
        inside = v, insideExcess = excess;
    }
    return direction * kFastest;
}

MuscleLengths MuscleModel::calcLengths(double pathLength, double fiberLength) const {
    const MuscleParameters& p = getParameters();
    const double height = std::sin(p.pennationAtOptimal), shortest = calcMinimumFiberLength();
    MuscleLengths lengths;
    double l = std::max(fiberLength / p.optimalFiberLength, shortest);
    if (hasRigidTendon()) {
        const double along = (pathLength - p.tendonSlackLength) / p.optimalFiberLength;
        l = std::max(std::hypot(std::max(along, 0.0), height), shortest);
    }
    if (height > 0) lengths.sinPennation = std::min(height / l, calcSteepestSine());
    lengths.cosPennation = std::sqrt(1 - square(lengths.sinPennation));
    lengths.normFiberLength = l;
    lengths.fiberLength = l * p.optimalFiberLength;
    lengths.tendonLength = pathLength - lengths.fiberLength * lengths.cosPennation;
    return lengths;
}

MuscleDynamics MuscleModel::calcDynamics(double pathLength, double pathRate, double activation,
                                         double fiberLength) const {
    const MuscleParameters& p = getParameters();
    MuscleDynamics d;
    d.lengths = calcLengths(pathLength, fiberLength);
    d.activation = clampActivation(activation);
    if (hasRigidTendon())
        calcRigid(pathRate, d);
    else
        calcCompliant(fiberLength, d);
    d.fiberVelocity = d.normFiberVelocity * p.maxContractionVelocity * p.optimalFiberLength;
    d.tendonVelocity = pathRate - d.fiberVelocity / d.lengths.cosPennation;
    d.fiberActivePower = -d.activeFiberForce * d.fiberVelocity;
    d.fiberPassivePower = -d.passiveFiberForce * d.fiberVelocity;
    d.fiberDampingPower = -d.dampingFiberForce * d.fiberVelocity;
    d.tendonPower = -d.tendonForce * d.tendonVelocity;
    d.musclePower = -d.tendonForce * pathRate;
    return d;
}

/** The tendon's stretch gives its force, that the sum of those of the fiber, and what of it is left for the active and
the damping part the velocity (Millard et al. 2013, J. Biomech. Eng. 135:021005, Eqns. 6 to 8). */
void MuscleModel::calcCompliant(double fiberLength, MuscleDynamics& d) const {
    const MuscleParameters& p = getParameters();
    const double tendonLength = d.lengths.tendonLength / p.tendonSlackLength;
    const double tendonForce = calcTendonForceLength(tendonLength);
    const double fiberForce = tendonForce / d.lengths.cosPennation;
    const double passive = calcPassiveForceLength(d.lengths.normFiberLength);
    const double active = calcActiveForceLength(d.lengths.normFiberLength);
    d.normFiberVelocity = calcFiberVelocity(fiberForce - passive, d.activation, active);
    const double shortest = calcMinimumFiberLength() * p.optimalFiberLength;
    d.isFiberAtLimit = fiberLength <= shortest && d.normFiberVelocity <= 0;
    if (d.isFiberAtLimit) d.normFiberVelocity = 0;
    const double damping = p.fiberDamping * d.normFiberVelocity;
    d.tendonForce = p.maxIsometricForce * tendonForce;
    d.passiveFiberForce = p.maxIsometricForce * passive;
    d.dampingFiberForce = p.maxIsometricForce * damping;
    d.activeFiberForce = p.maxIsometricForce * (fiberForce - passive - damping);
}

/** The path gives the fiber's length and velocity. A fiber that is shortened fast would push; then the damping is cut
so that it only goes slack. */
void MuscleModel::calcRigid(double pathRate, MuscleDynamics& d) const {
    const MuscleParameters& p = getParameters();
    const double scale = std::max(p.tendonSlackLength, p.optimalFiberLength);
    d.isFiberAtLimit = d.lengths.tendonLength < p.tendonSlackLength - kSlackRounding * scale;
    if (d.isFiberAtLimit) return;  // slack
    d.normFiberVelocity = pathRate * d.lengths.cosPennation / (p.maxContractionVelocity * p.optimalFiberLength);
    const double passive = calcPassiveForceLength(d.lengths.normFiberLength);
    const double active = d.activation * calcActiveForceLength(d.lengths.normFiberLength) *
                          calcForceVelocity(d.normFiberVelocity, d.activation);
    const double damping = std::max(p.fiberDamping * d.normFiberVelocity, -active - passive);
    d.passiveFiberForce = p.maxIsometricForce * passive;
    d.activeFiberForce = p.maxIsometricForce * active;
    d.dampingFiberForce = p.maxIsometricForce * damping;
    d.tendonForce = std::max(d.calcFiberForce(), 0.0) * d.lengths.cosPennation;
}

MuscleEnergy MuscleModel::calcEnergy(const MuscleLengths& lengths) const {
    const MuscleParameters& p = getParameters();
    MuscleEnergy energy;
    energy.fiber = p.maxIsometricForce * p.optimalFiberLength * calcPassiveEnergy(lengths.normFiberLength);
    if (!hasRigidTendon())
        energy.tendon =
            p.maxIsometricForce * p.tendonSlackLength * calcTendonEnergy(lengths.tendonLength / p.tendonSlackLength);
    return energy;
}

/** By how much a fiber at rest pulls more than its tendon [F_0]. @param fiberLength   [m] */
double MuscleModel::calcExcessPull(double pathLength, double activation, double fiberLength) const {
    const MuscleLengths lengths = calcLengths(pathLength, fiberLength);
    const double l = lengths.normFiberLength;
    const double fiber = activation * calcActiveForceLength(l) + calcPassiveForceLength(l);
    const double tendon = calcTendonForceLength(lengths.tendonLength / getParameters().tendonSlackLength);
    return fiber * lengths.cosPennation - tendon;
}

MuscleEquilibrium MuscleModel::findEquilibrium(double pathLength, double activation) const {
    const MuscleParameters& p = getParameters();
    const double a = clampActivation(activation), shortest = calcMinimumFiberLength() * p.optimalFiberLength;
    MuscleEquilibrium found;
    found.fiberLength = hasRigidTendon() ? calcLengths(pathLength, 0).fiberLength : settleFiber(pathLength, a);
    found.tendonForce = calcDynamics(pathLength, 0, a, found.fiberLength).tendonForce;
    if (found.fiberLength <= shortest) found.status = EquilibriumStatus::FiberAtLowerBound;
    return found;
}

double MuscleModel::settleFiber(double pathLength, double activation) const {
    const MuscleParameters& p = getParameters();
    const double height = std::sin(p.pennationAtOptimal) * p.optimalFiberLength;
    const double shortest = calcMinimumFiberLength() * p.optimalFiberLength;
    const auto calcFiber = [&](double tendonLength) {
        return std::max(std::hypot(std::max(pathLength - tendonLength, 0.0), height), shortest);
    };
    FiberWalk walk([&](double length) { return calcExcessPull(pathLength, activation, length); },
                   calcFiber(kStartStretch * p.tendonSlackLength), kScanStep * p.optimalFiberLength);
    if (walk.getExcessPull() > 0)
        walk.settle(shortest);
    else if (!walk.settle(calcFiber(p.tendonSlackLength)))
        walk.settle(calcFiber(0));  // a tendon that pulls even below its slack length
    return walk.getLength();
}

}  // namespace tautline
