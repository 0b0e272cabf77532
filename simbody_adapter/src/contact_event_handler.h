// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Watches a cable at Stage::Position, by default for a witness that falls through zero, and then settles its contacts.
Added to the System, not allocated in the CableSubsystem: Simbody 3.7 mixes up the witnesses of a subsystem of one's own
with those of a user's handlers at later stages. */
class CableEventHandler : public SimTK::TriggeredEventHandler {
public:
    explicit CableEventHandler(const CableImpl& cable);
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

protected:
    const CableImpl& m_cable;
};

/** Watches whether the path as a whole still holds: that it can be found with its contacts kept, and is no saddle. */
class StabilityEventHandler : public CableEventHandler {
public:
    using CableEventHandler::CableEventHandler;
    SimTK::Real getValue(const SimTK::State& state) const override;
};

/** Watches one element. */
class ElementEventHandler : public CableEventHandler {
public:
    ElementEventHandler(const CableImpl& cable, CableElementIndex element)
        : CableEventHandler(cable), m_element(element) {}

protected:
    CableElementIndex m_element;
};

/** Changes the contact of an obstacle. */
class ContactEventHandler : public ElementEventHandler {
public:
    using ElementEventHandler::ElementEventHandler;
    SimTK::Real getValue(const SimTK::State& state) const override;
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
};

}  // namespace tautline
