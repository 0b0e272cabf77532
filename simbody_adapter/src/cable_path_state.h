// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <vector>

#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_tracker.h"

namespace tautline {

/** How a cable's path is found in a State. */
struct CableMode {
    bool isDisabled = false;
    bool keepsContacts = false;  ///< false: found anew in every pose
};

/** A cable's path, the pose and time for which it was solved, and what it does there. */
struct CablePath : TrackedPath {
    std::vector<SpatialForce> forces;  ///< of unit tension on the elements, about their origins, in ground
};

/** Room for the solves of one cable in one State, kept in the State's cache so that States can be realized
side by side. Nothing in it changes an answer; the tracker's scratch is not worth copying. */
struct CableWorkspace {
    explicit CableWorkspace(const PathSolverOptions& options) : tracker(options) {}
    CableWorkspace(const CableWorkspace& source) : tracker(source.tracker.getOptions()) {}
    CableWorkspace& operator=(const CableWorkspace& source) {
        tracker = PathTracker(source.tracker.getOptions());
        return *this;
    }

    PathTracker tracker;
    PathSensitivity sensitivity;
    PathVariation variation;
};

/** Where a cable's variables and cache entries stand in a State.

Mode: a discrete variable that invalidates Position. Path: an auto-update discrete variable; its value is
the start of the next solve, contact set included, its update value the path of the present pose with its unit forces,
which a study swaps in when it accepts a step. Motion: another one, at Velocity; how the elements move where the next
solve starts. Rate and bias (of the second derivative): cached at Velocity. */
class CablePathState {
public:
    /** To be called from realizeTopology(). */
    void allocate(const SimTK::Subsystem::Guts& cables, SimTK::State& state, const CableMode& defaultMode,
                  const PathSolverOptions& options);

    /** Stage: Topology, as for all that follows. */
    const CableMode& getMode(const SimTK::State& state) const;
    void setMode(SimTK::State& state, const CableMode& mode) const;

    const CablePath& getStart(const SimTK::State& state) const;
    CablePath& updStart(SimTK::State& state) const;

    bool isPathRealized(const SimTK::State& state) const;
    const CablePath& getPath(const SimTK::State& state) const;
    CablePath& updPath(const SimTK::State& state) const;
    void markPathRealized(const SimTK::State& state) const;

    const PathMotion& getStartMotion(const SimTK::State& state) const;
    PathMotion& updStartMotion(SimTK::State& state) const;

    bool isMotionRealized(const SimTK::State& state) const;
    const PathMotion& getMotion(const SimTK::State& state) const;
    PathMotion& updMotion(const SimTK::State& state) const;
    void markMotionRealized(const SimTK::State& state) const;

    bool isRateRealized(const SimTK::State& state) const;
    SimTK::Real getRate(const SimTK::State& state) const;
    void setRate(const SimTK::State& state, SimTK::Real rate) const;

    bool isBiasRealized(const SimTK::State& state) const;
    SimTK::Real getBias(const SimTK::State& state) const;
    void setBias(const SimTK::State& state, SimTK::Real bias) const;

    CableWorkspace& updWorkspace(const SimTK::State& state) const;

private:
    const SimTK::Subsystem::Guts* m_cables = nullptr;
    SimTK::DiscreteVariableIndex m_mode, m_path, m_motion;
    SimTK::CacheEntryIndex m_rate, m_bias, m_workspace;
};

}  // namespace tautline
