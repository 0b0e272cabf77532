#include "contact_event_handler.h"

#include "cable_impl.h"

namespace tautline {
namespace {

/** An event is localized to accuracy x time scale x this window: 1e-10 s at accuracy 1e-3 and Simbody's
time scale of 0.1 s, so that speeds of m/s cross the contact by less than 1e-9 m. */
constexpr SimTK::Real kLocalizationWindow = 1e-6;

}  // namespace

ElementEventHandler::ElementEventHandler(const CableImpl& cable, CableElementIndex element)
    : TriggeredEventHandler(SimTK::Stage::Position), m_cable(cable), m_element(element) {
    getTriggerInfo().setTriggerOnRisingSignTransition(false).setRequiredLocalizationTimeWindow(kLocalizationWindow);
}

SimTK::Real ContactEventHandler::getValue(const SimTK::State& state) const {
    return m_cable.isDisabled(state) ? 1 : m_cable.calcWitness(state, m_element);
}

void ContactEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleContactEvent(state);
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
    return m_cable.isDisabled(state) || m_cable.getElement(m_element).isActive(state) ? 1 : -1;
}

void ConditionEventHandler::handleEvent(SimTK::State& state, SimTK::Real, bool&) const {
    m_cable.handleContactEvent(state);
}

}  // namespace tautline
