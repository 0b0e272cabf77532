// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_path_subsystem.h"

#include <algorithm>
#include <optional>

#include "cable_path_subsystem_impl.h"
#include "contact_event_handler.h"
#include "tautline/error.h"
#include "tautline/simbody/cable_decorations.h"

namespace tautline {

using SimTK::Stage;
using SimTK::State;

CablePathSubsystem::CablePathSubsystem(SimTK::MultibodySystem& system) {
    adoptSubsystemGuts(new CablePathSubsystemImpl());
    system.adoptSubsystem(*this);
    system.addEventHandler(new SettlingEventHandler(getImpl()));
}

int CablePathSubsystem::getNumCables() const {
    return getImpl().getNumCables();
}

const Cable& CablePathSubsystem::getCable(CableIndex cable) const {
    // Handles are the same for readers and writers.
    return const_cast<CablePathSubsystemImpl&>(getImpl()).updCable(cable);
}

Cable& CablePathSubsystem::updCable(CableIndex cable) {
    return updImpl().updCable(cable);
}

const Cable& CablePathSubsystem::getCable(const std::string& name) const {
    return const_cast<CablePathSubsystemImpl&>(getImpl()).updCable(name);
}

const SimTK::MultibodySystem& CablePathSubsystem::getMultibodySystem() const {
    return getImpl().getMultibodySystem();
}

void CablePathSubsystem::setDefaultContactMode(ContactMode mode) {
    updImpl().setDefaultContactMode(mode);
}

ContactMode CablePathSubsystem::getDefaultContactMode() const {
    return getImpl().getDefaultContactMode();
}

void CablePathSubsystem::setContactMode(State& state, ContactMode mode) const {
    for (CableIndex c(0); c < getNumCables(); ++c) getCable(c).setContactMode(state, mode);
}

void CablePathSubsystem::acceptPaths(State& state) const {
    getImpl().acceptPaths(state);
}

void CablePathSubsystem::forgetPaths(State& state) const {
    getImpl().forgetPaths(state);
}

void CablePathSubsystem::setShowDecorations(bool shows) {
    updImpl().setShowDecorations(shows);
}

bool CablePathSubsystem::getShowDecorations() const {
    return getImpl().getShowDecorations();
}

void CablePathSubsystem::countStep(const State& state) const {
    getImpl().countStep(state);
}

CablePathSubsystemImpl& CablePathSubsystem::updImpl() {
    return dynamic_cast<CablePathSubsystemImpl&>(updSubsystemGuts());
}

const CablePathSubsystemImpl& CablePathSubsystem::getImpl() const {
    return dynamic_cast<const CablePathSubsystemImpl&>(getSubsystemGuts());
}

namespace {

bool haveSameOptions(const PathSolverOptions& a, const PathSolverOptions& b) {
    return a.pathErrorTolerance == b.pathErrorTolerance && a.maxIterations == b.maxIterations &&
           a.allowsColdStart == b.allowsColdStart && a.comparesWithCold == b.comparesWithCold &&
           a.geodesics.accuracy == b.geodesics.accuracy && a.geodesics.maxSteps == b.geodesics.maxSteps;
}

}  // namespace

CablePathSubsystemImpl::CablePathSubsystemImpl() : Guts("CablePathSubsystem", "0.1.0") {}
CablePathSubsystemImpl::~CablePathSubsystemImpl() = default;

const SimTK::MultibodySystem& CablePathSubsystemImpl::getMultibodySystem() const {
    return SimTK::MultibodySystem::downcast(getSystem());
}

/** Simbody finds it by two dynamic casts at each call, which cost more than a straight path. */
const SimTK::SimbodyMatterSubsystem& CablePathSubsystemImpl::getMatter() const {
    return m_matter ? *m_matter : getMultibodySystem().getMatterSubsystem();
}

CableImpl& CablePathSubsystemImpl::addCable(std::string name) {
    const CableIndex index(getNumCables());
    if (name.empty()) name = "cable" + std::to_string(index);
    for (const std::unique_ptr<CableImpl>& cable : m_impls)
        require(cable->getName() != name, "cable subsystem: there is a cable '", name, "' already");
    m_impls.push_back(std::make_unique<CableImpl>(*this, index, std::move(name)));
    m_handles.push_back(Cable(m_impls.back().get()));
    invalidateSubsystemTopologyCache();
    return *m_impls.back();
}

Cable& CablePathSubsystemImpl::updCable(CableIndex cable) {
    require(cable.isValid() && cable < getNumCables(), "cable subsystem: no cable ", static_cast<int>(cable), " of ",
            getNumCables());
    return m_handles[cable];
}

Cable& CablePathSubsystemImpl::updCable(const std::string& name) {
    for (const std::unique_ptr<CableImpl>& cable : m_impls)
        if (cable->getName() == name) return m_handles[cable->getIndex()];
    throw InvalidInput("cable subsystem: no cable '" + name + "'");
}

void CablePathSubsystemImpl::setDefaultContactMode(ContactMode mode) {
    m_defaultContactMode = mode;
    invalidateSubsystemTopologyCache();
}

void CablePathSubsystemImpl::ensureStage(const State& state, Stage stage, const char* method) const {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), Stage(Stage::Topology), method);
    if (getStage(state) >= stage) return;
    SimTK_STAGECHECK_GE_ALWAYS(getMatter().getStage(state), stage, method);
    SimTK_STAGECHECK_GE_ALWAYS(getStage(state), Stage(Stage::Time), method);
    realizeSubsystemPosition(state);
    if (stage > Stage::Position) realizeSubsystemVelocity(state);
}

