// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/types.h"

namespace tautline {

/** How well a surface fits. */
struct FitReport {
    std::vector<double> residuals;  ///< distance of each point from the surface, of a patch at its (u, v) [m]
    double sumOfSquares = kNaN;     ///< of the residuals [m^2]
    double rms = kNaN;              ///< [m]
    double largest = kNaN;          ///< [m]
    int worst = -1;                 ///< the number of the point with the largest
    int leftOut = 0;                ///< points that a robust fit has taken for outliers; they have no residual
    int numUnknowns = 0;            ///< coefficients per component

    /** Sets the sums from the residuals. */
    void sumUp();
};

}  // namespace tautline
