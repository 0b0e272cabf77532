// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Watches all contacts of a cable at once at Stage::Position, how many arcs they have, and whether the path as a whole
still holds: that it can be found with its contacts kept, and is no saddle. The lowest of these witnesses, which were
computed with the path. (One for all cables would cost a copy of a State less, and event finding more: it has a kink
wherever another cable's is the lowest.)

Added to the System, not allocated in the CablePathSubsystem: Simbody 3.7 mixes up the witnesses of a subsystem of one's own
with those of a user's handlers at later stages. */
class ContactEventHandler : public SimTK::TriggeredEventHandler {
public:
    explicit ContactEventHandler(const CableImpl& cable);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CableImpl& m_cable;
};

/** Ends the search for an event, not by time but by what it is for: that nothing jumps.

Simbody narrows the window of an event until it is as narrow as all witnesses demand that change sign across it. This
one is that of contact plus kDeepest, and demands the narrowest window: while the path of the window's late end is
kDeepest below contact the search goes on, and when it is not, this witness is above zero at both ends and has no say.
The late end is where the event is handled. In a speed v across a contact of size R the contact is then made

    w R <= kDeepest R late, in depth or arc length; lengths jump by O(w^2) R, rates by O(w) v,

at any speed, in as many steps as that takes; a fixed window of time would be too wide for a fast motion, and for a slow
one narrower than doubles tell apart. The witness of contact itself asks for kEventWindow, so that the time of an event
is as exact as the study where the motion is so slow that kDeepest says little. */
class BreachEventHandler : public SimTK::TriggeredEventHandler {
public:
    static constexpr SimTK::Real kDeepest = 1e-9;  ///< in sizes of the surface

    explicit BreachEventHandler(const CableImpl& cable);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CableImpl& m_cable;
};

/** Mends what other handlers leave behind. A witness that is below zero when a step begins never triggers: where a
user's handler has moved a body, the contacts of before would stay for the rest of the study. A TimeStepper asks for
scheduled events whenever it goes on, and gets one at once where the paths were invalidated since they were last
realized, and do not hold now; a moment later, since events at one time come once, if there was one already. */
class SettlingEventHandler : public SimTK::ScheduledEventHandler {
public:
    explicit SettlingEventHandler(const CablePathSubsystemImpl& cables) : m_cables(cables) {}
    SimTK::Real getNextEventTime(const SimTK::State& state, bool includeCurrentTime) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CablePathSubsystemImpl& m_cables;
};

/** Stops a step where the condition of a point changes, since the length jumps there, and lets the contacts that
this changes settle. */
class ConditionEventHandler : public SimTK::TriggeredEventHandler {
public:
    ConditionEventHandler(const CableImpl& cable, CableElementIndex point);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CableImpl& m_cable;
    CableElementIndex m_point;
};

}  // namespace tautline