/** A System with cables is not copied: its forces and event handlers would still mean the old cables. */
CablePathSubsystemImpl* CablePathSubsystemImpl::cloneImpl() const {
    throw InvalidInput("cable subsystem: a system with cables cannot be copied");
}

/** Cables with the same options share their workspaces. */
int CablePathSubsystemImpl::realizeSubsystemTopologyImpl(State& state) const {
    auto& self =
        const_cast<CablePathSubsystemImpl&>(*this);  // the topology is what Simbody caches in the System itself
    self.m_matter = &getMultibodySystem().getMatterSubsystem();
    self.m_workspaces.clear();
    std::vector<CableMode> modes;
    for (const std::unique_ptr<CableImpl>& cable : m_impls) {
        const PathSolverOptions& options = cable->getOptions();
        auto found = std::find_if(m_workspaces.begin(), m_workspaces.end(), [&](const auto& workspaces) {
            return haveSameOptions(workspaces->getOptions(), options);
        });
        if (found == m_workspaces.end())
            found = self.m_workspaces.insert(m_workspaces.end(), std::make_unique<CableWorkspaces>(options));
        cable->realizeTopology(**found);
        modes.push_back(cable->getDefaultMode());
    }
    self.m_states.allocate(*this, state, std::move(modes));
    return 0;
}

int CablePathSubsystemImpl::realizeSubsystemPositionImpl(const State& state) const {
    realizePaths(state);
    return 0;
}

int CablePathSubsystemImpl::realizeSubsystemVelocityImpl(const State& state) const {
    realizeMotions(state);
    return 0;
}

void CablePathSubsystemImpl::realizePaths(const State& state) const {
    if (m_states.arePathsRealized(state)) return;
    const CableStates::All all = m_states.updAll(state);
    const SimTK::SimbodyMatterSubsystem& matter = getMatter();
    std::vector<SimTK::Transform> X_GB;
    X_GB.reserve(static_cast<std::size_t>(matter.getNumBodies()));
    for (SimTK::MobilizedBodyIndex b(0); b < matter.getNumBodies(); ++b)
        X_GB.push_back(matter.getMobilizedBody(b).getBodyTransform(state));
    std::optional<CableWorkspaces::Loan> workspace;
    const CableWorkspaces* lender = nullptr;
    for (const std::unique_ptr<CableImpl>& cable : m_impls) {
        if (lender != &cable->updWorkspaces()) workspace.emplace(cable->updWorkspaces().lend());
        lender = &cable->updWorkspaces();
        cable->realizePath(state, all, X_GB, **workspace);
    }
    m_states.markPathsRealized(state);
}

void CablePathSubsystemImpl::realizeMotions(const State& state) const {
    if (m_states.areMotionsRealized(state)) return;
    BodyMotions& motions = m_states.updMotions(state);
    const SimTK::SimbodyMatterSubsystem& matter = getMatter();
    motions.time = state.getTime();
    motions.V_GB.resize(matter.getNumBodies());
    for (SimTK::MobilizedBodyIndex b(0); b < matter.getNumBodies(); ++b)
        motions.V_GB[b] = matter.getMobilizedBody(b).getBodyVelocity(state);
    m_states.markMotionsRealized(state);
}

