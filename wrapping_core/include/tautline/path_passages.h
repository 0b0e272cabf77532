#pragma once
/** How often a path goes through the holes of its obstacles: whether that is right, and what is kept of it. */
#include "tautline/path_problem.h"
#include "tautline/path_solution.h"

namespace tautline {

/** What says how often: the path that this one was continued from, or the hints of the problem. */
enum class PassageRule { AsBefore, AsHinted };

bool hasRightPassages(const PathProblem& problem, const PathPose& pose, PassageRule rule, const PathSolution& path);

/** Notes the passages through holes, and which were lost since the path that this one was continued from. Those of a
path that did not converge, or has left the hole, are no course to keep: the ones before them stay. */
void updatePassages(const PathProblem& problem, const PathPose& pose, bool isConverged, PathSolution& path);

}  // namespace tautline
