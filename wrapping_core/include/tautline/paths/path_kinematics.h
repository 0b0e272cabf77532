// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Exact rate of length change of a path (thesis Eqn. 5.13), from the segments' e throughout, so that it is
the power of the forces below at any path error.
@param pose   of the elements, for which the path was solved
@param V_GE   their spatial velocities in ground, one per element
@return dL/dt [m/s]
@throws InvalidInput unless there is one velocity per pose */
double calcLengthRate(const PathSolution& path, const PathPose& pose, const std::vector<SpatialVelocity>& V_GE);

/** Force and moment (about each element's origin, in ground) that the path puts on each element at unit
tension (thesis Sec. 6.3, with e in place of t): they balance at any path error, and their power is
-dL/dt. @param F_GE   resized to one entry per element */
void calcUnitForces(const PathSolution& path, const PathPose& pose, std::vector<SpatialForce>& F_GE);

/** Points of the path for drawing, in ground: ends of straight segments and, on each arc, points no farther
apart than `maxAngle` [rad] of turning. @throws InvalidInput unless maxAngle > 0 */
void calcDrawingPoints(const PathSolution& path, const PathProblem& problem, const PathPose& pose, double maxAngle,
                       std::vector<Vector3>& points_G);

}  // namespace tautline
