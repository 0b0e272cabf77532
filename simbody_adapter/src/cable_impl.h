// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>
#include <string>
#include <vector>

#include "cable_counters.h"
#include "cable_elements.h"
#include "cable_path_state.h"
#include "tautline/simbody/cable.h"

namespace tautline {

/** What stands behind a Cable handle. */
class CableImpl {
public:
    CableImpl(CableSubsystemImpl& cables, CableIndex index, std::string name);
    CableImpl(const CableImpl&) = delete;

    void setEnds(CableElement origin, CableElement insertion);
    CableElementIndex insertElement(CableElement element);
    void setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station);
    void setCondition(CableElementIndex obstacle, std::function<bool(const SimTK::State&)> isActive);
    void setHint(CableElementIndex obstacle, const StartHint& hint);
    void setOptions(const PathSolverOptions& options);
    void setDisabledByDefault(bool isDisabled);
    void setListener(std::function<void(const ContactEvent&)> listener) { m_listener = std::move(listener); }

    const std::string& getName() const { return m_name; }
    CableIndex getIndex() const { return m_index; }
    const CableSubsystemImpl& getSubsystemImpl() const { return m_cables; }
    const PathSolverOptions& getOptions() const { return m_options; }
    bool isDisabledByDefault() const { return m_defaultMode.isDisabled; }
    const CableElements& getElements() const { return m_elements; }

    void realizeTopology(SimTK::State& state);
    void realizePosition(const SimTK::State& state) const;
    void realizeVelocity(const SimTK::State& state) const;

    const CablePathState& getPathState() const { return m_state; }
    bool isDisabled(const SimTK::State& state) const { return m_state.getMode(state).isDisabled; }
    void setDisabled(SimTK::State& state, bool isDisabled) const;

    /** @param method   of the API, for the message if the state is not realized to Position */
    const PathSolution& getPath(const SimTK::State& state, const char* method) const;
    /** Of getPath(), which must have been asked for before. */
    const PathPose& getPose(const SimTK::State& state) const { return m_state.getPath(state).pose; }
    const PathProblem& getProblem() const { return m_problem; }
    SimTK::Real getLengthRate(const SimTK::State& state) const;
    SimTK::Real getLengthAccelerationBias(const SimTK::State& state) const;
    SimTK::Real calcWitness(const SimTK::State& state, CableElementIndex obstacle) const;
    SimTK::Real calcSplitWitness(const SimTK::State& state, CableElementIndex obstacle) const;
    void reportSplit(const SimTK::State& state, CableElementIndex obstacle) const;
    SimTK::Real calcStabilityWitness(const SimTK::State& state) const;
    /** About element origins, in ground. */
    const std::vector<SpatialForce>& getElementForces(const SimTK::State& state, const char* method) const;
    void addBodyForces(const SimTK::State& state, SimTK::Real tension, SimTK::Vector_<SimTK::SpatialVec>& bodyForces,
                       const char* method) const;
    void addMobilityForces(const SimTK::State& state, SimTK::Real tension, SimTK::Vector& mobilityForces,
                           const char* method) const;

    /** The path of this state with all contacts settled, as a study starts from it. */
    TrackedPath calcSettledPath(const SimTK::State& state) const;
    void keepContacts(SimTK::State& state, const TrackedPath& path) const;
    void releaseContacts(SimTK::State& state) const;
    void handleContactEvent(SimTK::State& state) const;

    /** With all conditions judged, contacts fixed or not. */
    PathStatus calcStatus(const SimTK::State& state) const;
    std::string explainStatus(const SimTK::State& state) const;
    void countStep(const SimTK::State& state) const;

    CableStatistics getStatistics() const { return m_counters.getStatistics(); }
    void resetStatistics() const { m_counters.reset(); }

private:
    SimTK::Real calcLengthAccelerationBias(const SimTK::State& state, const CablePath& path) const;
    void solve(const SimTK::State& state, CablePath& path) const;
    void realizeMotion(const SimTK::State& state) const;
    /** Stage: Velocity, of the cables too. */
    const PathMotion& getMotion(const SimTK::State& state) const;
    void setStart(SimTK::State& state, const TrackedPath& path) const;
    TrackedPath calcPathBeforeSwitch(const SimTK::State& state) const;
    void report(const std::vector<PathEvent>& events, const PathSolution& before, const TrackedPath& after,
                const PathMotion& motion) const;

    CableSubsystemImpl& m_cables;
    CableIndex m_index;
    std::string m_name;
    CableElements m_elements;
    PathSolverOptions m_options;
    CableMode m_defaultMode;
    bool m_isStabilityWatched = false;  ///< one event handler for all obstacles
    std::function<void(const ContactEvent&)> m_listener;

    PathProblem m_problem;  ///< built at Topology
    CablePathState m_state;
    mutable CableCounters m_counters;
};

}  // namespace tautline
