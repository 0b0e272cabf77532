// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** Of the springs below, in the order of Simbody's CableSpring. */
struct CableSpringParameters {
    SimTK::Real stiffness = 0;    ///< k [N/m], finite, not negative
    SimTK::Real slackLength = 0;  ///< L_0 [m], finite, not negative
    SimTK::Real damping = 0;      ///< c, finite, not negative; its unit is said by each spring
};

/** What the springs have in common. With L the length of the cable, the stretch is x = max(0, L - L_0) and the
potential energy k x^2 / 2. The parameters are a State variable. */
class CableSpringBase : public CableForce {
public:
    const CableSpringParameters& getDefaultParameters() const;
    /** Stage: Topology. */
    const CableSpringParameters& getParameters(const SimTK::State& state) const;
    /** Invalidates Dynamics. Stage: Topology. @throws InvalidInput with the value; for damping of a spring that was
    made without any, since its States have no room for the dissipated energy */
    void setParameters(SimTK::State& state, const CableSpringParameters& parameters) const;

    /** x [m]. Stage: Position. */
    SimTK::Real getStretch(const SimTK::State& state) const;
    /** Power that damping takes out [W]; what is lost where the tension is cut at zero is accounted for. Stage:
    Velocity. */
    SimTK::Real getPowerDissipation(const SimTK::State& state) const;
    /** What damping has taken out since the study began [J]: a z variable, 0 at first, of springs that are made with
    damping; 0 of others. Potential and kinetic energy and this are together the work that was put in. Stage: Topology.
  */
    SimTK::Real getDissipatedEnergy(const SimTK::State& state) const;
    void setDissipatedEnergy(SimTK::State& state, SimTK::Real energy) const;

protected:
    using CableForce::CableForce;
    CableSpringBase() = default;
};

/** A cable of linear elasticity, with a dissipation that vanishes with the stretch, as Simbody's CableSpring:

    tension = max(0, k x (1 + c dL/dt)) for x > 0, else 0.

Damping takes k c x (dL/dt)^2, less where the tension is cut at zero. */
class ElasticStringForce : public CableSpringBase {
public:
    ElasticStringForce() = default;
    /** As Simbody's springs: stiffness first.
    @param damping   c [s/m]
    @throws InvalidInput with the value */
    ElasticStringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Real stiffness,
                       SimTK::Real slackLength, SimTK::Real damping = 0);
};

/** A spring in line with the cable, and a damper beside it:

    tension = max(0, k x + c dL/dt).

Unlike in ElasticStringForce the damper holds by itself: it brakes a cable that is paid out even below the slack
length. */
class CableSpringForce : public CableSpringBase {
public:
    CableSpringForce() = default;
    /** @param damping   c [N s/m]
    @throws InvalidInput with the value */
    CableSpringForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, SimTK::Real stiffness,
                     SimTK::Real slackLength, SimTK::Real damping = 0);
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
