// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"

namespace tautline {

/** Whether two poses are the same, bit by bit. */
inline bool isSamePose(const PathPose& a, const PathPose& b) {
    if (a.X_GE.size() != b.X_GE.size() || a.isActive != b.isActive) return false;
    for (std::size_t e = 0; e < a.X_GE.size(); ++e)
        if (a.X_GE[e].p != b.X_GE[e].p || a.X_GE[e].R != b.X_GE[e].R) return false;
    return true;
}

}  // namespace tautline
