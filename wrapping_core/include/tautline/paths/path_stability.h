// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/tolerances.h"

namespace tautline {

/** How far a path with vanishing path error is from a saddle of the length. */
struct PathStability {
    /** The smallest pivot of the second variation against the sum of its terms, in [-1, 1]: it goes smoothly through
    zero where a string begins to slip off. -1 where an arc goes beyond a conjugate point. 1: nothing is touched. */
    double margin = 1;
    int element = -1;  ///< the obstacle whose pivot that is; -1: nothing is touched

    bool isStable() const { return margin > 0; }
    bool holds() const { return margin > kSlipMargin; }
};

/** The second variation of the length over sideways displacements of the contact points, in O(n) and without
allocation. A path that can turn freely, such as one over a sphere between opposite points, counts as stable. */
PathStability calcPathStability(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
