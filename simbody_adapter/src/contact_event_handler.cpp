// SPDX-License-Identifier: Apache-2.0
#include "contact_event_handler.h"

#include <algorithm>
#include <cmath>

#include "cable_path_subsystem_impl.h"

namespace tautline {
namespace {

/** Times accuracy and time scale: 1e-9 s at accuracy 1e-6 and Simbody's time scale of 0.1 s. The error of the step puts
an event farther off. */
constexpr SimTK::Real kEventWindow = 1e-2;
/** The narrowest that doubles tell apart. */
constexpr SimTK::Real kNarrowest = 1e-9;

}  // namespace

ContactEventHandler::ContactEventHandler(const CableImpl& cable)
    : TriggeredEventHandler(SimTK::Stage::Position), m_cable(cable) {
    getTriggerInfo().setTriggerOnRisingSignTransition(false).setRequiredLocalizationTimeWindow(kEventWindow);
}

SimTK::Real ContactEventHandler::getValue(const SimTK::State& state) const {
    const CablePath* path = m_cable.findKeptPath(state);
    return path ? std::min({path->contactWitness, path->splitWitness, path->stabilityWitness}) : 1;
}

void ContactEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleContactEvent(state);
}

BreachEventHandler::BreachEventHandler(const CableImpl& cable)
    : TriggeredEventHandler(SimTK::Stage::Position), m_cable(cable) {
    getTriggerInfo().setTriggerOnRisingSignTransition(false).setRequiredLocalizationTimeWindow(kNarrowest);
}

SimTK::Real BreachEventHandler::getValue(const SimTK::State& state) const {
    const CablePath* path = m_cable.findKeptPath(state);
    return path ? path->breachWitness + kDeepest : 1;
}

/** Where the witness of contact has triggered too, it has been handled. */
void BreachEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleBrokenContacts(state);
}

SimTK::Real SettlingEventHandler::getNextEventTime(const SimTK::State& state, bool includeCurrentTime) const {
    constexpr SimTK::Real kMoment = 1e-12;  // [s] and relative: the least that integrators step
    if (!m_cables.needsSettling(state)) return SimTK::Infinity;
    const SimTK::Real time = state.getTime();
    return includeCurrentTime ? time : time + kMoment * std::max(SimTK::Real(1), std::abs(time));
}

void SettlingEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cables.settle(state);
}

ConditionEventHandler::ConditionEventHandler(const CableImpl& cable, CableElementIndex point)
    : TriggeredEventHandler(SimTK::Stage::Position), m_cable(cable), m_point(point) {
    // Both ways.
    getTriggerInfo().setTriggerOnRisingSignTransition(true).setRequiredLocalizationTimeWindow(kNarrowest);
}

/** A jump from -1 to 1: the event finder halves its interval. The pose of the path knows what the condition says. */
SimTK::Real ConditionEventHandler::getValue(const SimTK::State& state) const {
    if (m_cable.isDisabled(state)) return 1;
    m_cable.getPath(state, "cable event handler");
    return m_cable.getPose(state).hasElement(m_point) ? 1 : -1;
}

void ConditionEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleContactEvent(state);
}

}  // namespace tautline
