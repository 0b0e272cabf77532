// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The path iteration of the thesis from geodesics chosen by hand, with its errors on record. */
#include <optional>
#include <vector>

#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Geodesics from which the iteration of a path starts: one entry per element of its problem, none where the element is
a point or lifted at first. */
using PathStart = std::vector<std::optional<GeodesicStart>>;

/** Path errors before an iteration, as norms: sqrt(sum eps^2) of all obstacles and of each (thesis Fig. 8.4). */
struct PathIteration {
    double error = 0;
    std::vector<double> obstacleErrors;  ///< one per element; 0 where there is no contact
};

struct IteratedPath {
    PathStart start;                        ///< the geodesics after the last iteration
    std::vector<PathIteration> iterations;  ///< the first is that of the start given, the last that of the answer
    double largestError = 0;                ///< max |eps| of the answer
};

/** The path iteration of thesis Sec. 4.6 and nothing else: Newton's full steps on the path error of a given contact
set, without damping and without changing contacts, until max |eps| <= tolerance, a step cannot be made, or
`maxIterations` are done. PathSolver is what finds paths; this shows how the method converges.
@throws InvalidInput if the numbers of elements, poses and starts differ */
IteratedPath iteratePath(const PathProblem& problem, const PathPose& pose, const PathStart& start,
                         double tolerance = 1e-12, int maxIterations = 20);

/** A path that touches the obstacles for which a start is given, at these geodesics: what PathSolver::solve() and
solveKeepingContacts() can continue. */
PathSolution makePathSolution(const PathStart& start);

}  // namespace tautline
