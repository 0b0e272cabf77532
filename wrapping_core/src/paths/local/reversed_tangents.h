// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "paths/problem/posed_problem.h"

namespace tautline {

/** True if a line meets its arc with e = -t, where eps (thesis Eqn. 4.3) vanishes too. */
bool hasReversedTangent(const PosedProblem& scene, const PathSolution& path);

/** Moves the starts of arcs that meet their lines with e = -t to where they are likely to meet them with e = t.

Seen from a point at distance l along a line that meets its arc with e = -t, the tangent point that is meant lies
2 atan(kappa l)/kappa back along the arc if that is a circle, or on by the rest of the circle: of the two the one that
leaves the arc nearer to its length in `startLengths` (of all arcs in path order), if those are given. Segments between
arcs of one obstacle are left: arcs that overlap are joined (arc_changes.h). */
void reverseTangents(const PosedProblem& scene, const std::vector<double>* startLengths, PathSolution& path);

}  // namespace tautline
