// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tautline/paths/contact_witness.h"
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/path_solver_options.h"

namespace tautline {

/** A path at one moment of a motion. Points turn with the bodies that carry them, so that these keep to their circles
between two moments. */
struct TrackedPath {
    PathSolution solution;
    PathPose pose;    ///< of the elements; empty: not known
    double time = 0;  ///< [s]
};

/** How the elements of a path move at one moment. */
struct PathMotion {
    double time = kNaN;                 ///< [s]; NaN: nothing is known
    std::vector<SpatialVelocity> V_GE;  ///< in ground, at the elements' origins
};

/** What became of one obstacle at an event. */
struct PathEvent {
    enum class Kind {
        Touched,      ///< the path has come to touch the obstacle
        Lifted,       ///< the path has left it
        Split,        ///< pressure has turned inside an arc: two arcs now lie beside a hollow that the path bridges
        Joined,       ///< a hollow has closed: one arc where there were two
        ArcMade,      ///< the path has come down on an obstacle that it touches in one more place
        ArcLost,      ///< the path has left an obstacle in one of several places
        Slipped,      ///< the string had no stable path left near this obstacle, and has jumped to another one
        SwitchedOff,  ///< a touched obstacle no longer takes part: a point beside it is inside it, or it is passed over
        SwitchedOn,   ///< one that had been switched off is touched again
        LeftHole,     ///< no path through the obstacle's hole was found again: the motion was too fast to follow
    };
    Kind kind;
    int element;
};

/** Carries a path along a motion, for simulations that step from event to event: between events contacts are fixed, so
that the path is smooth in the pose; witnesses (contact_witness.h, and calcStabilityWitness() here) fall through zero
where that ends, and there resolveEvent() settles the contacts. A loop over time is

    tracker.track(problem, start, motion, path);      // at path.time and path.pose
    if (a witness of `path` is below zero)            // at a time found by bisection, say
        events = tracker.resolveEvent(problem, start, path);
    start = path;

Holds the workspace of a solve: one per thread. The answer depends on nothing that it tracked before. */
class PathTracker {
public:
    /** @throws InvalidInput naming the option that is out of its range */
    explicit PathTracker(const PathSolverOptions& options = {});
    PathTracker(PathTracker&&) noexcept;
    PathTracker& operator=(PathTracker&&) noexcept;
    ~PathTracker();

    const PathSolverOptions& getOptions() const;

    /** Solves with contacts found anew. @param path   in: pose; out: solution, empty in a pose that is not finite */
    void solve(const PathProblem& problem, TrackedPath& path) { solve(problem, path.pose, path.solution); }
    void solve(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** As solve(): the pose alone decides, but what is known of a pose nearby saves the search. The path is continued
    from `start`, and kept if it is a minimum that runs as one found anew would have to: as the hints ask, and past
    obstacles without a hint on the side of the straight line. Else it is found anew. */
    void solveFrom(const PathProblem& problem, const TrackedPath& start, TrackedPath& path) {
        solveFrom(problem, start.solution, path.pose, path.solution);
    }
    void solveFrom(const PathProblem& problem, const PathSolution& start, const PathPose& pose, PathSolution& path);

    /** Continues `start` with its contacts decided anew, so that the path keeps its course: for studies without
    events. Parameters as for track(). */
    void trackFreely(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion, TrackedPath& path);

    /** Solves with the contacts of `start`. Where one solve does not lead to the path, or to another one that is a
    saddle, and where elements turn against each other by more than a solve follows, the path is carried along the way
    in parts.
    @param start    the last path that holds; empty: contacts are found anew
    @param motion   at `start`: tells turns by more than pi apart. Of another time than that: not known
    @param path     in: pose and time; out: solution, whose status is NotMinimum or NotConverged if it could not be
    followed to a minimum, else tells only that the path error vanishes: calcStatus() */
    void track(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion, TrackedPath& path);

    /** Settles the contacts of a path whose witness has fallen below zero.
    @param start   from which `path` was tracked
    @param path    in: as track() left it; out: the path next to it with which all conditions hold, if there is one
    @return what happened, a slip first, then obstacle by obstacle */
    std::vector<PathEvent> resolveEvent(const PathProblem& problem, const TrackedPath& start, TrackedPath& path);

    /** Settles the contacts of a path that was solved with contacts of its own. */
    void settle(const PathProblem& problem, TrackedPath& path);

    /** Falls through zero where a path has no minimum near it any more, to kSlipMargin: -1 where it could not be found
    at all, or only another minimum was, to which the string would have to jump. A saddle that could not be left is tried again whenever its instability has grown tenfold.
    @param start   from which `path` was tracked */
    static double calcStabilityWitness(const PathProblem& problem, const TrackedPath& start, const TrackedPath& path);

    /** The status of a tracked path with all conditions judged. Between events an arc just below zero length is not a
    fault, nor a path just beyond the loss of its stability: witnesses watch them. */
    static PathStatus calcStatus(const PathProblem& problem, const TrackedPath& path);

    /** calcStatus() in a sentence for people. */
    static std::string explainStatus(const PathProblem& problem, const TrackedPath& path);

private:
    struct Workspace;

    bool follow(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion, double firstPart,
                TrackedPath& path);

    std::unique_ptr<Workspace> m_workspace;
};

}  // namespace tautline
