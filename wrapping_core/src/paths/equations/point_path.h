// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** The path of a problem without obstacles, straight from point to point: what a solve would find, at a hundredth of
the cost. @param path   its counts and reports are those of a solve that has begun */
void layPointPath(const PathProblem& problem, const PathPose& pose, PathSolution& path);

}  // namespace tautline
