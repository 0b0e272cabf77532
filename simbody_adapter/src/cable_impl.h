// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cable_counters.h"
#include "cable_elements.h"
#include "cable_path_pool.h"
#include "cable_states.h"
#include "cable_workspaces.h"
#include "tautline/simbody/cable.h"

namespace tautline {

/** What stands behind a Cable handle. */
class CableImpl {
public:
    CableImpl(CablePathSubsystemImpl& cables, CableIndex index, std::string name);
    CableImpl(const CableImpl&) = delete;

    void setEnds(CableElement origin, CableElement insertion);
    CableElementIndex insertElement(CableElement element);
    void setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station);
    void setOptions(const PathSolverOptions& options);
    void setDisabledByDefault(bool isDisabled);
    void setDefaultContactMode(ContactMode mode);
    void setElement(CableElementIndex index, CableElement element);
    void setListener(std::function<void(const ContactEvent&)> listener) { m_listener = std::move(listener); }

    const std::string& getName() const { return m_name; }
    CableIndex getIndex() const { return m_index; }
    const CablePathSubsystemImpl& getSubsystemImpl() const { return m_cables; }
    const PathSolverOptions& getOptions() const { return m_options; }
    bool isDisabledByDefault() const { return m_isDisabledByDefault; }
    /** With that of the subsystem where the cable has none of its own. */
    CableMode getDefaultMode() const;
    const CableElements& getElements() const { return m_elements; }

    void realizeTopology(CableWorkspaces& workspaces);
    CableWorkspaces& updWorkspaces() const { return *m_workspaces; }
    /** The path of this pose, solved only if it is not known already. @param X_GB   of all bodies */
    void realizePath(const SimTK::State& state, const CableStates::All& all, const std::vector<SimTK::Transform>& X_GB,
                     CableWorkspace& workspace) const;

    bool isDisabled(const SimTK::State& state) const { return getMode(state).isDisabled; }
    void setDisabled(SimTK::State& state, bool isDisabled) const;
    ContactMode getContactMode(const SimTK::State& state) const { return getMode(state).contacts; }
    void setContactMode(SimTK::State& state, ContactMode mode) const;
    bool areContactsFixed(const SimTK::State& state) const { return getMode(state).keepsContacts; }
    /** Fixed, and the cable not disabled. */
    bool keepsContacts(const SimTK::State& state) const;
    /** A study that begins fixes the contacts of such a cable. */
    bool hasEvents(const SimTK::State& state) const;

    /** @param method   of the API, for the message if the state is not realized to Position */
    const PathSolution& getPath(const SimTK::State& state, const char* method) const;
    /** Of getPath(), which must have been asked for before. */
    const PathPose& getPose(const SimTK::State& state) const { return getCablePath(state).pose; }
    const PathProblem& getProblem() const { return m_problem; }
    /** Never none. @throws what getPath() throws, and an error in a pose that is not finite, where no path is */
    const std::vector<StraightSegment>& getSegments(const SimTK::State& state, const char* method) const;
    std::vector<SimTK::Vec3> calcResampledPoints(const SimTK::State& state, int count) const;
    /** One of an obstacle's arcs, or null if it has no such arc. */
    const ContactArc* findArc(const SimTK::State& state, CableElementIndex obstacle, int arc, const char* method) const;
    std::vector<SimTK::Vec3> calcResampledArc(const SimTK::State& state, CableElementIndex obstacle, int count,
                                              int arc) const;
    /** @param method   of the API, for messages */
    std::vector<SimTK::Transform> calcResampledArcFrames(const SimTK::State& state, CableElementIndex obstacle,
                                                         int count, int arc, const char* method) const;
    /** A trihedron on an obstacle, in ground: x along the path, y the outward normal. */
    SimTK::Transform calcContactFrame(const SimTK::State& state, CableElementIndex obstacle,
                                      const DarbouxFrame& frame_S) const;
    SimTK::Real getLengthRate(const SimTK::State& state) const;
    SimTK::Real getLengthAccelerationBias(const SimTK::State& state) const;
    SimTK::Real calcWitness(const SimTK::State& state, CableElementIndex obstacle) const;
    /** For event finders: null where contacts are not kept, or the cable is disabled. */
    const CablePath* findKeptPath(const SimTK::State& state) const;
    /** Whether the contacts of a path that keeps them fit its pose, as far as an event finder tells. */
    bool isHolding(const CablePath& path) const;
    /** Whether the contacts that are kept do not fit the realized pose, and nobody has tried to settle them there. */
    bool isUnsettled(const SimTK::State& state) const;
    /** About element origins, in ground. */
    const std::vector<SpatialForce>& getElementForces(const SimTK::State& state, const char* method) const;
    void addBodyForces(const SimTK::State& state, SimTK::Real tension, SimTK::Vector_<SimTK::SpatialVec>& bodyForces,
                       const char* method) const;
    void addMobilityForces(const SimTK::State& state, SimTK::Real tension, SimTK::Vector& mobilityForces,
                           const char* method) const;
    /** @param screws   of this State's pose */
    void calcUnitMobilityForces(const SimTK::State& state, const MobilityScrews& screws,
                                SimTK::Vector& unitForces) const;

