#pragma once
#include "tautline/surface.h"

namespace tautline {

/** A line may come near a surface in several places, as inside a ring. After findSegmentClearance(): the place that was
watched so far gives way to a nearer one while both are clear; nothing changes on convex surfaces. For paths that are
followed step by step; a search that is still far from its answer is better off with the place that it started from. */
void takeNearerClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                         LineClearance& clearance);

}  // namespace tautline
