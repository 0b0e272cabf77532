// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A picture of any surface: facets laid over it, found from nothing but its heights. */
#include <array>
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** Facets of a surface, in S. */
struct SurfaceMesh {
    std::vector<Vector3> points;            ///< on the surface [m]
    std::vector<std::array<int, 4>> faces;  ///< indices of points, counterclockwise seen from outside
    bool isCut = false;                     ///< the surface goes on beyond the box
    Eigen::AlignedBox3d box;                ///< holds all that is drawn, and all of `near_S` [m]
};

/** Covers a surface with facets about a sixth of its size wide (of `extent`, if that is less), wider where that would
be too many.

(1) Every point lies on the surface and in its domain.

(2) A surface without edge that stays within 1000 sizes of where it is met first is covered whole, every edge being
shared by two facets. Any other is covered as far as its domain reaches and the box that holds all places where it is
met, widened by `extent` to each side.

(3) Every facet faces outward.

It is met from the origin of S, from the points a size away from it along the axes, and from `near_S`; where that leads
beyond the domain's edge, up the domain's margin from there. A part that is not connected to any of these places, or
thinner than a facet, is missing.
@param extent   [m], positive
@param near_S   further points from which the surface is sought, such as contact points */
SurfaceMesh calcSurfaceMesh(const Surface& surface, double extent, const std::vector<Vector3>& near_S = {});

}  // namespace tautline
