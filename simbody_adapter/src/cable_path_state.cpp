// SPDX-License-Identifier: Apache-2.0
#include "cable_path_state.h"

namespace tautline {

using SimTK::Stage;
using SimTK::State;
using SimTK::Value;

void CablePathState::allocate(const SimTK::Subsystem::Guts& cables, State& state, const CableMode& defaultMode,
                              const PathSolverOptions& options) {
    m_cables = &cables;
    m_mode = cables.allocateDiscreteVariable(state, Stage::Position, new Value<CableMode>(defaultMode));
    m_path = cables.allocateAutoUpdateDiscreteVariable(state, Stage::Position, new Value<CablePath>(CablePath()),
                                                       Stage::Position);
    m_motion = cables.allocateAutoUpdateDiscreteVariable(state, Stage::Position, new Value<PathMotion>(PathMotion()),
                                                         Stage::Velocity);
    m_rate = cables.allocateLazyCacheEntry(state, Stage::Velocity, new Value<SimTK::Real>(SimTK::NaN));
    m_bias = cables.allocateLazyCacheEntry(state, Stage::Velocity, new Value<SimTK::Real>(SimTK::NaN));
    m_workspace =
        cables.allocateLazyCacheEntry(state, Stage::Topology, new Value<CableWorkspace>(CableWorkspace(options)));
}

const CableMode& CablePathState::getMode(const State& state) const {
    // All that Cable does with a State begins here.
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), Stage(Stage::Topology), "Cable");
    return Value<CableMode>::downcast(m_cables->getDiscreteVariable(state, m_mode));
}

void CablePathState::setMode(State& state, const CableMode& mode) const {
    Value<CableMode>::updDowncast(m_cables->updDiscreteVariable(state, m_mode)) = mode;
}

const CablePath& CablePathState::getStart(const State& state) const {
    return Value<CablePath>::downcast(m_cables->getDiscreteVariable(state, m_path));
}

CablePath& CablePathState::updStart(State& state) const {
    return Value<CablePath>::updDowncast(m_cables->updDiscreteVariable(state, m_path));
}

bool CablePathState::isPathRealized(const State& state) const {
    return m_cables->isDiscreteVarUpdateValueRealized(state, m_path);
}

const CablePath& CablePathState::getPath(const State& state) const {
    return Value<CablePath>::downcast(m_cables->getDiscreteVarUpdateValue(state, m_path));
}

CablePath& CablePathState::updPath(const State& state) const {
    return Value<CablePath>::updDowncast(m_cables->updDiscreteVarUpdateValue(state, m_path));
}

void CablePathState::markPathRealized(const State& state) const {
    m_cables->markDiscreteVarUpdateValueRealized(state, m_path);
}

const PathMotion& CablePathState::getStartMotion(const State& state) const {
    return Value<PathMotion>::downcast(m_cables->getDiscreteVariable(state, m_motion));
}

PathMotion& CablePathState::updStartMotion(State& state) const {
    return Value<PathMotion>::updDowncast(m_cables->updDiscreteVariable(state, m_motion));
}

bool CablePathState::isMotionRealized(const State& state) const {
    return m_cables->isDiscreteVarUpdateValueRealized(state, m_motion);
}

const PathMotion& CablePathState::getMotion(const State& state) const {
    return Value<PathMotion>::downcast(m_cables->getDiscreteVarUpdateValue(state, m_motion));
}

PathMotion& CablePathState::updMotion(const State& state) const {
    return Value<PathMotion>::updDowncast(m_cables->updDiscreteVarUpdateValue(state, m_motion));
}

void CablePathState::markMotionRealized(const State& state) const {
    m_cables->markDiscreteVarUpdateValueRealized(state, m_motion);
}

bool CablePathState::isRateRealized(const State& state) const {
    return m_cables->isCacheValueRealized(state, m_rate);
}

SimTK::Real CablePathState::getRate(const State& state) const {
    return Value<SimTK::Real>::downcast(m_cables->getCacheEntry(state, m_rate));
}

void CablePathState::setRate(const State& state, SimTK::Real rate) const {
    Value<SimTK::Real>::updDowncast(m_cables->updCacheEntry(state, m_rate)) = rate;
    m_cables->markCacheValueRealized(state, m_rate);
}

bool CablePathState::isBiasRealized(const State& state) const {
    return m_cables->isCacheValueRealized(state, m_bias);
}

SimTK::Real CablePathState::getBias(const State& state) const {
    return Value<SimTK::Real>::downcast(m_cables->getCacheEntry(state, m_bias));
}

void CablePathState::setBias(const State& state, SimTK::Real bias) const {
    Value<SimTK::Real>::updDowncast(m_cables->updCacheEntry(state, m_bias)) = bias;
    m_cables->markCacheValueRealized(state, m_bias);
}

CableWorkspace& CablePathState::updWorkspace(const State& state) const {
    return Value<CableWorkspace>::updDowncast(m_cables->updCacheEntry(state, m_workspace));
}

}  // namespace tautline
