// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_solution.h"

namespace tautline {

/** How a path runs about one obstacle: by how much it turns, and where the middle of its arc lies. */

/** By how much a path turns about the z axis of S from A to B, which lie before and after its arc on straight lines,
positive from x to y [rad]: pieces of the arc turn by so little that the way round is plain. */
double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S);

/** By how much an arc turns, at least nearly [rad]. */
double calcTurn(const ObstacleContact& contact);

/** Outward in the middle of an arc, in S, of any length: of a circular arc the normals of its ends add up to that
direction if it turns by little, and its tangents differ by it if it turns by up to a full turn. */
Vec3 calcMiddleNormal(const Surface& surface, const ObstacleContact& contact);

/** A point over which the middle of an arc lies, in S: that of its chord while it turns by less than half a circle. */
Vec3 calcMiddlePoint(const Surface& surface, const ObstacleContact& contact);

/** The middle of an arc itself, in S: shot, where calcMiddlePoint() is next to an edge. */
Vec3 findMiddlePoint(const Surface& surface, const ObstacleContact& contact);

}  // namespace tautline
