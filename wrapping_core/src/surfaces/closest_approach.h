// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** A point of a straight line A + s e and its height over a surface. */
struct ClosestApproach {
    double s = 0, height = 0;  ///< [m]
};

/** The lowest local minimum of the height along a segment, if one lies below `bound`. The ends are not minima, even if
they are level: at a tangent end the segment does not come near the surface again.

Sphere tracing (Hart 1996, The Visual Computer 12): a height bounds the distance to the surface, so that the next step
may be as long as the height allows. Heights are taken to change by no more than twice the way along the line. Minima
nearer to each other than a quarter of the surface's size or of their height may be missed, and on a segment of more
than a hundred steps those nearer than a few such quarters.
@param length   of the segment [m] */
std::optional<ClosestApproach> findClosestApproach(const Surface& surface, const Vector3& A_S, const Vector3& e_S,
                                                   double length, double bound);

}  // namespace tautline
