// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Straight edges against surfaces with walls that are thinner than the edges are long, and the way round such walls.
 */
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** Least height along a straight edge, by steps as long as half the height allows and never shorter than a twentieth of
the surface's size: thinner walls than that may be missed. It ends where the edge is found to be below `enough`.
@param numHeights   goes up by the heights that were asked for */
double calcLowestAlong(const Surface& surface, const Vector3& A_S, const Vector3& B_S, double enough, long& numHeights);

/** Corners of a polyline from A to B that is clear of the surface, ends excluded: a shortest way over a lattice around
A (A* search: Hart, Nilsson and Raphael, IEEE Trans. Systems Science and Cybernetics 4, 1968), less the corners that it
can do without.
@param numHeights   goes up by the heights that were asked for
@return false, and no corners, if the lattices that were tried show none */
bool findClearCourse(const Surface& surface, const Vector3& A_S, const Vector3& B_S, std::vector<Vector3>& corners_S,
                     long& numHeights);

}  // namespace tautline
