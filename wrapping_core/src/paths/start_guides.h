// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "paths/hole_passages.h"
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Points in ground through which a string is laid before it falls taut: one list for each element of the problem,
in the order of the path; empty where nothing is known. */
using StartGuides = std::vector<std::vector<Vec3>>;

/** How a string is to run when it is laid anew. */
struct StartCourse {
    StartGuides guides;
    PassageRule passages;
};

/** As the hints of the problem ask; a ring without one is to be threaded if the straight line threads it. */
StartCourse calcHintedCourse(const PathProblem& problem, const PathPose& pose);

/** Along a previous path: its arcs, and where it went through the holes of obstacles that it did not touch. */
StartCourse calcPreviousCourse(const PathProblem& problem, const PathPose& pose, const PathSolution& previous);

/** The guide that takes a path round the other side of an obstacle that it touches. */
Vec3 calcOppositeGuide(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element);

}  // namespace tautline
