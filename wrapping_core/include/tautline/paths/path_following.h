// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_solver.h"

namespace tautline {

/** Carries a path on, its contacts kept, to a pose that lies too far for Newton's method: by way of poses between, on
each element's straight way. A string that would slip off on the way is not followed.
@param from    pose at which `path` was solved
@param path    in: a path that holds; out: the path at `to`, or as it was
@return true if the path leads to `to` */
bool followPath(PathSolver& solver, const PathProblem& problem, const PathPose& from, const PathPose& to,
                PathSolution& path);

/** Whether a path solved with its contacts kept has a vanishing path error and is no saddle, to kSlipMargin. */
bool isHoldingPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
