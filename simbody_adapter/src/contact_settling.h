#pragma once
#include "tautline/path_solver.h"

namespace tautline {

/** What an event finder watches for one obstacle of a path whose contacts are kept: dimensionless,
falling through zero where the contact must change, smooth there, never 0 and never NaN. */
double calcContactWitness(const PathProblem& problem, const PathSolution& path, int element);

/** Switches contacts whose witness is below zero, one at a time, solving after each, until none is left;
if that comes to no end, lets the solver find a contact set from here.
@param path   in: solved with its contacts kept; out: as in, or solved with other contacts
@return true if the contact set has changed */
bool settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);

bool haveSameContacts(const PathSolution& a, const PathSolution& b);

}  // namespace tautline