void CablePathSubsystemImpl::acceptPaths(State& state) const {
    ensureStage(state, Stage::Position, "CablePathSubsystem::acceptPaths()");
    realizePaths(state);
    startFromPaths(state, [](const CableImpl&, const CablePath&) { return true; });
}

void CablePathSubsystemImpl::forgetPaths(State& state) const {
    for (SharedPath& start : m_states.updStarts(state)) start = SharedPath();
}

void CablePathSubsystemImpl::acceptHoldingPaths(State& state) const {
    realizePaths(state);
    const BodyMotions motions = m_states.getMotions(state);
    startFromPaths(state, [](const CableImpl& cable, const CablePath& path) { return cable.isHolding(path); });
    m_states.updStartMotions(state) = motions;
}

/** By exchange, as an integrator does, so that the next solve overwrites what the last began with. */
template <class Predicate>
void CablePathSubsystemImpl::startFromPaths(State& state, Predicate isTaken) const {
    std::vector<SharedPath>& starts = m_states.updStarts(state);
    for (std::size_t i = 0; i < m_impls.size(); ++i) {
        SharedPath& path = m_states.updPath(state, static_cast<int>(i));
        if (!m_impls[i]->isDisabled(state) && isTaken(*m_impls[i], path.get())) std::swap(starts[i], path);
    }
}

bool CablePathSubsystemImpl::needsSettling(const State& state) const {
    const auto keepsContacts = [&](const std::unique_ptr<CableImpl>& cable) { return cable->keepsContacts(state); };
    if (std::none_of(m_impls.begin(), m_impls.end(), keepsContacts)) return false;
    if (!m_states.arePathsRealized(state)) m_states.updChangeTime(state) = state.getTime();
    if (m_states.updChangeTime(state) != state.getTime()) return false;
    getSystem().realize(state, Stage::Position);
    realizePaths(state);
    return std::any_of(m_impls.begin(), m_impls.end(),
                       [&](const std::unique_ptr<CableImpl>& cable) { return cable->isUnsettled(state); });
}

void CablePathSubsystemImpl::settle(State& state) const {
    for (const std::unique_ptr<CableImpl>& cable : m_impls) cable->handleBrokenContacts(state);
}

/** Simbody asks at each stage for what is known then. */
int CablePathSubsystemImpl::calcDecorativeGeometryAndAppendImpl(
    const State& state, Stage stage, SimTK::Array_<SimTK::DecorativeGeometry>& geometry) const {
    if (!m_showsDecorations || stage != Stage::Position) return 0;
    // The System's own handle is a plain Subsystem; ours adds no data to it.
    if (!m_decorations)
        m_decorations =
            std::make_unique<CableDecorations>(static_cast<const CablePathSubsystem&>(getOwnerSubsystemHandle()));
    m_decorations->generateDecorations(state, geometry);
    return 0;
}

void CablePathSubsystemImpl::countStep(const State& state) const {
    getSystem().realize(state, Stage::Position);
    for (const std::unique_ptr<CableImpl>& cable : m_impls)
        if (!cable->isDisabled(state)) cable->countStep(state);
}

void CablePathSubsystemImpl::handleEventsImpl(State& state, SimTK::Event::Cause cause,
                                              const SimTK::Array_<SimTK::EventId>&, const SimTK::HandleEventsOptions&,
                                              SimTK::HandleEventsResults& results) const {
    if (cause != SimTK::Event::Cause::Initialization) return;
    getSystem().realize(state, Stage::Position);
    // All paths first: each change of the State below would have the free ones solved anew.
    std::vector<TrackedPath> paths(m_impls.size());
    for (std::size_t i = 0; i < m_impls.size(); ++i)
        if (m_impls[i]->hasEvents(state)) paths[i] = m_impls[i]->calcSettledPath(state);
    for (std::size_t i = 0; i < m_impls.size(); ++i)
        if (!paths[i].solution.isEmpty() && paths[i].solution.status != PathStatus::NotConverged)
            m_impls[i]->keepContacts(state, paths[i]);
    results.setAnyChangeMade(true);
}

}  // namespace tautline
