#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Watches one obstacle of one cable at Stage::Position and changes its contact. Added to the System, not
allocated in the CableSubsystem: Simbody 3.7 mixes up the witnesses of a subsystem of one's own with those
of a user's handlers at later stages. */
class ContactEventHandler : public SimTK::TriggeredEventHandler {
public:
    ContactEventHandler(const CableImpl& cable, CableElementIndex obstacle);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CableImpl& m_cable;
    CableElementIndex m_obstacle;
};

/** Watches whether one arc still describes how a surface that is not convex holds the cable, and reports where it no
longer does. */
class SplitEventHandler : public SimTK::TriggeredEventHandler {
public:
    SplitEventHandler(const CableImpl& cable, CableElementIndex obstacle);
    SimTK::Real getValue(const SimTK::State& state) const override;
    void handleEvent(SimTK::State& state, SimTK::Real accuracy, bool& shouldTerminate) const override;

private:
    const CableImpl& m_cable;
    CableElementIndex m_obstacle;
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
