// SPDX-License-Identifier: Apache-2.0
#include "contact_event_handler.h"

#include "cable_impl.h"

namespace tautline {
namespace {

/** An event is localized to accuracy x time scale x this window: 1e-11 s at accuracy 0.1 and Simbody's time scale of
0.1 s, so that even speeds of 100 m/s cross the contact by no more than 1e-9 m. */
constexpr SimTK::Real kLocalizationWindow = 1e-9;

}  // namespace

CableEventHandler::CableEventHandler(const CableImpl& cable)
    : TriggeredEventHandler(SimTK::Stage::Position), m_cable(cable) {
    getTriggerInfo().setTriggerOnRisingSignTransition(false).setRequiredLocalizationTimeWindow(kLocalizationWindow);
}

void CableEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleContactEvent(state);
}

SimTK::Real StabilityEventHandler::getValue(const SimTK::State& state) const {
    return m_cable.isDisabled(state) ? 1 : m_cable.calcStabilityWitness(state);
}

SimTK::Real ContactEventHandler::getValue(const SimTK::State& state) const {
    return m_cable.isDisabled(state) ? 1 : m_cable.calcWitness(state, m_element);
}

SimTK::Real SplitEventHandler::getValue(const SimTK::State& state) const {
    return m_cable.isDisabled(state) ? 1 : m_cable.calcSplitWitness(state, m_element);
}

void SplitEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.reportSplit(state, m_element);
}

ConditionEventHandler::ConditionEventHandler(const CableImpl& cable, CableElementIndex point)
    : ElementEventHandler(cable, point) {
    getTriggerInfo().setTriggerOnRisingSignTransition(true);  // both ways
}

/** A jump from -1 to 1: the event finder halves its interval. */
SimTK::Real ConditionEventHandler::getValue(const SimTK::State& state) const {
    return m_cable.isDisabled(state) || m_cable.getElements().get(m_element).isActive(state) ? 1 : -1;
}

}  // namespace tautline
