// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <string>

namespace tautline {

class Cable;
class CablePathSubsystemImpl;

/** Identifies a cable within its CablePathSubsystem: 0, 1, ... in the order of creation. */
SimTK_DEFINE_UNIQUE_INDEX_TYPE(CableIndex);

/** How the contacts of a cable are decided from pose to pose.

Events: while a study runs contacts change at events only, which stop a step where the cable touches down or lifts off;
between them forces are smooth, so that integrators keep their order.
Tracked: contacts are decided in every pose, the path continued from that of the last accepted step, with no events: the
cheapest for many cables. Steps go through touchdown and lift-off, where the second derivative of the length jumps.
Free: the pose alone decides, as in a search from the hints; the path of the last accepted step only saves the search,
and is kept only where it runs as one found anew has to (PathTracker::solveFrom()). Side and winding are lost where the
straight line says otherwise. */
enum class ContactMode { Events, Tracked, Free };

/** All cables of a MultibodySystem. Create it with the system, then create Cable objects in it; forces
that pull on them stand in the usual GeneralForceSubsystem.

Stages: paths are found at Position, length rates at Velocity; nothing is done at later stages.

Contact sets and studies. In a State fresh from the System the contact sets of all cables are free, of whatever mode:
the pose alone decides. When a time-stepping study initializes (TimeStepper::initialize() or Integrator::initialize(),
both raise Simbody's Initialization event for every subsystem), the contact sets of cables of ContactMode::Events are
fixed in the study's own State; from then on only the event handlers of the cables change them, and paths are continued
from step to step. See Cable::fixContacts(). A cable that is disabled then, or has no solution, stays free: it is solved
in every pose, without events, until fixContacts().

Where a handler of your own moves bodies, or a cable is otherwise found at a new pose with contacts that do not hold
there, a TimeStepper settles them before it goes on. A bare Integrator calls no handlers: contacts then stay as they are
when its steps end at events (ReachedEventTrigger) that the caller ignores, Cable::calcStatus() tells so of the states
that follow, and so does CableStatistics::numDegradedSteps. Use a TimeStepper, or ContactMode::Tracked. */
class CablePathSubsystem : public SimTK::Subsystem {
public:
    explicit CablePathSubsystem(SimTK::MultibodySystem& system);

    int getNumCables() const;

    /** @throws InvalidInput if there is no such cable */
    const Cable& getCable(CableIndex cable) const;
    Cable& updCable(CableIndex cable);

    /** @throws InvalidInput if no cable has this name */
    const Cable& getCable(const std::string& name) const;

    const SimTK::MultibodySystem& getMultibodySystem() const;

    /** Of all cables that have not been given a mode of their own: Events unless set. Invalidates the topology. */
    void setDefaultContactMode(ContactMode mode);
    ContactMode getDefaultContactMode() const;
    /** Of all cables in this State [Topology]; invalidates Position. See Cable::setContactMode(). */
    void setContactMode(SimTK::State& state, ContactMode mode) const;

    /** Makes the paths of this State [Position] those from which later poses are continued, as an integrator does when
    it accepts a step: for loops over poses without an integrator, in which ContactMode::Free and Tracked are then as
    fast as in a study. Invalidates Position; at the same pose nothing is solved again. */
    void acceptPaths(SimTK::State& state) const;
    /** Has the next path of every cable be found anew. Stage: Topology; invalidates Position. */
    void forgetPaths(SimTK::State& state) const;

    /** Whether the cables and their obstacles appear in a Visualizer by themselves, as CableDecorations draws them;
    true unless set. Say false where a CableDecorations of your own draws them. */
    void setShowDecorations(bool shows);
    bool getShowDecorations() const;

    /** Judges the paths of all cables in an accepted step of a study and counts them in CableStatistics. Nothing in
    Simbody 3.7 tells a subsystem of accepted steps: call it wherever the integrator returns, with
    setReturnEveryInternalStep(true) (and under a TimeStepper setReportAllSignificantStates(true)).
    Realizes the state to Position if it is not yet. */
    void countStep(const SimTK::State& state) const;

private:
    friend class Cable;
    CablePathSubsystemImpl& updImpl();
    const CablePathSubsystemImpl& getImpl() const;
};

}  // namespace tautline
