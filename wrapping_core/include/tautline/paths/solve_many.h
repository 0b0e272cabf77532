// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/paths/parallel_blocks.h"
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/path_solver_options.h"

namespace tautline {

/** Solves one problem in a row of poses, such as those of a motion, on several threads. The row is cut into blocks of
kPosesPerBlock poses: the first path of each is a cold solve, the others are continued from the one before where that
leads to the path that is found anew (PathTracker::solveFrom()). So a path depends on the poses of its block alone, and
is the same to the last bit whatever the number of threads.
@param poses   neighbors should be near each other, or each path is found anew
@param out     one path per pose; its memory is used again. In a pose that is not finite the path is empty, without a
length (NaN), NotConverged
@throws InvalidInput if the problem does not begin and end with a point, an option is out of its range, or a pose has
another number of elements than the problem: it is named, and `out` is as it was */
void solveMany(const PathProblem& problem, const std::vector<PathPose>& poses, std::vector<PathSolution>& out,
               const PathSolverOptions& options = {}, const Threads& threads = {});

}  // namespace tautline
