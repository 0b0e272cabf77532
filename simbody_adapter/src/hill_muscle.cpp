// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/hill_muscle.h"

#include <cmath>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::State;

namespace {

void requirePositive(Real value, const char* what) {
    require(std::isfinite(value) && value > 0, "hill muscle: ", what, " must be positive and finite, but is ", value);
}

/** @param owner   "hill muscle", with its cable where that is known */
void requireFraction(const std::string& owner, Real value, const char* what) {
    require(value >= 0 && value <= 1, owner, ": ", what, " must be in [0, 1], but is ", value);
}

/** @return the parameters. @throws InvalidInput as validate(), with the cable's name */
const HillMuscleParameters& validateFor(const Cable& cable, const HillMuscleParameters& parameters) {
    try {
        parameters.validate();
    } catch (const InvalidInput& error) {
        throw InvalidInput("cable '" + cable.getName() + "': " + error.what());
    }
    return parameters;
}

class HillMuscleLaw : public CableForceLaw {
public:
    HillMuscleLaw(const Cable& cable, const HillMuscleParameters& parameters)
        : CableForceLaw(cable), m_parameters(validateFor(cable, parameters)) {}

    const HillMuscleParameters& getParameters() const { return m_parameters; }
    void setExcitationFunction(std::function<Real(const State&)> calcExcitation) {
        m_calcExcitation = std::move(calcExcitation);
    }

    Real calcTension(const State& state) const override;
    void realizeTopology(State& state, const SimTK::Subsystem& forces) override;
    void realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const override;

    Real calcExcitation(const State& state) const;
    void setExcitation(State& state, Real excitation) const;
    Real getActivation(const State& state) const;
    void setActivation(State& state, Real activation) const;

    /** Of the fiber along the tendon [m]; negative: shorter than the tendon, slack. */
    Real calcFiberProjection(const State& state) const {
        return getCable().getLength(state) - m_parameters.tendonSlackLength;
    }
    /** Height of the fiber's parallelogram [m], constant. */
    Real calcThickness() const { return m_parameters.optimalFiberLength * std::sin(m_parameters.pennationAtOptimal); }
    Real calcFiberLength(const State& state) const {
        return std::hypot(std::max(Real(0), calcFiberProjection(state)), calcThickness());
    }
    Real calcPennation(const State& state) const {
        return std::atan2(calcThickness(), std::max(Real(0), calcFiberProjection(state)));
    }
    Real calcFiberVelocity(const State& state) const {
        return getCable().getLengthRate(state) * std::cos(calcPennation(state));
    }

private:
    std::string describe() const { return "hill muscle on cable '" + getCable().getName() + "'"; }

    HillMuscleParameters m_parameters;
    std::function<Real(const State&)> m_calcExcitation;
    const SimTK::Subsystem* m_forces = nullptr;
    SimTK::ZIndex m_activation;
    SimTK::DiscreteVariableIndex m_excitation;
};

Real HillMuscleLaw::calcTension(const State& state) const {
    if (!(calcFiberProjection(state) > 0)) return 0;
    const HillMuscleParameters& p = m_parameters;
    const Real length = calcFiberLength(state) / p.optimalFiberLength;
    const Real velocity = calcFiberVelocity(state) / (p.maxContractionVelocity * p.optimalFiberLength);
    const Real active = getActivation(state) * calcActiveForceLength(p, length) * calcForceVelocity(p, velocity);
    return p.maxIsometricForce * (active + calcPassiveForceLength(p, length)) * std::cos(calcPennation(state));
}

void HillMuscleLaw::realizeTopology(State& state, const SimTK::Subsystem& forces) {
    m_forces = &forces;
    m_activation = forces.allocateZ(state, SimTK::Vector(1, m_parameters.defaultActivation));
    m_excitation = forces.allocateDiscreteVariable(state, SimTK::Stage::Dynamics,
                                                   new SimTK::Value<Real>(m_parameters.defaultExcitation));
}

void HillMuscleLaw::realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const {
    const Real difference = calcExcitation(state) - getActivation(state);
    const Real time = difference > 0 ? m_parameters.activationTime : m_parameters.deactivationTime;
    forces.updZDot(state)[m_activation] = difference / time;
}

Real HillMuscleLaw::calcExcitation(const State& state) const {
    ensureTopology(state, "HillMuscle::getExcitation()");
    if (m_calcExcitation) return SimTK::clamp(Real(0), m_calcExcitation(state), Real(1));
    return SimTK::Value<Real>::downcast(m_forces->getDiscreteVariable(state, m_excitation));
}

void HillMuscleLaw::setExcitation(State& state, Real excitation) const {
    requireFraction(describe(), excitation, "excitation");
    require(!m_calcExcitation, describe(), ": the excitation is given by a function and cannot be set");
    ensureTopology(state, "HillMuscle::setExcitation()");
    SimTK::Value<Real>::updDowncast(m_forces->updDiscreteVariable(state, m_excitation)) = excitation;
}

Real HillMuscleLaw::getActivation(const State& state) const {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), SimTK::Stage(SimTK::Stage::Model),
                               "HillMuscle::getActivation()");
    return m_forces->getZ(state)[m_activation];
}

