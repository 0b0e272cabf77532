// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/local/length_minimizer.h"
#include "paths/tracking/pose_motion.h"
#include "tautline/paths/path_solver.h"

namespace tautline {

/** Carries a path on, its contacts kept, to a pose that lies too far for Newton's method: continuation in parts of the
way, each halved until it succeeds (Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, ch. 2).
A string that would slip off on the way is not followed. Most poses that cannot be followed are trials of an integrator,
which need only be told so: the work is bounded (search_limits.h). Holds the workspace. */
class PathFollower {
public:
    /** @param options   of the minimizer */
    explicit PathFollower(const PathSolverOptions& options) : m_minimizer(options) {}

    /** @param firstPart     of the way, in (0, 1]
    @param largestPart   of the way, at least as large
    @param path          in: a path that holds where the way begins; out: the one where it ends, or as it was
    @return true if the path leads there */
    bool follow(PathSolver& solver, const PathProblem& problem, const PoseMotion& way, double firstPart,
                double largestPart, PathSolution& path);

private:
    bool step(PathSolver& solver, const PathProblem& problem, const PathSolution& reached);
    bool slide(PathSolver& solver, const PathProblem& problem, const PathSolution& reached);
    void solve(PathSolver& solver, const PathProblem& problem);

    LengthMinimizer m_minimizer;
    long m_shots = 0;     ///< so far
    PathPose m_pose;      ///< on the way
    PathSolution m_next;  ///< the path there
};

/** Whether a path solved with its contacts kept has a vanishing path error and is not a saddle, to kSlipMargin. */
bool isHoldingPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
