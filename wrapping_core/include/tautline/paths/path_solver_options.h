// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/geodesics/geodesic.h"

namespace tautline {

struct PathSolverOptions {
    double pathErrorTolerance = 1e-11;  ///< on max |eps|; what Newton leaves is its square
    int maxIterations = 40;             ///< of each method for one contact set
    bool allowsColdStart = true;        ///< false: report NotConverged where the start given does not lead on
    /** Whether each continued solve is compared with one that knows the pose alone, for the price of a cold solve:
    PathSolution::dependsOnHistory() is exact then. Without it a rule tells, which costs next to nothing and misses a
    few of the paths between several bodies, or with several minima near each other. Needs allowsColdStart. */
    bool comparesWithCold = false;
    ShootingOptions geodesics;

    /** These options for a solve that only continues the path it is given and finds nothing anew. */
    PathSolverOptions withoutSearch() const;

    /** @throws InvalidInput naming the option that is out of its range. */
    void validate() const;
};

}  // namespace tautline
