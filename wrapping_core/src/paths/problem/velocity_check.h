// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/error.h"
#include "tautline/paths/path_problem.h"

namespace tautline {

/** @throws InvalidInput, naming `what` for, unless there is one velocity per pose */
inline void requireVelocities(const std::vector<SpatialVelocity>& V_GE, const PathPose& pose, const char* what) {
    require(V_GE.size() == pose.X_GE.size(), what, ": got ", V_GE.size(), " velocities for ", pose.X_GE.size(),
            " elements");
}

}  // namespace tautline