    /** The path of this state with all contacts settled, as a study starts from it. */
    TrackedPath calcSettledPath(const SimTK::State& state) const;
    void keepContacts(SimTK::State& state, const TrackedPath& path) const;
    void releaseContacts(SimTK::State& state) const;
    void handleContactEvent(SimTK::State& state) const;
    /** The same where contacts do not fit the pose; else nothing. */
    void handleBrokenContacts(SimTK::State& state) const;

    /** With all conditions judged, contacts fixed or not. */
    PathStatus calcStatus(const SimTK::State& state) const;
    std::string explainStatus(const SimTK::State& state) const;
    void countStep(const SimTK::State& state) const;

    CableStatistics getStatistics() const { return m_counters.getStatistics(); }
    void resetStatistics() const { m_counters.reset(); }

private:
    const CableMode& getMode(const SimTK::State& state) const;
    /** Realized. */
    const CablePath& getCablePath(const SimTK::State& state) const;
    bool isKnown(const SimTK::State& state, const CablePath& path, const CablePath& start, ContactRule rule,
                 CableWorkspace& workspace) const;
    void solve(const SimTK::State& state, const CablePath& start, CableWorkspace& workspace, CablePath& path) const;
    void findPath(const SimTK::State& state, const CablePath& start, CableWorkspace& workspace, CablePath& path) const;
    void calcWitnesses(const CablePath& start, CablePath& path) const;
    void addHandlers(CableElementIndex index);
    SimTK::Real calcLengthAccelerationBias(const SimTK::State& state, const CablePath& path) const;
    void setStart(SimTK::State& state, const TrackedPath& path) const;
    TrackedPath calcPathBeforeSwitch(const SimTK::State& state) const;
    void calcStartMotion(const SimTK::State& state, const TrackedPath& start, PathMotion& motion) const;
    void report(const std::vector<PathEvent>& events, const PathSolution& before, const TrackedPath& after,
                const std::vector<SpatialVelocity>& V_GE) const;

    CablePathSubsystemImpl& m_cables;
    CableIndex m_index;
    std::string m_name;
    CableElements m_elements;
    PathSolverOptions m_options;
    bool m_isDisabledByDefault = false;
    std::optional<ContactMode> m_defaultContactMode;  ///< none: that of the subsystem
    bool m_isWatched = false;                         ///< the handlers of all obstacles have been added
    std::vector<bool> m_isConditionWatched;           ///< by element: the handler of its condition has been added
    std::function<void(const ContactEvent&)> m_listener;

    PathProblem m_problem;                    ///< built at Topology
    int m_numObstacles = 0;                   ///< of it
    CableWorkspaces* m_workspaces = nullptr;  ///< at Topology, from the subsystem
    std::shared_ptr<CablePathPool> m_pool = std::make_shared<CablePathPool>();
    mutable CableCounters m_counters;
};

}  // namespace tautline
