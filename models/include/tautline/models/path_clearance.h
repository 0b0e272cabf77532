#pragma once
#include "tautline/simbody/cable.h"

namespace tautline::models {

/**
 * Signed distance between an obstacle and the straight segment of the path that passes it (thesis Cha. 6), for
 * tables and plots: smooth through touchdown and lift-off. While the obstacle is touched, the segment is the one
 * that would be there if the path were cut loose from this obstacle alone, so that the distance is negative.
 *
 * Needs Stage::Position. @return `found` is false where no such path or no critical point was found
 */
LineClearance calcClearance(const Cable& cable, const SimTK::State& state, CableElementIndex obstacle);

}  // namespace tautline::models
