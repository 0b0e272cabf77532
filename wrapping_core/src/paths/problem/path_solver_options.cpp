// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_solver_options.h"

#include "tautline/error.h"

namespace tautline {

PathSolverOptions PathSolverOptions::withoutSearch() const {
    PathSolverOptions options = *this;
    options.allowsColdStart = options.comparesWithCold = false;
    return options;
}

void PathSolverOptions::validate() const {
    require(pathErrorTolerance > 0 && pathErrorTolerance <= 0.1,
            "path solver: pathErrorTolerance must be in (0, 0.1], but is ", pathErrorTolerance);
    require(allowsColdStart || !comparesWithCold, "path solver: comparesWithCold needs allowsColdStart");
    require(maxIterations >= 1, "path solver: maxIterations must be at least 1, but is ", maxIterations);
    require(geodesics.accuracy > 0 && geodesics.accuracy <= 0.1,
            "path solver: geodesic accuracy must be in (0, 0.1], but is ", geodesics.accuracy);
    require(geodesics.maxSteps >= 1, "path solver: geodesic maxSteps must be at least 1, but is ", geodesics.maxSteps);
}

}  // namespace tautline
