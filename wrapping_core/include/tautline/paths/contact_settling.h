#pragma once
#include "tautline/paths/path_solver.h"

namespace tautline {

/** Switches contacts whose witness is below zero, one at a time, solving after each, until none is left;
if that comes to no end, lets the solver find a contact set from here. For event handlers: the path that they leave is
the one next to where they stopped, not the one that a search from elsewhere would find.
@param path   in: solved with its contacts kept; out: as in, or solved with other contacts
@return true if the contact set has changed */
bool settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);

}  // namespace tautline
