// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Words for people. */
#include <string>

#include "tautline/paths/path_verification.h"

namespace tautline {

/** A sentence for people, with the obstacle's name. */
std::string describe(const PathVerification& verification, const PathProblem& problem);

/** Why a path has the status that it has, in a sentence for people: the condition that is broken, at
which element and where in ground, or what kept the elastic string from a solution if that is known.
@param path          as solve() left it at this pose
@param shortestArc   as for verifyPath() */
std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                          double shortestArc = kShortestArc);

}  // namespace tautline
