// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** A cable of linear elasticity with a dissipation that vanishes with the stretch. With stretch
x = length - slack length,

    tension = max(0, k x (1 + c xdot)) for x > 0, else 0;    potential energy = k x^2 / 2 for x > 0.

Power: -tension xdot = -d(energy)/dt - k c x xdot^2 while taut and not relaxed by c, so that damping only
takes energy out. */
class ElasticStringForce : public CableForce {
public:
    ElasticStringForce() = default;
    /** @param slackLength   [m], >= 0
    @param stiffness     k [N/m], >= 0
    @param damping       c [s/m], >= 0
    @throws InvalidInput with the value */
    ElasticStringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Real slackLength,
                       SimTK::Real stiffness, SimTK::Real damping = 0);

    SimTK::Real getSlackLength() const;
    SimTK::Real getStiffness() const;
    SimTK::Real getDamping() const;
    /** max(0, x) [m]. Stage: Position. */
    SimTK::Real getStretch(const SimTK::State& state) const;
    /** k c x xdot^2, the power lost [W]; less where the tension is cut at zero. Stage: Velocity. */
    SimTK::Real getPowerDissipation(const SimTK::State& state) const;
};

/** A spring with a rest length in line with the cable, and a damper beside it. With stretch x = length - rest length,

    tension = max(0, k max(0, x) + c xdot);    potential energy = k x^2 / 2 for x > 0.

Unlike in ElasticStringForce the damper holds by itself: it brakes a cable that is paid out even below the rest
length. */
class CableSpringForce : public CableForce {
public:
    CableSpringForce() = default;
    /** @param restLength   [m], >= 0
    @param stiffness    k [N/m], >= 0
    @param damping      c [N s/m], >= 0
    @throws InvalidInput with the value */
    CableSpringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Real restLength,
                     SimTK::Real stiffness, SimTK::Real damping = 0);

    SimTK::Real getRestLength() const;
    SimTK::Real getStiffness() const;
    SimTK::Real getDamping() const;
};

/** A tension that is prescribed, as a number or a function. No potential energy. */
class PrescribedTensionForce : public CableForce {
public:
    PrescribedTensionForce() = default;
    /** A tension that can be changed in each State. @param tension   default [N], finite and >= 0 */
    PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Real tension);
    /** @param calcTension   [N] of a State realized to Velocity */
    PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable,
                           std::function<SimTK::Real(const SimTK::State&)> calcTension);
    /** @param tensionOfTime   of one argument, the time [s]; the force takes it over */
    PrescribedTensionForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Function* tensionOfTime);

    /** Gives the tension [N] as a function of a State realized to Velocity, in place of the State's own.
    Before realizeTopology(). @throws InvalidInput for a null function */
    void setTensionFunction(std::function<SimTK::Real(const SimTK::State&)> calcTension);
    /** For a force without a function only; invalidates Dynamics. Stage: Topology. @throws InvalidInput for a
    tension below zero or a force with a function */
    void setTension(SimTK::State& state, SimTK::Real tension) const;
};

}  // namespace tautline
