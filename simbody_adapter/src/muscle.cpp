// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/muscle.h"

#include <cmath>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::State;

namespace {

/** Applies a muscle model to a cable and keeps its variables in the State. */
class MuscleLaw : public CableForceLaw {
public:
    MuscleLaw(const Cable& cable, std::shared_ptr<const MuscleModel> model)
        : CableForceLaw(cable), m_model(std::move(model)) {
        require(m_model != nullptr, "muscle on cable '", cable.getName(), "': the model is null");
    }

    const MuscleModel& getModel() const { return *m_model; }
    void setExcitationFunction(std::function<Real(const State&)> calcExcitation) {
        m_calcExcitation = std::move(calcExcitation);
    }

    Real calcTension(const State& state) const override { return calcDynamics(state).tendonForce; }
    Real calcPotentialEnergy(const State& state) const override;
    void realizeTopology(State& state, const SimTK::Subsystem& forces) override;
    void realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const override;

    Real calcExcitation(const State& state) const;
    void setExcitation(State& state, Real excitation) const;
    Real calcActivation(const State& state) const;
    void setActivation(State& state, Real activation) const;
    void setFiberLength(State& state, Real fiberLength) const;
    MuscleEquilibrium equilibrate(State& state) const;
    Real calcIsometricForce(const State& state, Real activation) const;
    MuscleLengths calcLengths(const State& state) const;
    MuscleDynamics calcDynamics(const State& state) const;

private:
    std::string describe() const { return "muscle on cable '" + getCable().getName() + "'"; }
    void requireFraction(Real value, const char* what) const {
        require(value >= 0 && value <= 1, describe(), ": ", what, " must be in [0, 1], but is ", value);
    }
    bool hasActivationState() const { return !m_model->getParameters().ignoresActivationDynamics; }
    bool hasFiberState() const { return !m_model->hasRigidTendon(); }
    /** [m]; with a rigid tendon not used. */
    Real getFiberState(const State& state) const;

    std::shared_ptr<const MuscleModel> m_model;
    std::function<Real(const State&)> m_calcExcitation;
    const SimTK::Subsystem* m_forces = nullptr;
    SimTK::ZIndex m_activation, m_fiber;
    SimTK::DiscreteVariableIndex m_excitation;
};

void checkStage(const State& state, SimTK::Stage stage, const char* method) {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), stage, method);
}

Real MuscleLaw::getFiberState(const State& state) const {
    checkStage(state, SimTK::Stage::Model, "Muscle::getFiberLength()");
    return hasFiberState() ? m_forces->getZ(state)[m_fiber] : 0;
}

void MuscleLaw::realizeTopology(State& state, const SimTK::Subsystem& forces) {
    m_forces = &forces;
    const MuscleParameters& p = m_model->getParameters();
    if (hasActivationState()) m_activation = forces.allocateZ(state, SimTK::Vector(1, p.defaultActivation));
    if (hasFiberState()) m_fiber = forces.allocateZ(state, SimTK::Vector(1, p.optimalFiberLength));
    m_excitation =
        forces.allocateDiscreteVariable(state, SimTK::Stage::Dynamics, new SimTK::Value<Real>(p.defaultExcitation));
}

void MuscleLaw::realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const {
    if (hasActivationState())
        forces.updZDot(state)[m_activation] = m_model->calcActivationRate(calcExcitation(state), calcActivation(state));
    if (hasFiberState())
        forces.updZDot(state)[m_fiber] = getCable().isDisabled(state) ? 0 : calcDynamics(state).fiberVelocity;
}

Real MuscleLaw::calcPotentialEnergy(const State& state) const {
    const MuscleEnergy energy = m_model->calcEnergy(calcLengths(state));
    return energy.fiber + energy.tendon;
}

Real MuscleLaw::calcExcitation(const State& state) const {
    ensureTopology(state, "Muscle::getExcitation()");
    if (m_calcExcitation) return m_model->clampActivation(m_calcExcitation(state));
    return m_model->clampActivation(SimTK::Value<Real>::downcast(m_forces->getDiscreteVariable(state, m_excitation)));
}

void MuscleLaw::setExcitation(State& state, Real excitation) const {
    requireFraction(excitation, "excitation");
    require(!m_calcExcitation, describe(), ": the excitation is given by a function and cannot be set");
    ensureTopology(state, "Muscle::setExcitation()");
    SimTK::Value<Real>::updDowncast(m_forces->updDiscreteVariable(state, m_excitation)) = excitation;
}

Real MuscleLaw::calcActivation(const State& state) const {
    checkStage(state, SimTK::Stage::Model, "Muscle::getActivation()");
    return hasActivationState() ? m_model->clampActivation(m_forces->getZ(state)[m_activation]) : calcExcitation(state);
}

void MuscleLaw::setActivation(State& state, Real activation) const {
    requireFraction(activation, "activation");
    require(hasActivationState(), describe(), ": without activation dynamics the activation cannot be set");
    checkStage(state, SimTK::Stage::Model, "Muscle::setActivation()");
    m_forces->updZ(state)[m_activation] = activation;
}

