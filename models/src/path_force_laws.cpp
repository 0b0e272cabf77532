// SPDX-License-Identifier: Apache-2.0
#include "path_force_laws.h"

#include <algorithm>

#include "tautline/simbody/cable_forces.h"

namespace tautline::models {
namespace {

using SimTK::Real;
using SimTK::State;

class NoTensionLaw : public CableForceLaw {
public:
    using CableForceLaw::CableForceLaw;
    Real calcTension(const State&) const override { return 0; }
};

/** No energy: its curve need not be that of an elastic body. */
class LigamentLaw : public CableForceLaw {
public:
    LigamentLaw(const Cable& cable, const LigamentTension& ligament) : CableForceLaw(cable), m_ligament(ligament) {}

    Real calcTension(const State& state) const override {
        const Real length = getCable().getLength(state);
        if (length <= m_ligament.restingLength) return 0;
        return m_ligament.maxForce * m_ligament.curve.calcValue(length / m_ligament.restingLength);
    }

private:
    LigamentTension m_ligament;
};

/** With strain e = length / slack length - 1, Blankevoort and Huiskes (1991), Eqn. 1, written with the transition
strain t where the parabola meets the line, t = 2 e_l of the paper:

    f = k e^2 / (2 t) for 0 < e < t,    k (e - t/2) beyond,

and a damper c de/dt while the ligament is taut and lengthens, faded in over the first hundredth of strain. */
class BlankevoortLaw : public CableForceLaw {
public:
    BlankevoortLaw(const Cable& cable, const BlankevoortTension& ligament)
        : CableForceLaw(cable), m_ligament(ligament) {}

    Real calcTension(const State& state) const override {
        const Real strain = calcStrain(state);
        return strain > 0 ? calcElasticForce(strain) + calcDamping(strain, state) : 0;
    }

    Real calcPotentialEnergy(const State& state) const override {
        const Real e = calcStrain(state), t = m_ligament.transitionStrain;
        if (e <= 0) return 0;
        const Real perLength = m_ligament.stiffness * m_ligament.slackLength;
        return perLength * (e < t ? e * e * e / (6 * t) : e * (e - t) / 2 + t * t / 6);
    }

private:
    Real calcStrain(const State& state) const { return getCable().getLength(state) / m_ligament.slackLength - 1; }

    Real calcElasticForce(Real e) const {
        const Real k = m_ligament.stiffness, t = m_ligament.transitionStrain;
        return e < t ? k * e * e / (2 * t) : k * (e - t / 2);
    }

    Real calcDamping(Real strain, const State& state) const {
        constexpr Real kFadedIn = 0.01;
        const Real rate = getCable().getLengthRate(state) / m_ligament.slackLength;
        if (rate <= 0) return 0;
        return m_ligament.damping * rate * SimTK::stepUp(std::min(strain / kFadedIn, Real(1)));
    }

    BlankevoortTension m_ligament;
};

class ControlledLaw : public CableForceLaw {
public:
    ControlledLaw(const Cable& cable, const ControlledTension& actuator, Control control)
        : CableForceLaw(cable), m_actuator(actuator), m_control(std::move(control)) {}

    Real calcTension(const State& state) const override {
        const Real control = m_control ? m_control(state.getTime()) : 0;
        return m_actuator.optimalForce * std::clamp(control, m_actuator.controlRange[0], m_actuator.controlRange[1]);
    }

private:
    ControlledTension m_actuator;
    Control m_control;
};

struct ForceMaker {
    SimTK::GeneralForceSubsystem& forces;
    const Cable& cable;
    const Control& control;

    CableForce operator()(const NoTension&) const { return {forces, std::make_unique<NoTensionLaw>(cable)}; }
    CableForce operator()(const LigamentTension& tension) const {
        return {forces, std::make_unique<LigamentLaw>(cable, tension)};
    }
    CableForce operator()(const BlankevoortTension& tension) const {
        return {forces, std::make_unique<BlankevoortLaw>(cable, tension)};
    }
    CableForce operator()(const ControlledTension& tension) const {
        return {forces, std::make_unique<ControlledLaw>(cable, tension, control)};
    }
    CableForce operator()(const ExtensionTension& tension) const { return {forces, tension.makeLaw(cable)}; }
    CableForce operator()(const PrescribedTension& prescribed) const {
        return PrescribedTensionForce(forces, cable, prescribed.tension);
    }
};

}  // namespace

CableForce makePathForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, const PathForce& force,
                         const Control& control) {
    return std::visit(ForceMaker{forces, cable, control}, force.tension);
}

}  // namespace tautline::models
