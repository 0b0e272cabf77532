// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/tolerances.h"

namespace tautline {

/** Does what the witness of contact (contact_witness.h) asks for: touches a lifted obstacle, with an arc of length zero
where its segment just touches; of a touched one lifts the shortest arc, or makes one more where a segment has come down
on it again.
@param path   solved at `pose`; its contact is changed, the path is to be solved anew */
void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path);

/** Which of the arcs of a touched obstacle is the shortest. */
int findShortestArc(const ObstacleContact& contact);

/** Takes a touched obstacle out of contact; its clearance is watched on the side where the arc began. */
void liftContact(ObstacleContact& contact);

/** Whether an end is inside an obstacle that is still touched: there is no path over it. */
bool hasSwallowedEnd(const PathSolution& path);

bool haveSameContacts(const PathSolution& a, const PathSolution& b);

}  // namespace tautline
