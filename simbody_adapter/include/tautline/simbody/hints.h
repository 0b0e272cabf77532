// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <SimTKcommon.h>

#include "tautline/paths/start_hint.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

/** The hints of start_hint.h with Simbody's vectors, in the frame S of the obstacle: for Cable::addObstacle(). */
inline StartHint passNear(const SimTK::Vec3& point_S) {
    return PassNear{toEigen(point_S)};
}
inline StartHint passOnSide(const SimTK::Vec3& direction_S) {
    return PassOnSide{toEigen(direction_S)};
}
/** @param turns   about the z axis of S, positive from x to y */
inline StartHint windAround(SimTK::Real turns) {
    return WindAround{turns};
}
/** @param passages   through the hole, along its axis less against it */
inline StartHint threadHole(int passages) {
    return ThreadHole{passages};
}

}  // namespace tautline
