// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

namespace tautline {

class Cable;
class CableSubsystemImpl;

/** Identifies a cable within its CableSubsystem: 0, 1, ... in the order of creation. */
SimTK_DEFINE_UNIQUE_INDEX_TYPE(CableIndex);

/** All cables of a MultibodySystem. Create it with the system, then create Cable objects in it; forces
that pull on them stand in the usual GeneralForceSubsystem.

Stages: paths are found at Position, length rates at Velocity; nothing is done at later stages.

Contact sets and studies. In a State fresh from the System the contact sets of all cables are free: every
realize(Position) finds path and contact set anew from the cable's hints, so that the answer is a function
of the pose alone. When a time-stepping study initializes (TimeStepper::initialize() or
Integrator::initialize(), both raise Simbody's Initialization event for every subsystem), the contact sets
found in the initial state are fixed in the study's own State; from then on only the event handlers of the
cables change them, and paths are continued from step to step. See Cable::fixContacts(). A cable that is disabled
then, or has no solution, stays free: it is solved anew in every pose, without events, until fixContacts(). */
class CableSubsystem : public SimTK::Subsystem {
public:
    explicit CableSubsystem(SimTK::MultibodySystem& system);

    int getNumCables() const;

    /** @throws InvalidInput if there is no such cable */
    const Cable& getCable(CableIndex cable) const;
    Cable& updCable(CableIndex cable);

    const SimTK::MultibodySystem& getMultibodySystem() const;

    /** Judges the paths of all cables in an accepted step of a study and counts them in CableStatistics. Nothing in
    Simbody 3.7 tells a subsystem of accepted steps: call it wherever the integrator returns, with
    setReturnEveryInternalStep(true) (and under a TimeStepper setReportAllSignificantStates(true)).
    Realizes the state to Position if it is not yet. */
    void countStep(const SimTK::State& state) const;

private:
    friend class Cable;
    CableSubsystemImpl& updImpl();
    const CableSubsystemImpl& getImpl() const;
};

}  // namespace tautline