void MuscleLaw::setFiberLength(State& state, Real fiberLength) const {
    require(std::isfinite(fiberLength) && fiberLength > 0, describe(),
            ": the fiber length must be positive and finite, but is ", fiberLength);
    require(hasFiberState(), describe(), ": with a rigid tendon the fiber length cannot be set");
    checkStage(state, SimTK::Stage::Model, "Muscle::setFiberLength()");
    m_forces->updZ(state)[m_fiber] = fiberLength;
}

MuscleEquilibrium MuscleLaw::equilibrate(State& state) const {
    checkStage(state, SimTK::Stage::Position, "Muscle::equilibrate()");
    const MuscleEquilibrium found = m_model->findEquilibrium(getCable().getLength(state), calcActivation(state));
    if (hasFiberState()) m_forces->updZ(state)[m_fiber] = found.fiberLength;
    return found;
}

Real MuscleLaw::calcIsometricForce(const State& state, Real activation) const {
    requireFraction(activation, "activation");
    return m_model->findEquilibrium(getCable().getLength(state), activation).tendonForce;
}

MuscleLengths MuscleLaw::calcLengths(const State& state) const {
    return m_model->calcLengths(getCable().getLength(state), getFiberState(state));
}

MuscleDynamics MuscleLaw::calcDynamics(const State& state) const {
    const Cable& cable = getCable();
    return m_model->calcDynamics(cable.getLength(state), cable.getLengthRate(state), calcActivation(state),
                                 getFiberState(state));
}

const MuscleLaw& getMuscleLaw(const CableForce& force) {
    return dynamic_cast<const MuscleLaw&>(force.getLaw());
}

}  // namespace

Muscle::Muscle(SimTK::GeneralForceSubsystem& forces, const Cable& cable, std::shared_ptr<const MuscleModel> model)
    : CableForce(forces, std::make_unique<MuscleLaw>(cable, std::move(model))) {}

const MuscleModel& Muscle::getModel() const {
    return getMuscleLaw(*this).getModel();
}

void Muscle::setExcitationFunction(std::function<Real(const State&)> calcExcitation) {
    dynamic_cast<MuscleLaw&>(updLaw()).setExcitationFunction(std::move(calcExcitation));
}

void Muscle::setExcitation(State& state, Real excitation) const {
    getMuscleLaw(*this).setExcitation(state, excitation);
}

Real Muscle::getExcitation(const State& state) const {
    return getMuscleLaw(*this).calcExcitation(state);
}

void Muscle::setActivation(State& state, Real activation) const {
    getMuscleLaw(*this).setActivation(state, activation);
}

Real Muscle::getActivation(const State& state) const {
    return getMuscleLaw(*this).calcActivation(state);
}

void Muscle::setFiberLength(State& state, Real fiberLength) const {
    getMuscleLaw(*this).setFiberLength(state, fiberLength);
}

MuscleEquilibrium Muscle::equilibrate(State& state) const {
    return getMuscleLaw(*this).equilibrate(state);
}

Real Muscle::calcIsometricForce(const State& state, Real activation) const {
    return getMuscleLaw(*this).calcIsometricForce(state, activation);
}

MuscleLengths Muscle::calcLengths(const State& state) const {
    return getMuscleLaw(*this).calcLengths(state);
}

MuscleDynamics Muscle::calcDynamics(const State& state) const {
    return getMuscleLaw(*this).calcDynamics(state);
}

MuscleEnergy Muscle::calcEnergy(const State& state) const {
    return getModel().calcEnergy(calcLengths(state));
}

Real Muscle::getFiberLength(const State& state) const {
    return calcLengths(state).fiberLength;
}

Real Muscle::getPennation(const State& state) const {
    return calcLengths(state).calcPennation();
}

Real Muscle::getTendonLength(const State& state) const {
    return calcLengths(state).tendonLength;
}

Real Muscle::getFiberVelocity(const State& state) const {
    return calcDynamics(state).fiberVelocity;
}

Real Muscle::getActiveFiberForce(const State& state) const {
    return calcDynamics(state).activeFiberForce;
}

Real Muscle::getPassiveFiberForce(const State& state) const {
    return calcDynamics(state).passiveFiberForce;
}

Real Muscle::getTendonForce(const State& state) const {
    return calcDynamics(state).tendonForce;
}

Real Muscle::getFiberActivePower(const State& state) const {
    return calcDynamics(state).fiberActivePower;
}

Real Muscle::getFiberPassivePower(const State& state) const {
    return calcDynamics(state).fiberPassivePower;
}

Real Muscle::getTendonPower(const State& state) const {
    return calcDynamics(state).tendonPower;
}

Real Muscle::getMusclePower(const State& state) const {
    return calcDynamics(state).musclePower;
}

}  // namespace tautline
