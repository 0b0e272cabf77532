// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/posed_problem.h"

namespace tautline {

/** The first hint that a solved path does not follow: judged on the path itself, since a string may slip off where it
was laid. A path passes an obstacle on the side on which the middle of its arc lies, or, where it is lifted, the place
where its segment comes nearest.
@param path   solved, its passages noted (threading.h) */
RouteDeviation findDeviation(const PosedProblem& scene, const PathSolution& path);

/** The same of sides and turns alone, where passages are judged otherwise. */
RouteDeviation findSideDeviation(const PosedProblem& scene, const PathSolution& path);

/** Whether a minimum runs as one that is found anew in its pose has to: as the hints ask, past an obstacle without a
hint on the side where the straight line between its neighbors passes, through unhinted rings as that line does, and
wound up by less than a full turn unless a hint says otherwise. */
bool isOnDefaultCourse(const PosedProblem& scene, const PathSolution& path);

}  // namespace tautline
