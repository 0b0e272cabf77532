// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** The arcs for Newton's method of a string from A to B, both in S, that touches a surface along the segment between:
one over the place where the clearance was measured; where the surface is hollow there, those of the hull of its section
by the plane through the segment and the normal there.
@param further   the arcs after the first, in path order
@return the first */
GeodesicStart calcTouchingArcs(const Surface& surface, const Vector3& A_S, const Vector3& B_S,
                               const LineClearance& clearance, std::vector<GeodesicStart>& further);

}  // namespace tautline
