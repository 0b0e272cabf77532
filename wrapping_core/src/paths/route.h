// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "paths/threading.h"

namespace tautline {

/** Points in ground through which a string is laid before it falls taut: one list for each element of the problem,
in the order of the path; empty where nothing is known. */
using Waypoints = std::vector<std::vector<Vec3>>;

/** How a string is to run when it is laid anew. */
struct Route {
    Waypoints waypoints;
    PassageRule threading;
};

/** As the hints of the problem ask; a ring without one is to be threaded if the straight line threads it. Of an endless
body (PathElement::isEndless) a side is a homotopy class, and is laid as the turn about the axis that leads to it. */
Route calcAskedRoute(const PosedProblem& scene);

/** By how much a string from A to B is asked to turn about the axis of an endless body with a side, as
calcAskedRoute() lays it. @param A_S, B_S   in S; the angle from x to y [rad] */
double calcAskedTurn(const PathElement& element, const Vec3& A_S, const Vec3& B_S);

/** Along a previous path: its arcs, and where it went through the holes of obstacles that it did not touch. */
Route calcPreviousRoute(const PosedProblem& scene, const PathSolution& previous);

/** Through the fixed points alone, and through rings or past them. */
Route calcReleasedRoute(const PosedProblem& scene);

/** The arc that a string laid along points of a surface is next to: from the first of them to the last.
@param before, after   of the string, beside them; all in ground */
GeodesicStart calcArcAlong(const Surface& surface, const Pose& X_GS, const Vec3& before,
                           const std::vector<Vec3>& points, const Vec3& after);

}  // namespace tautline
