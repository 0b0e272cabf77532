// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/surface.h"

namespace tautline {

/** Signed distance between the straight segment A B (ground) and a surface (thesis Cha. 6), on the side of
`clearance.keptN` if that is set, else on the side that the segment suggests. Where the critical point D is
not between the ends, the height of the nearer end counts.
@param clearance   in: that of the last accepted state, or nothing; out: today's */
void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vector3& A_G, const Vector3& B_G,
                          LineClearance& clearance);

/** A line may come near a surface in several places, as inside a ring. After findSegmentClearance(): the place that was
watched so far gives way to a nearer one; nothing changes on convex surfaces. For paths whose other contacts are
right: a search that is still far from its answer is better off with the place that it started from. */
void takeNearerClearance(const Surface& surface, const Pose& X_GS, const Vector3& A_G, const Vector3& B_G,
                         LineClearance& clearance);

}  // namespace tautline
