// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_forces.h"

#include <cmath>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::State;

namespace {

Real requireNotNegative(const char* force, const Cable& cable, Real value, const char* what) {
    require(std::isfinite(value) && value >= 0, force, " on cable '", cable.getName(), "': ", what,
            " must be finite and not negative, but is ", value);
    return value;
}

class ElasticStringLaw : public CableForceLaw {
public:
    ElasticStringLaw(const Cable& cable, Real slackLength, Real stiffness, Real damping)
        : CableForceLaw(cable),
          m_slackLength(requireNotNegative("elastic string force", cable, slackLength, "slack length")),
          m_stiffness(requireNotNegative("elastic string force", cable, stiffness, "stiffness")),
          m_damping(requireNotNegative("elastic string force", cable, damping, "damping")) {}

    Real getSlackLength() const { return m_slackLength; }
    Real getStiffness() const { return m_stiffness; }
    Real getDamping() const { return m_damping; }

    Real calcStretch(const State& state) const {
        return std::max(Real(0), getCable().getLength(state) - m_slackLength);
    }

    Real calcTension(const State& state) const override {
        const Real stretch = calcStretch(state);
        if (stretch == 0) return 0;
        const Real rate = m_damping > 0 ? getCable().getLengthRate(state) : 0;
        return m_stiffness * stretch * (1 + m_damping * rate);
    }

    Real calcPotentialEnergy(const State& state) const override {
        return m_stiffness * SimTK::square(calcStretch(state)) / 2;
    }

private:
    Real m_slackLength, m_stiffness, m_damping;
};

class CableSpringLaw : public CableForceLaw {
public:
    CableSpringLaw(const Cable& cable, Real restLength, Real stiffness, Real damping)
        : CableForceLaw(cable),
          m_restLength(requireNotNegative("cable spring", cable, restLength, "rest length")),
          m_stiffness(requireNotNegative("cable spring", cable, stiffness, "stiffness")),
          m_damping(requireNotNegative("cable spring", cable, damping, "damping")) {}

    Real getRestLength() const { return m_restLength; }
    Real getStiffness() const { return m_stiffness; }
    Real getDamping() const { return m_damping; }

    Real calcTension(const State& state) const override {
        // Below the rest length the spring is slack and the damper alone pulls.
        return m_stiffness * std::max(Real(0), calcStretch(state)) + m_damping * getCable().getLengthRate(state);
    }

    Real calcPotentialEnergy(const State& state) const override {
        return m_stiffness * SimTK::square(std::max(Real(0), calcStretch(state))) / 2;
    }

private:
    Real calcStretch(const State& state) const { return getCable().getLength(state) - m_restLength; }

    Real m_restLength, m_stiffness, m_damping;
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

const ElasticStringLaw& getElasticLaw(const CableForce& force) {
    return dynamic_cast<const ElasticStringLaw&>(force.getLaw());
}

std::function<Real(const State&)> makeTimeFunction(SimTK::Function* tensionOfTime) {
    if (!tensionOfTime) return nullptr;
    const std::shared_ptr<const SimTK::Function> owned(tensionOfTime);
    require(owned->getArgumentSize() == 1, "prescribed tension: the function must have one ",
            "argument, the time, but has ", owned->getArgumentSize());
    return [owned](const State& state) { return owned->calcValue(SimTK::Vector(1, state.getTime())); };
}

}  // namespace

ElasticStringForce::ElasticStringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, Real slackLength,
                                       Real stiffness, Real damping)
    : CableForce(forces, std::make_unique<ElasticStringLaw>(cable, slackLength, stiffness, damping)) {}

Real ElasticStringForce::getSlackLength() const {
    return getElasticLaw(*this).getSlackLength();
}
Real ElasticStringForce::getStiffness() const {
    return getElasticLaw(*this).getStiffness();
}
Real ElasticStringForce::getDamping() const {
    return getElasticLaw(*this).getDamping();
}

Real ElasticStringForce::getStretch(const State& state) const {
    return getElasticLaw(*this).calcStretch(state);
}

Real ElasticStringForce::getPowerDissipation(const State& state) const {
    CableForceLaw::ensureTopology(state, "ElasticStringForce::getPowerDissipation()");
    if (isDisabled(state) || getCable().isDisabled(state)) return 0;
    const Real rate = getCable().getLengthRate(state);
    // What the tension does beyond the elastic part, so that the cut at zero is accounted for.
    return (getTension(state) - getStiffness() * getStretch(state)) * rate;
}

CableSpringForce::CableSpringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, Real restLength,
                                   Real stiffness, Real damping)
    : CableForce(forces, std::make_unique<CableSpringLaw>(cable, restLength, stiffness, damping)) {}

Real CableSpringForce::getRestLength() const {
    return dynamic_cast<const CableSpringLaw&>(getLaw()).getRestLength();
}
Real CableSpringForce::getStiffness() const {
    return dynamic_cast<const CableSpringLaw&>(getLaw()).getStiffness();
}
Real CableSpringForce::getDamping() const {
    return dynamic_cast<const CableSpringLaw&>(getLaw()).getDamping();
}

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
