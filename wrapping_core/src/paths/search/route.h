// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "paths/search/threading.h"

namespace tautline {

/** Points in ground through which a string is laid before it falls taut: one list for each element of the problem,
in the order of the path; empty where nothing is known. */
using Waypoints = std::vector<std::vector<Vector3>>;

/** How a string is to run when it is laid anew. */
struct Route {
    Waypoints waypoints;
    PassageRule threading;
};

/** As the hints of the problem ask; a ring without one is to be threaded if the straight line threads it. Of an endless
body (PathElement::isEndless) a side is a homotopy class, and is laid as the turn about the axis that leads to it.
@param route   whatever it was before: its memory is used again */
void calcAskedRoute(const PosedProblem& scene, Route& route);

/** By how much the asked route turns about the z axis of S past an endless body that lies alone between two points,
with no more than a side asked for [rad]: what calcAskedRoute() lays there, without laying it. */
double calcAskedTurn(const PathElement& element, const Vector3& A_S, const Vector3& B_S);

/** How often the asked route goes through the hole of an obstacle between two points beside it, in S, along +z less
against it; PassageRule::kAny where nothing is asked. */
int calcAskedPassages(const PathElement& element, const Vector3& A_S, const Vector3& B_S);

/** What is remembered of an obstacle of a path, so that a string can be laid along that again. */
struct PassedObstacle {
    bool isTouched = false, isSwitchedOff = false;
    GeodesicStart arc;                       ///< in S; the first
    std::vector<GeodesicStart> furtherArcs;  ///< in S
    HolePassage passage;                     ///< through its hole
    SurfacePoint keptC;                      ///< where a lifted one was watched last, with its normal; in S
    Vector3 keptN;
};

/** @param previous   one entry per element, as calcPreviousRoute() takes it */
void rememberPath(const PathSolution& path, std::vector<PassedObstacle>& previous);

/** Along a previous path: its arcs, and where it went through the holes of obstacles that it did not touch. */
Route calcPreviousRoute(const PosedProblem& scene, const std::vector<PassedObstacle>& previous);

/** Lays such a route anew through rings that lie between two points of it: as often as the previous path went, with the
ways of those points. Where a string has to go round a ring, its old arc does not lead there.
@return false if there are none, and the route is as it was */
bool rethread(const PosedProblem& scene, const std::vector<PassedObstacle>& previous, Route& route);

/** Through the fixed points alone, and through rings or past them. */
Route calcReleasedRoute(const PosedProblem& scene);

/** The arc that a string laid along points of a surface is next to: from the first of them to the last.
@param before, after   of the string, beside them; all in ground */
GeodesicStart calcArcAlong(const Surface& surface, const Pose& X_GS, const Vector3& before,
                           const std::vector<Vector3>& points, const Vector3& after);

}  // namespace tautline