void HillMuscleLaw::setActivation(State& state, Real activation) const {
    requireFraction(describe(), activation, "activation");
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), SimTK::Stage(SimTK::Stage::Model),
                               "HillMuscle::setActivation()");
    m_forces->updZ(state)[m_activation] = activation;
}

const HillMuscleLaw& getHillLaw(const CableForce& force) {
    return dynamic_cast<const HillMuscleLaw&>(force.getLaw());
}

}  // namespace

void HillMuscleParameters::validate() const {
    requirePositive(maxIsometricForce, "maxIsometricForce");
    requirePositive(optimalFiberLength, "optimalFiberLength");
    require(std::isfinite(tendonSlackLength) && tendonSlackLength >= 0,
            "hill muscle: tendonSlackLength must be finite and not negative, but is ", tendonSlackLength);
    require(pennationAtOptimal >= 0 && pennationAtOptimal < SimTK::Pi / 2,
            "hill muscle: pennationAtOptimal must be in [0, pi/2), but is ", pennationAtOptimal);
    requirePositive(maxContractionVelocity, "maxContractionVelocity");
    requirePositive(activationTime, "activationTime");
    requirePositive(deactivationTime, "deactivationTime");
    requirePositive(activeWidth, "activeWidth");
    requirePositive(passiveStrain, "passiveStrain");
    requirePositive(passiveShape, "passiveShape");
    requirePositive(concentricShape, "concentricShape");
    require(std::isfinite(eccentricForce) && eccentricForce > 1,
            "hill muscle: eccentricForce must be finite and above 1, but is ", eccentricForce);
    requireFraction("hill muscle", defaultExcitation, "defaultExcitation");
    requireFraction("hill muscle", defaultActivation, "defaultActivation");
}

Real calcActiveForceLength(const HillMuscleParameters& parameters, Real fiberLength) {
    return std::exp(-SimTK::square(fiberLength - 1) / parameters.activeWidth);
}

Real calcPassiveForceLength(const HillMuscleParameters& parameters, Real fiberLength) {
    if (!(fiberLength > 1)) return 0;
    const Real k = parameters.passiveShape;
    return std::expm1(k * (fiberLength - 1) / parameters.passiveStrain) / std::expm1(k);
}

Real calcForceVelocity(const HillMuscleParameters& parameters, Real velocity) {
    const Real a = parameters.concentricShape;
    if (velocity <= -1) return 0;
    if (velocity <= 0) return (1 + velocity) / (1 - velocity / a);
    // c from the slope 1 + 1/a that Hill's hyperbola has at zero.
    const Real gain = parameters.eccentricForce - 1, c = gain / (1 + 1 / a);
    return 1 + gain * velocity / (velocity + c);
}

HillMuscle::HillMuscle(SimTK::GeneralForceSubsystem& forces, const Cable& cable, const HillMuscleParameters& parameters)
    : CableForce(forces, std::make_unique<HillMuscleLaw>(cable, parameters)) {}

const HillMuscleParameters& HillMuscle::getParameters() const {
    return getHillLaw(*this).getParameters();
}

void HillMuscle::setExcitationFunction(std::function<Real(const State&)> calcExcitation) {
    dynamic_cast<HillMuscleLaw&>(updLaw()).setExcitationFunction(std::move(calcExcitation));
}

void HillMuscle::setExcitation(State& state, Real excitation) const {
    getHillLaw(*this).setExcitation(state, excitation);
}

Real HillMuscle::getExcitation(const State& state) const {
    return getHillLaw(*this).calcExcitation(state);
}

void HillMuscle::setActivation(State& state, Real activation) const {
    getHillLaw(*this).setActivation(state, activation);
}

Real HillMuscle::getActivation(const State& state) const {
    return getHillLaw(*this).getActivation(state);
}

Real HillMuscle::getFiberLength(const State& state) const {
    return getHillLaw(*this).calcFiberLength(state);
}

Real HillMuscle::getPennation(const State& state) const {
    return getHillLaw(*this).calcPennation(state);
}

Real HillMuscle::getFiberVelocity(const State& state) const {
    return getHillLaw(*this).calcFiberVelocity(state);
}

}  // namespace tautline
