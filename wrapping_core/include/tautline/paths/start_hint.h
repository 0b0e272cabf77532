// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <variant>

#include "tautline/types.h"

namespace tautline {

/** @name What a user may say about an obstacle where a path is laid for the first time, in its frame S. */
///@{

/** The path runs near this point: on the side of the surface where its foot is, or, if the point lies in the surface's
hole, through that, either way. */
struct PassNear {
    Vector3 point_S;
};

/** The path runs where direction_S . p_S >= 0, as the quadrants of musculoskeletal models say. */
struct PassOnSide {
    Vector3 direction_S;
};

/** The path turns about the z axis of S, positive from x to y, by the angle nearest to `turns` full turns that
leads from what comes before the obstacle to what comes after. */
struct WindAround {
    double turns;
};

/** The path goes through the surface's hole this many times, along the hole's axis (+z of a ring's S) if positive. */
struct ThreadHole {
    int passages;
};
///@}

/** std::monostate: nothing is known, the straight line suggests the side. */
using StartHint = std::variant<std::monostate, PassNear, PassOnSide, WindAround, ThreadHole>;

}  // namespace tautline
