// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/path_solver_options.h"

namespace tautline {

struct PosedProblem;

/** Finds shortest paths. Holds the workspace of a solve: one per thread; the answer never depends on what
it solved before. No allocation once it has solved a path of the same size. */
class PathSolver {
public:
    /** @throws InvalidInput naming the option that is out of its range */
    explicit PathSolver(const PathSolverOptions& options = {});
    PathSolver(PathSolver&&) noexcept;
    PathSolver& operator=(PathSolver&&) noexcept;
    ~PathSolver();

    const PathSolverOptions& getOptions() const { return m_options; }

    /** Solves for path and contact set. An empty `path` is a cold start from the problem's hints; otherwise
    it is continued from, and found anew along it where that fails. A fixed point that lies on a surface (to 1e-7 of
    its size) is treated as lying 1e-7 sizes above it, where a straight segment still has a direction; that changes
    the length by about 1e-10 sizes where the path leaves along the surface, and by 1e-7 at most.
    @param pose   one pose per element
    @param path   in: start, from a solve of the same problem, or empty; out: the answer, finite and drawable whatever
    its status. In a pose that is not finite it stays as it was but for its status, NotConverged, and its path error
    @throws InvalidInput if the problem does not begin and end with a point, or the numbers of its elements, of the
    poses and of the path's contacts differ. A pose is never a reason */
    void solve(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** Solves with the contact set of `path` as it is, so that the equations stay smooth past lift-off
    (arcs of negative length) and touchdown (clearances below zero) while an integrator locates the event.
    `path` must come from an earlier solve. Its status tells only whether the path error vanishes. */
    void solveKeepingContacts(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    struct Workspace;

    Workspace& updWorkspace();
    bool begin(const PathProblem& problem, const PathPose& pose, PathSolution& path) const;
    static Vector3 chooseOrigin(const PathPose& pose);
    const PathPose& calcWorkingPose(const PathProblem& problem, const PathPose& pose);
    void moveToGround(PathSolution& path) const;
    bool findKeptPath(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    void switchOffEnclosing(const PosedProblem& scene, PathSolution& path) const;
    void finish(const PathProblem& problem, const PathPose& pose, bool isFound, PathSolution& path) const;
    void compareWithCold(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    PathSolverOptions m_options;
    std::unique_ptr<Workspace> m_workspace;
};

/** One-off: a cold start from the problem's hints. */
PathSolution solvePath(const PathProblem& problem, const PathPose& pose, const PathSolverOptions& options = {});

}  // namespace tautline
