// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>

#include "tautline/muscles/muscle_model.h"
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** A muscle of any model along a cable: a force element that pulls with the force of its tendon.

In the State it has the activation (a z, unless the model ignores activation dynamics), the length of the fiber (a z, of
a compliant tendon) and the excitation (a discrete variable, unless there is a function). A State starts with the
model's defaults and fibers at their optimal length: equilibrate() it before a simulation. */
class Muscle : public CableForce {
public:
    Muscle() = default;
    /** @throws InvalidInput for an empty handle or model */
    Muscle(SimTK::GeneralForceSubsystem& forces, const Cable& cable, std::shared_ptr<const MuscleModel> model);

    const MuscleModel& getModel() const;
    const MuscleParameters& getParameters() const { return getModel().getParameters(); }

    /** Excitation as a function of a State realized to Time, in place of the State's own. Before realizeTopology(). */
    void setExcitationFunction(std::function<SimTK::Real(const SimTK::State&)> calcExcitation);
    /** @throws InvalidInput unless in [0, 1], or if there is a function. Stage: Topology; invalidates Dynamics. */
    void setExcitation(SimTK::State& state, SimTK::Real excitation) const;
    /** As it acts: within [minimum activation, 1]. Stage: Time. */
    SimTK::Real getExcitation(const SimTK::State& state) const;

    /** @throws InvalidInput unless in [0, 1], or without activation dynamics (then set the excitation). Stage: Model.
     */
    void setActivation(SimTK::State& state, SimTK::Real activation) const;
    /** As it acts: within [minimum activation, 1]. Stage: Model; without activation dynamics: Time. */
    SimTK::Real getActivation(const SimTK::State& state) const;
    /** @param fiberLength   [m]. @throws InvalidInput unless positive, or with a rigid tendon. Stage: Model. */
    void setFiberLength(SimTK::State& state, SimTK::Real fiberLength) const;
    /** Sets the fiber to where it and its tendon pull alike at rest, at the State's activation. Nothing to set with a
    rigid tendon. Stage: Position. */
    MuscleEquilibrium equilibrate(SimTK::State& state) const;

    /** The force of the tendon [N] in that equilibrium at another activation, in [0, 1]; the State stays as it is.
    Stage: Position. */
    SimTK::Real calcIsometricForce(const SimTK::State& state, SimTK::Real activation) const;

    /** Fiber, pennation, tendon. Stage: Position. */
    MuscleLengths calcLengths(const SimTK::State& state) const;
    /** All that the muscle does: lengths, velocities, forces, powers. Computed anew at each call, so keep it.
    The forces are those of the model, also while cable or force is disabled. Stage: Velocity. */
    MuscleDynamics calcDynamics(const SimTK::State& state) const;

    /** Stored in the elasticity of fiber and tendon; their sum is the potential energy of the force. Stage: Position.
     */
    MuscleEnergy calcEnergy(const SimTK::State& state) const;

    SimTK::Real getFiberLength(const SimTK::State& state) const;   ///< [m]. Stage: Position
    SimTK::Real getPennation(const SimTK::State& state) const;     ///< [rad]. Stage: Position
    SimTK::Real getTendonLength(const SimTK::State& state) const;  ///< [m]. Stage: Position
    /** [m/s], positive in lengthening. Stage: Velocity */
    SimTK::Real getFiberVelocity(const SimTK::State& state) const;
    SimTK::Real getActiveFiberForce(const SimTK::State& state) const;   ///< [N]. Stage: Velocity
    SimTK::Real getPassiveFiberForce(const SimTK::State& state) const;  ///< [N], elastic. Stage: Velocity
    /** [N] The tension, unless cable or force is disabled. Stage: Velocity */
    SimTK::Real getTendonForce(const SimTK::State& state) const;
    SimTK::Real getFiberActivePower(const SimTK::State& state) const;   ///< [W]. Stage: Velocity
    SimTK::Real getFiberPassivePower(const SimTK::State& state) const;  ///< [W]. Stage: Velocity
    SimTK::Real getTendonPower(const SimTK::State& state) const;        ///< [W]. Stage: Velocity
    SimTK::Real getMusclePower(const SimTK::State& state) const;        ///< [W]. Stage: Velocity
};

}  // namespace tautline
