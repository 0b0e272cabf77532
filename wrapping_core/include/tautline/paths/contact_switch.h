// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/tolerances.h"

namespace tautline {

/** Touches a lifted obstacle, with an arc of length zero where its segment just touches, or lifts a touched one.
@param path   solved at `pose`; its contact is changed, the path is to be solved anew */
void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path);

/** Takes a touched obstacle out of contact; its clearance is watched on the side where the arc began. */
void liftContact(ObstacleContact& contact);

/** Whether an end is inside an obstacle that is still touched: there is no path over it. */
bool hasSwallowedEnd(const PathSolution& path);

bool haveSameContacts(const PathSolution& a, const PathSolution& b);

}  // namespace tautline
