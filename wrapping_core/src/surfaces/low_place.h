// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** A place on a straight line A + s e and its height over a surface. */
struct LowPlace {
    double s = 0, height = 0;  ///< [m]
};

/** The lowest local minimum of the height along a segment, if one lies below `bound`. An end is none, level as it may
be there: a tangent end is no place where the segment comes near the surface again.

Heights are taken to change by no more than twice the way along the line, so that places far above the bound are passed
in long steps. Minima nearer to each other than a quarter of the surface's size or of their height may be missed, and on
a segment of more than a hundred steps those nearer than a few such quarters.
@param length   of the segment [m] */
std::optional<LowPlace> findLowPlace(const Surface& surface, const Vec3& A_S, const Vec3& e_S, double length,
                                     double bound);

}  // namespace tautline
