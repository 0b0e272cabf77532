// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_subsystem.h"

#include "cable_subsystem_impl.h"
#include "tautline/error.h"

namespace tautline {

using SimTK::Stage;
using SimTK::State;

CableSubsystem::CableSubsystem(SimTK::MultibodySystem& system) {
    adoptSubsystemGuts(new CableSubsystemImpl());
    system.adoptSubsystem(*this);
}

int CableSubsystem::getNumCables() const {
    return getImpl().getNumCables();
}

const Cable& CableSubsystem::getCable(CableIndex cable) const {
    // Handles are the same for readers and writers.
    return const_cast<CableSubsystemImpl&>(getImpl()).updCable(cable);
}

Cable& CableSubsystem::updCable(CableIndex cable) {
    return updImpl().updCable(cable);
}

const SimTK::MultibodySystem& CableSubsystem::getMultibodySystem() const {
    return getImpl().getMultibodySystem();
}

void CableSubsystem::countStep(const State& state) const {
    getImpl().countStep(state);
}

CableSubsystemImpl& CableSubsystem::updImpl() {
    return dynamic_cast<CableSubsystemImpl&>(updSubsystemGuts());
}

const CableSubsystemImpl& CableSubsystem::getImpl() const {
    return dynamic_cast<const CableSubsystemImpl&>(getSubsystemGuts());
}

const SimTK::MultibodySystem& CableSubsystemImpl::getMultibodySystem() const {
    return SimTK::MultibodySystem::downcast(getSystem());
}

const SimTK::SimbodyMatterSubsystem& CableSubsystemImpl::getMatter() const {
    return getMultibodySystem().getMatterSubsystem();
}

CableImpl& CableSubsystemImpl::addCable(std::string name) {
    const CableIndex index(getNumCables());
    m_impls.push_back(std::make_unique<CableImpl>(*this, index, std::move(name)));
    m_handles.push_back(Cable(m_impls.back().get()));
    invalidateSubsystemTopologyCache();
    return *m_impls.back();
}

Cable& CableSubsystemImpl::updCable(CableIndex cable) {
    require(cable.isValid() && cable < getNumCables(), "cable subsystem: no cable ", static_cast<int>(cable), " of ",
            getNumCables());
    return m_handles[cable];
}

void CableSubsystemImpl::ensureStage(const State& state, Stage stage, const char* method) const {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), Stage(Stage::Topology), method);
    if (getStage(state) >= stage) return;
    SimTK_STAGECHECK_GE_ALWAYS(getMatter().getStage(state), stage, method);
    SimTK_STAGECHECK_GE_ALWAYS(getStage(state), Stage(Stage::Time), method);
    realizeSubsystemPosition(state);
    if (stage > Stage::Position) realizeSubsystemVelocity(state);
}

/** A System with cables is not copied: its forces and event handlers would still mean the old cables. */
CableSubsystemImpl* CableSubsystemImpl::cloneImpl() const {
    throw InvalidInput("cable subsystem: a system with cables cannot be copied");
}

int CableSubsystemImpl::realizeSubsystemTopologyImpl(State& state) const {
    for (const std::unique_ptr<CableImpl>& cable : m_impls) cable->realizeTopology(state);
    return 0;
}

int CableSubsystemImpl::realizeSubsystemPositionImpl(const State& state) const {
    for (const std::unique_ptr<CableImpl>& cable : m_impls) cable->realizePosition(state);
    return 0;
}

int CableSubsystemImpl::realizeSubsystemVelocityImpl(const State& state) const {
    for (const std::unique_ptr<CableImpl>& cable : m_impls) cable->realizeVelocity(state);
    return 0;
}

void CableSubsystemImpl::countStep(const State& state) const {
    getSystem().realize(state, Stage::Position);
    for (const std::unique_ptr<CableImpl>& cable : m_impls)
        if (!cable->isDisabled(state)) cable->countStep(state);
}

void CableSubsystemImpl::handleEventsImpl(State& state, SimTK::Event::Cause cause, const SimTK::Array_<SimTK::EventId>&,
                                          const SimTK::HandleEventsOptions&,
                                          SimTK::HandleEventsResults& results) const {
    if (cause != SimTK::Event::Cause::Initialization) return;
    getSystem().realize(state, Stage::Position);
    // All paths first: each change of the State below would have the free ones solved anew.
    std::vector<TrackedPath> paths(m_impls.size());
    for (std::size_t i = 0; i < m_impls.size(); ++i)
        if (!m_impls[i]->isDisabled(state)) paths[i] = m_impls[i]->calcSettledPath(state);
    for (std::size_t i = 0; i < m_impls.size(); ++i)
        if (!paths[i].solution.isEmpty() && paths[i].solution.status != PathStatus::NotConverged)
            m_impls[i]->keepContacts(state, paths[i]);
    results.setAnyChangeMade(true);
}

}  // namespace tautline
