// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Cosine of 60 degrees: minima of one body that lie nearer to each other are few. */
inline constexpr double kCosineOfNear = 0.5;

/** How a path runs about one obstacle: by how much it turns, and where the middle of its arc lies; of several arcs, of
all from the first to the last. */

/** The angle about the z axis of S from one point to the next, the short way round, positive from x to y [rad]. */
double calcShortTurning(const Vector3& from_S, const Vector3& to_S);

/** By how much a path turns about the z axis of S from A to B, which lie before and after its arc on straight lines,
positive from x to y [rad]: pieces of the arc turn by so little that the way round is plain. */
double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vector3& A_S, const Vector3& B_S);

/** By how much an arc turns, at least nearly [rad]. */
double calcTurn(const ObstacleContact& contact);

/** Outward in the middle of an arc, in S, of any length: of a circular arc the normals of its ends add up to that
direction if it turns by little, and its tangents differ by it if it turns by up to a full turn. */
Vector3 calcMiddleNormal(const Surface& surface, const ObstacleContact& contact);

/** How far the middle of an arc lies along a direction, in S [m], exact in sign. That of its chord tells, unless the
arc turns by half a circle or more, or the edge is near. */
double calcMiddleAlong(const Surface& surface, const ObstacleContact& contact, const Vector3& direction_S);

}  // namespace tautline
