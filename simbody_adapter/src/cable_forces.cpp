// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_forces.h"

#include <cmath>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::State;

namespace {

void requireNotNegative(const char* force, const Cable& cable, Real value, const char* what) {
    require(std::isfinite(value) && value >= 0, force, " on cable '", cable.getName(), "': ", what,
            " must be finite and not negative, but is ", value);
}

/** Stiffness, slack length and damping as one State variable, and what damping has taken out as a z. */
class SpringLaw : public CableForceLaw {
public:
    SpringLaw(const Cable& cable, const char* name, const CableSpringParameters& parameters)
        : CableForceLaw(cable), m_name(name), m_default(parameters) {
        check(parameters);
    }

    const CableSpringParameters& getDefaultParameters() const { return m_default; }

    const CableSpringParameters& getParameters(const State& state) const {
        ensureTopology(state, m_name);
        return SimTK::Value<CableSpringParameters>::downcast(m_forces->getDiscreteVariable(state, m_parameters));
    }

    void setParameters(State& state, const CableSpringParameters& parameters) const {
        check(parameters);
        require(m_default.damping > 0 || parameters.damping == 0, m_name, " on cable '", getCable().getName(),
                "': was made without damping, so that no State has room for the energy that damping takes");
        ensureTopology(state, m_name);
        SimTK::Value<CableSpringParameters>::updDowncast(m_forces->updDiscreteVariable(state, m_parameters)) =
            parameters;
    }

    Real getDissipatedEnergy(const State& state) const {
        ensureTopology(state, m_name);
        return m_dissipated.isValid() ? m_forces->getZ(state)[m_dissipated] : 0;
    }

    void setDissipatedEnergy(State& state, Real energy) const {
        require(m_dissipated.isValid(), m_name, " on cable '", getCable().getName(),
                "': was made without damping and dissipates nothing");
        require(std::isfinite(energy), m_name, " on cable '", getCable().getName(),
                "': the dissipated energy must be finite, but is ", energy);
        ensureTopology(state, m_name);
        m_forces->updZ(state)[m_dissipated] = energy;
    }

    /** Length beyond the slack length, negative while slack [m]; NaN where the length is. */
    Real calcExcess(const State& state) const { return getCable().getLength(state) - getParameters(state).slackLength; }

    /** NaN where the length is. */
    Real calcStretch(const State& state) const {
        const Real excess = calcExcess(state);
        return excess < 0 ? 0 : excess;
    }

    Real calcPotentialEnergy(const State& state) const override {
        return getParameters(state).stiffness * SimTK::square(calcStretch(state)) / 2;
    }

    /** What the tension does beyond the elastic part, so that the cut at zero is accounted for. */
    Real calcPowerDissipation(const State& state) const {
        if (getCable().isDisabled(state)) return 0;
        const Real law = calcTension(state), tension = law < 0 ? 0 : law;
        return (tension - getParameters(state).stiffness * calcStretch(state)) * getCable().getLengthRate(state);
    }

    void realizeTopology(State& state, const SimTK::Subsystem& forces) override {
        m_forces = &forces;
        m_parameters = forces.allocateDiscreteVariable(state, SimTK::Stage::Dynamics,
                                                       new SimTK::Value<CableSpringParameters>(m_default));
        m_dissipated = SimTK::ZIndex();
        if (m_default.damping > 0) m_dissipated = forces.allocateZ(state, SimTK::Vector(1, Real(0)));
    }

    void realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const override {
        if (m_dissipated.isValid()) forces.updZDot(state)[m_dissipated] = calcPowerDissipation(state);
    }

private:
    void check(const CableSpringParameters& parameters) const {
        requireNotNegative(m_name, getCable(), parameters.stiffness, "stiffness");
        requireNotNegative(m_name, getCable(), parameters.slackLength, "slack length");
        requireNotNegative(m_name, getCable(), parameters.damping, "damping");
    }

    const char* m_name;
    CableSpringParameters m_default;
    const SimTK::Subsystem* m_forces = nullptr;
    SimTK::DiscreteVariableIndex m_parameters;
    SimTK::ZIndex m_dissipated;  ///< invalid: made without damping
};

class ElasticStringLaw final : public SpringLaw {
public:
    ElasticStringLaw(const Cable& cable, const CableSpringParameters& parameters)
        : SpringLaw(cable, "elastic string force", parameters) {}

    Real calcTension(const State& state) const override {
        const CableSpringParameters& parameters = getParameters(state);
        const Real stretch = calcStretch(state);
        if (stretch == 0) return 0;
        const Real rate = parameters.damping > 0 ? getCable().getLengthRate(state) : 0;
        return parameters.stiffness * stretch * (1 + parameters.damping * rate);
    }
};

class CableSpringLaw final : public SpringLaw {
public:
    CableSpringLaw(const Cable& cable, const CableSpringParameters& parameters)
        : SpringLaw(cable, "cable spring", parameters) {}

