#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Watches one element of one cable at Stage::Position, by default for a witness that falls through zero. Added to the
System, not allocated in the CableSubsystem: Simbody 3.7 mixes up the witnesses of a subsystem of one's own with those
of a user's handlers at later stages. */
class ElementEventHandler : public SimTK::TriggeredEventHandler {
public:
    ElementEventHandler(const CableImpl& cable, CableElementIndex element);

protected:
    const CableImpl& m_cable;
    CableElementIndex m_element;
};

/** Changes the contact of an obstacle. */
class ContactEventHandler : public ElementEventHandler {
public:
    using ElementEventHandler::ElementEventHandler;
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;
};

/** Watches whether one arc still describes how a surface that is not convex holds the cable, and reports where it no
longer does. */
class SplitEventHandler : public ElementEventHandler {
public:
    using ElementEventHandler::ElementEventHandler;
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;
};

/** Stops a step where the condition of a point changes, since the length jumps there, and lets the contacts that
this changes settle. */
class ConditionEventHandler : public ElementEventHandler {
public:
    ConditionEventHandler(const CableImpl& cable, CableElementIndex point);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;
};

}  // namespace tautline
