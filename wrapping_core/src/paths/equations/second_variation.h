// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "paths/problem/posed_problem.h"
#include "tautline/paths/path_stability.h"

namespace tautline {

/** A sideways displacement of the contact points of a path, along their binormals [m]: the first column of a row moves
P, the second Q. One row per segment of the path, for the arc to which it leads; zero where nothing moves. */
using SidewaysField = std::vector<Vector2>;

/** The second variation of the length (path_stability.h).
@param direction   if given and the path is a saddle: the direction of negative curvature that the first pivot that is
not positive belongs to, in units of the largest displacement; else left as it is */
PathStability calcSecondVariation(const PosedProblem& scene, const PathSolution& path,
                                  SidewaysField* direction = nullptr);

/** Moves the starts of the arcs of a saddle along its direction of negative curvature, to either side of it by sign:
where a descent begins that does not end on the saddle again (More and Sorensen, Math. Programming 16, 1979).
@param amount   the largest displacement, in sizes of its surface
@return false, and nothing is moved, where the path is not a saddle */
bool moveAlongNegativeCurvature(const PosedProblem& scene, double amount, PathSolution& path);

}  // namespace tautline
