// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What an event finder watches while contacts are fixed. A witness is dimensionless, positive while all may stay as it
is, and falls through zero where it may not. It is never 0, since an event finder that starts from exactly zero misses
what follows, and never NaN. */
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** What tells that one obstacle's contact must change, smooth through zero while contacts are kept. Touched: the least
of its arcs' lengths over size (thesis Sec. 6.3) and of the heights at which a segment beside them comes near the
surface again. Lifted: clearance above kContactTolerance. Where nothing is smooth: 1 for an obstacle that is switched
off, -1 for one that should be, and -1 for a ring that the path has left, which no switch mends: that path must be laid
anew. @param path   solved at `pose` */
double calcContactWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element);

/** What tells that an arc has split over a hollow, or that two have joined since it closed: a solve that keeps contacts
does so by itself, since the length stays three times continuously differentiable. While the obstacle has as many arcs
as at the start: the least of the pressure (-kappaN over 1/size) along its arcs and of the squared widths of its bridges
over size, both of which fall linearly to zero there; below zero by the same measures when it has more, or fewer.
1 for convex surfaces, and while the obstacle is lifted.
@param start   the path from which `path` was continued */
double calcSplitWitness(const PathProblem& problem, const PathSolution& start, const PathSolution& path, int element);

/** The segment beside the arcs of a touched obstacle that comes nearest to its surface again, and its height there. */
struct SurfaceReturn {
    int segment = -1;   ///< index in PathSolution::segments; -1: none comes within one size
    double height = 1;  ///< in sizes; of a convex surface 1
};
SurfaceReturn findSurfaceReturn(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                                int element);

}  // namespace tautline
