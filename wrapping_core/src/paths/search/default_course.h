// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/problem/posed_problem.h"
#include "paths/search/route.h"

namespace tautline {

/** Whether a minimum that was continued without a deviation runs as one that is found anew in its pose has to: past an
obstacle without a hint on the side where the straight line between its neighbors passes, through unhinted rings as that
line does, and wound up by less than a full turn unless a hint says otherwise. Lays the route that is asked for, and
doubts where another minimum may be near: stricter and dearer than findContinuedDeviation().
@param laid   memory for that route */
bool isOnDefaultCourse(const PosedProblem& scene, const PathSolution& path, Route& laid);

}  // namespace tautline
