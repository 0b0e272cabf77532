// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** d_tol of thesis Sec. 6.2, normalized by max(|kappa_n|, 1/size): the one constant for switching contact,
verifying and flagging it. Tiny, since a penetration h at touchdown makes the rate jump with h. */
inline constexpr double kContactTolerance = -1e-10;

/** Touches a lifted obstacle, with an arc of length zero where its segment just touches, or lifts a touched one.
@param path   solved at `pose`; its contact is changed, the path is to be solved anew */
void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path);

/** Takes a touched obstacle out of contact; its clearance is watched on the side where the arc began. */
void liftContact(ObstacleContact& contact);

/** Whether an end is inside an obstacle that is still touched: there is no path over it. */
bool hasSwallowedEnd(const PathSolution& path);

bool haveSameContacts(const PathSolution& a, const PathSolution& b);

}  // namespace tautline
