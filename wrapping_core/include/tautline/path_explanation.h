#pragma once
/** Words for people. */
#include <string>

#include "tautline/path_verification.h"

namespace tautline {

/** A sentence for people, with the obstacle's name. */
std::string describe(const PathVerification& verification, const PathProblem& problem);

/** Why a path has the status that it has, in a sentence for people: the condition that is broken, at
which element and where, or what kept the elastic string from a solution if that is known.
@param path   as solve() left it at this pose */
std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
