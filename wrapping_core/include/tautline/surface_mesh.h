#pragma once
/** A picture of any surface: facets laid over it, found from nothing but its heights. */
#include <array>
#include <vector>

#include "tautline/surface.h"

namespace tautline {

/** Facets of a surface, in S. */
struct SurfaceMesh {
    std::vector<Vec3> points;               ///< on the surface [m]
    std::vector<std::array<int, 4>> faces;  ///< indices of points, counterclockwise seen from outside
    Vec3 centre = Vec3::Zero();             ///< of the cube within which a surface without end is drawn [m]
    bool isCut = false;                     ///< the surface goes on beyond that cube
};

/** Covers a surface with facets about a sixth of its size wide (of `extent`, if that is less), wider where that would
be too many.

(1) Every point lies on the surface and in its domain.

(2) A surface without edge that stays within 1000 sizes of where it is met first is covered whole, every edge being
shared by two facets; any other as far as its domain reaches and the cube of half side `extent` about that place.

(3) Every facet faces outward.

A part thinner than a facet may be missing. Pieces that are not connected are drawn if they are met from the origin of
S, from a point a size away from it along an axis, or from one of `near_S`, and where that leads beyond the domain's
edge, up the domain's margin from there.
@param extent   [m], positive
@param near_S   further points from which the surface is sought, such as contact points */
SurfaceMesh calcSurfaceMesh(const Surface& surface, double extent, const std::vector<Vec3>& near_S = {});

}  // namespace tautline
