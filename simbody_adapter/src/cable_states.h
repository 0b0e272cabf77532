// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "cable_path_pool.h"
#include "tautline/paths/path_tracker.h"
#include "tautline/simbody/cable_path_subsystem.h"

namespace tautline {

/** How a cable's path is found in a State. */
struct CableMode {
    bool isDisabled = false;
    ContactMode contacts = ContactMode::Events;
    bool keepsContacts = false;  ///< of Events: false until a study begins or contacts are fixed
};

/** Which rule has decided about the contacts of a path. */
enum class ContactRule { Kept, Tracked, Free };

/** A cable's path, the pose and time for which it was solved, and what it does there. */
struct CablePath : TrackedPath {
    std::vector<SpatialForce> forces;  ///< of unit tension on the elements, about their origins, in ground
    double contactWitness = 1;         ///< the lowest of the obstacles, while contacts are kept
    double stabilityWitness = 1;       ///< while contacts are kept
    double splitWitness = 1;           ///< the lowest of all obstacles; 1 unless contacts are kept
    double breachWitness = 1;          ///< see BreachEventHandler
    ContactRule rule = ContactRule::Free;
    bool wasSettled = false;        ///< its contacts were settled where it is, as far as they can be
    std::uint64_t serial = 0;       ///< of this solve: no two have the same
    std::uint64_t startSerial = 0;  ///< of the path from which it was continued; 0: of none
};

/** Holds a path that several States may share: copies are cheap, and who changes one gets a path of his own. */
class SharedPath {
public:
    bool isEmpty() const { return m_path == nullptr; }
    /** The path, an empty one if there is none. */
    const CablePath& get() const;
    /** A path that nobody else sees, to be overwritten: its contents are those of any path. @param pool   of the cable
     */
    CablePath& updScratch(CablePathPool& pool);

private:
    std::shared_ptr<CablePath> m_path;
};

/** The velocities of all bodies at one moment, about their origins in ground. */
struct BodyMotions {
    SimTK::Real time = SimTK::NaN;  ///< NaN: nothing is known
    std::vector<SimTK::SpatialVec> V_GB;
};

/** The variables and cache entries of all cables of a subsystem, one of each kind for all cables, by cable: Simbody
copies each of them with every State.

Modes: a discrete variable that invalidates Position. Paths: an auto-update discrete variable; its value is where the
next solve starts, contact sets included, its update value the paths of the present pose, which a study swaps in when it
accepts a step. Motions: another one, at Velocity; how the bodies move where the next solve starts. Rates and biases (of
the second derivative): cached at Velocity, NaN until they are asked for. */
class CableStates {
public:
    /** To be called from realizeTopology(). */
    void allocate(const SimTK::Subsystem::Guts& cables, SimTK::State& state, std::vector<CableMode> defaultModes);

    /** Stage: Topology, as for all that follows. */
    const CableMode& getMode(const SimTK::State& state, int cable) const;
    CableMode& updMode(SimTK::State& state, int cable) const;

    /** Of all cables, for a realization of all paths: what is looked up in a State costs as much as a straight path. */
    struct All {
        const std::vector<CableMode>& modes;
        const std::vector<SharedPath>& starts;
        std::vector<SharedPath>& paths;
    };
    All updAll(const SimTK::State& state) const;

    const SharedPath& getStart(const SimTK::State& state, int cable) const;
    SharedPath& updStart(SimTK::State& state, int cable) const;

    std::vector<SharedPath>& updStarts(SimTK::State& state) const;

    bool arePathsRealized(const SimTK::State& state) const;
    void markPathsRealized(const SimTK::State& state) const;
    const SharedPath& getPath(const SimTK::State& state, int cable) const;
    SharedPath& updPath(const SimTK::State& state, int cable) const;

    const BodyMotions& getStartMotions(const SimTK::State& state) const;
    BodyMotions& updStartMotions(SimTK::State& state) const;
    bool areMotionsRealized(const SimTK::State& state) const;
    void markMotionsRealized(const SimTK::State& state) const;
    const BodyMotions& getMotions(const SimTK::State& state) const;
    BodyMotions& updMotions(const SimTK::State& state) const;

    /** NaN: not yet computed at this Velocity. */
    SimTK::Real& updRate(const SimTK::State& state, int cable) const;
    SimTK::Real& updBias(const SimTK::State& state, int cable) const;

    /** When paths were last found invalidated, by others than an integrator: kept with a State whatever happens to it.
     */
    SimTK::Real& updChangeTime(const SimTK::State& state) const;

private:
    void requireTopology(const SimTK::State& state) const;
    SimTK::Real& updLazy(const SimTK::State& state, SimTK::CacheEntryIndex entry, int cable) const;

    const SimTK::Subsystem::Guts* m_cables = nullptr;
    SimTK::DiscreteVariableIndex m_modes, m_paths, m_motions;
    SimTK::CacheEntryIndex m_rates, m_biases, m_changeTime;
    int m_numCables = 0;
};

}  // namespace tautline
