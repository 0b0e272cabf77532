#pragma once
/** Words for people. */
#include <string>

#include "tautline/path_verification.h"

namespace tautline {

/** A sentence for people, with the obstacle's name. */
std::string describe(const PathVerification& verification, const PathProblem& problem);

/** Why a path has the status that it has, in a sentence for people that names the elements concerned.
@param path   as solve() left it at this pose */
std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

}  // namespace tautline
