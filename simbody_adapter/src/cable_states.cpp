// SPDX-License-Identifier: Apache-2.0
#include "cable_states.h"

#include <utility>

namespace tautline {

using SimTK::Real;
using SimTK::Stage;
using SimTK::State;
using SimTK::Value;

namespace {

using Modes = std::vector<CableMode>;
using Paths = std::vector<SharedPath>;
using Reals = std::vector<Real>;

/** Value<T>::downcast() looks the type up at each call, which for many cables costs as much as a solve. */
template <class T>
const T& as(const SimTK::AbstractValue& value) {
    return static_cast<const Value<T>&>(value).get();
}
template <class T>
T& updAs(SimTK::AbstractValue& value) {
    return static_cast<Value<T>&>(value).upd();
}

}  // namespace

const CablePath& SharedPath::get() const {
    static const CablePath kEmpty;
    return m_path ? *m_path : kEmpty;
}

CablePath& SharedPath::updScratch(CablePathPool& pool) {
    // Where the count is one, no other thread can come to raise it: it would have to hold the path already.
    if (!m_path || m_path.use_count() > 1) m_path = pool.take();
    return *m_path;
}

void CableStates::allocate(const SimTK::Subsystem::Guts& cables, State& state, std::vector<CableMode> defaultModes) {
    m_cables = &cables;
    m_numCables = static_cast<int>(defaultModes.size());
    m_modes = cables.allocateDiscreteVariable(state, Stage::Position, new Value<Modes>(std::move(defaultModes)));
    m_paths = cables.allocateAutoUpdateDiscreteVariable(state, Stage::Position, new Value<Paths>(Paths(m_numCables)),
                                                        Stage::Position);
    m_motions = cables.allocateAutoUpdateDiscreteVariable(state, Stage::Position, new Value<BodyMotions>(BodyMotions()),
                                                          Stage::Velocity);
    m_rates = cables.allocateLazyCacheEntry(state, Stage::Velocity, new Value<Reals>(Reals()));
    m_biases = cables.allocateLazyCacheEntry(state, Stage::Velocity, new Value<Reals>(Reals()));
    m_changeTime = cables.allocateLazyCacheEntry(state, Stage::Topology, new Value<Real>(SimTK::NaN));
}

void CableStates::requireTopology(const State& state) const {
    // All that Cable does with a State begins here.
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), Stage(Stage::Topology), "Cable");
    const bool isCurrent =
        m_cables && m_cables->subsystemTopologyHasBeenRealized() &&
        state.getSystemTopologyStageVersion() == m_cables->getSystem().getSystemTopologyCacheVersion();
    SimTK_ERRCHK_ALWAYS(isCurrent, "Cable",
                        "the System was changed after this State was made: call realizeTopology() and go on with the "
                        "State that it returns");
}

const CableMode& CableStates::getMode(const State& state, int cable) const {
    requireTopology(state);
    return as<Modes>(m_cables->getDiscreteVariable(state, m_modes))[cable];
}

CableMode& CableStates::updMode(State& state, int cable) const {
    requireTopology(state);
    return updAs<Modes>(m_cables->updDiscreteVariable(state, m_modes))[cable];
}

CableStates::All CableStates::updAll(const State& state) const {
    requireTopology(state);
    return {as<Modes>(m_cables->getDiscreteVariable(state, m_modes)),
            as<Paths>(m_cables->getDiscreteVariable(state, m_paths)),
            updAs<Paths>(m_cables->updDiscreteVarUpdateValue(state, m_paths))};
}

const SharedPath& CableStates::getStart(const State& state, int cable) const {
    return as<Paths>(m_cables->getDiscreteVariable(state, m_paths))[cable];
}

SharedPath& CableStates::updStart(State& state, int cable) const {
    return updAs<Paths>(m_cables->updDiscreteVariable(state, m_paths))[cable];
}

std::vector<SharedPath>& CableStates::updStarts(State& state) const {
    return updAs<Paths>(m_cables->updDiscreteVariable(state, m_paths));
}

bool CableStates::arePathsRealized(const State& state) const {
    return m_cables->isDiscreteVarUpdateValueRealized(state, m_paths);
}

void CableStates::markPathsRealized(const State& state) const {
    m_cables->markDiscreteVarUpdateValueRealized(state, m_paths);
}

const SharedPath& CableStates::getPath(const State& state, int cable) const {
    return as<Paths>(m_cables->getDiscreteVarUpdateValue(state, m_paths))[cable];
}

SharedPath& CableStates::updPath(const State& state, int cable) const {
    return updAs<Paths>(m_cables->updDiscreteVarUpdateValue(state, m_paths))[cable];
}

const BodyMotions& CableStates::getStartMotions(const State& state) const {
    return as<BodyMotions>(m_cables->getDiscreteVariable(state, m_motions));
}

BodyMotions& CableStates::updStartMotions(State& state) const {
    return updAs<BodyMotions>(m_cables->updDiscreteVariable(state, m_motions));
}

bool CableStates::areMotionsRealized(const State& state) const {
    return m_cables->isDiscreteVarUpdateValueRealized(state, m_motions);
}

void CableStates::markMotionsRealized(const State& state) const {
    m_cables->markDiscreteVarUpdateValueRealized(state, m_motions);
}

const BodyMotions& CableStates::getMotions(const State& state) const {
    return as<BodyMotions>(m_cables->getDiscreteVarUpdateValue(state, m_motions));
}

BodyMotions& CableStates::updMotions(const State& state) const {
    return updAs<BodyMotions>(m_cables->updDiscreteVarUpdateValue(state, m_motions));
}

Real& CableStates::updRate(const State& state, int cable) const {
    return updLazy(state, m_rates, cable);
}

Real& CableStates::updBias(const State& state, int cable) const {
    return updLazy(state, m_biases, cable);
}

Real& CableStates::updChangeTime(const State& state) const {
    return updAs<Real>(m_cables->updCacheEntry(state, m_changeTime));
}

Real& CableStates::updLazy(const State& state, SimTK::CacheEntryIndex entry, int cable) const {
    Reals& values = updAs<Reals>(m_cables->updCacheEntry(state, entry));
    if (!m_cables->isCacheValueRealized(state, entry)) {
        values.assign(m_numCables, SimTK::NaN);
        m_cables->markCacheValueRealized(state, entry);
    }
    return values[cable];
}

}  // namespace tautline
