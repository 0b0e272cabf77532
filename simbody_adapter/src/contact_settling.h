#pragma once
#include "tautline/contact_switch.h"
#include "tautline/path_solver.h"

namespace tautline {

/** Switches contacts whose witness is below zero, one at a time, solving after each, until none is left;
if that comes to no end, lets the solver find a contact set from here.
@param path   in: solved with its contacts kept; out: as in, or solved with other contacts
@return true if the contact set has changed */
bool settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);

}  // namespace tautline
