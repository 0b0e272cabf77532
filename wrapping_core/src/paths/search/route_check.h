// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/problem/posed_problem.h"

namespace tautline {

/** The first hint that a solved path does not follow: judged on the path itself, since a string may slip off where it
was laid. A path passes an obstacle on the side on which the middle of its arc lies, or, where it is lifted, the place
where its segment comes nearest.
@param path   solved, its passages noted (threading.h) */
RouteDeviation findDeviation(const PosedProblem& scene, const PathSolution& path);

/** The first obstacle that a continued path, which follows its hints, passes as it does only because it was continued
(RouteDeviation::Kind::Continued): about an endless body it turns otherwise than the straight line between the fixed
points, or the obstacles with PassNear, beside it, or than its side asks; any other body it passes far from where that
line, or its side, is. A rule that costs next to nothing: of poses on random walks it misses 0.2 % of the paths that are
not where a cold solve ends. Obstacles with a hole are judged by their passages. */
RouteDeviation findContinuedDeviation(const PosedProblem& scene, const PathSolution& path);

/** The first hint of a side or of turns that it does not follow, where passages are judged otherwise. */
RouteDeviation findSideDeviation(const PosedProblem& scene, const PathSolution& path);

}  // namespace tautline
