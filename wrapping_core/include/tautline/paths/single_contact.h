// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** What tells that one arc no longer describes how a touched obstacle holds the string: dimensionless, positive while
it does, falling through zero where the pressure turns inside the arc, or where a straight segment beside the arc meets
the surface that it has left. 1 for convex surfaces, where neither can happen, and while the obstacle is lifted; never
0 and never NaN. @param path   solved at `pose` */
double calcSingleContactWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                                int element);

}  // namespace tautline
