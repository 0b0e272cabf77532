// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What an event finder watches while contacts are fixed. A witness is dimensionless, positive while all may stay as it
is, and falls through zero where it may not. It is never 0, since an event finder that starts from exactly zero misses
what follows, and never NaN. */
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** What tells that one obstacle's contact must change, smooth through zero while contacts are kept. Touched: arc length
over size (thesis Sec. 6.3). Lifted: clearance above kContactTolerance. Where nothing is smooth: 1 for an obstacle that
is switched off, -1 for one that should be, and -1 for a ring that the path has left, which no switch mends: that path
must be laid anew. */
double calcContactWitness(const PathProblem& problem, const PathSolution& path, int element);

/** What tells that one arc no longer describes how a touched obstacle holds the string: it falls through zero where the
pressure turns inside the arc, or where a straight segment beside the arc meets the surface that it has left. 1 for
convex surfaces, where neither can happen, and while the obstacle is lifted. @param path   solved at `pose` */
double calcSplitWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element);

}  // namespace tautline
