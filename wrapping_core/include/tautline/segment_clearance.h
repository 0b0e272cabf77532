#pragma once
#include "tautline/surface.h"

namespace tautline {

/** Signed distance between the straight segment A B (ground) and a surface (thesis Cha. 6), on the side of
`clearance.keptN` if that is set, else on the side that the segment suggests. Where the critical point D is
not between the ends, the height of the nearer end counts.
@param clearance   in: that of the last accepted state, or nothing; out: today's */
void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                          LineClearance& clearance);

}  // namespace tautline