    /** Below the slack length the spring is slack and the damper alone pulls. */
    Real calcTension(const State& state) const override {
        const CableSpringParameters& parameters = getParameters(state);
        return parameters.stiffness * calcStretch(state) + parameters.damping * getCable().getLengthRate(state);
    }
};

/** A tension from a discrete variable (no function) or from a function. */
class PrescribedTensionLaw : public CableForceLaw {
public:
    PrescribedTensionLaw(const Cable& cable, Real tension) : CableForceLaw(cable), m_defaultTension(tension) {
        check(tension);
    }
    PrescribedTensionLaw(const Cable& cable, std::function<Real(const State&)> calcTension) : CableForceLaw(cable) {
        setTensionFunction(std::move(calcTension));
    }

    void setTensionFunction(std::function<Real(const State&)> calcTension) {
        require(calcTension != nullptr, "prescribed tension on cable '", getCable().getName(),
                "': the function is null");
        m_calcTension = std::move(calcTension);
    }

    Real calcTension(const State& state) const override {
        if (m_calcTension) return m_calcTension(state);
        return SimTK::Value<Real>::downcast(m_forces->getDiscreteVariable(state, m_tension));
    }

    void setTension(State& state, Real tension) const {
        check(tension);
        require(!m_calcTension, "prescribed tension on cable '", getCable().getName(),
                "': is given by a function and cannot be set");
        ensureTopology(state, "PrescribedTensionForce::setTension()");
        SimTK::Value<Real>::updDowncast(m_forces->updDiscreteVariable(state, m_tension)) = tension;
    }

    void realizeTopology(State& state, const SimTK::Subsystem& forces) override {
        m_forces = &forces;
        m_tension =
            forces.allocateDiscreteVariable(state, SimTK::Stage::Dynamics, new SimTK::Value<Real>(m_defaultTension));
    }

private:
    void check(Real tension) const {
        require(std::isfinite(tension) && tension >= 0, "prescribed tension on cable '", getCable().getName(),
                "': must be finite and not negative, but is ", tension);
    }

    Real m_defaultTension = 0;
    std::function<Real(const State&)> m_calcTension;
    const SimTK::Subsystem* m_forces = nullptr;
    SimTK::DiscreteVariableIndex m_tension;
};

const SpringLaw& getSpringLaw(const CableForce& force) {
    return dynamic_cast<const SpringLaw&>(force.getLaw());
}

std::function<Real(const State&)> makeTimeFunction(SimTK::Function* tensionOfTime) {
    if (!tensionOfTime) return nullptr;
    const std::shared_ptr<const SimTK::Function> owned(tensionOfTime);
    require(owned->getArgumentSize() == 1, "prescribed tension: the function must have one ",
            "argument, the time, but has ", owned->getArgumentSize());
    return [owned](const State& state) { return owned->calcValue(SimTK::Vector(1, state.getTime())); };
}

}  // namespace

const CableSpringParameters& CableSpringBase::getDefaultParameters() const {
    return getSpringLaw(*this).getDefaultParameters();
}
const CableSpringParameters& CableSpringBase::getParameters(const State& state) const {
    return getSpringLaw(*this).getParameters(state);
}
void CableSpringBase::setParameters(State& state, const CableSpringParameters& parameters) const {
    getSpringLaw(*this).setParameters(state, parameters);
}

Real CableSpringBase::getStretch(const State& state) const {
    return getSpringLaw(*this).calcStretch(state);
}

Real CableSpringBase::getPowerDissipation(const State& state) const {
    CableForceLaw::ensureTopology(state, "CableSpringBase::getPowerDissipation()");
    if (isDisabled(state) || getCable().isDisabled(state)) return 0;
    getTension(state);  // has the stage checked
    return getSpringLaw(*this).calcPowerDissipation(state);
}

Real CableSpringBase::getDissipatedEnergy(const State& state) const {
    return getSpringLaw(*this).getDissipatedEnergy(state);
}
void CableSpringBase::setDissipatedEnergy(State& state, Real energy) const {
    getSpringLaw(*this).setDissipatedEnergy(state, energy);
}

ElasticStringForce::ElasticStringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, Real stiffness,
                                       Real slackLength, Real damping)
    : CableSpringBase(
          forces, std::make_unique<ElasticStringLaw>(cable, CableSpringParameters{stiffness, slackLength, damping})) {}

CableSpringForce::CableSpringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, Real stiffness,
                                   Real slackLength, Real damping)
    : CableSpringBase(
          forces, std::make_unique<CableSpringLaw>(cable, CableSpringParameters{stiffness, slackLength, damping})) {}

PrescribedTensionForce::PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, Real tension)
    : CableForce(forces, std::make_unique<PrescribedTensionLaw>(cable, tension)) {}

PrescribedTensionForce::PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable,
                                               std::function<Real(const State&)> calcTension)
    : CableForce(forces, std::make_unique<PrescribedTensionLaw>(cable, std::move(calcTension))) {}

PrescribedTensionForce::PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable,
                                               SimTK::Function* tensionOfTime)
    : PrescribedTensionForce(forces, cable, makeTimeFunction(tensionOfTime)) {}

void PrescribedTensionForce::setTensionFunction(std::function<Real(const State&)> calcTension) {
    dynamic_cast<PrescribedTensionLaw&>(updLaw()).setTensionFunction(std::move(calcTension));
}

void PrescribedTensionForce::setTension(State& state, Real tension) const {
    dynamic_cast<const PrescribedTensionLaw&>(getLaw()).setTension(state, tension);
}

}  // namespace tautline
