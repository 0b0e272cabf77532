// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Whether a solved path turns about its obstacles as often, and touches them on the sides, as their hints say
(start_hint.h). A string laid there may have slipped off. Passages of holes are not judged here: hole_passages.h. */
bool turnsAsHinted(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
