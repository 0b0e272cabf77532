// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/fit_report.h"

#include <cmath>

namespace tautline {

void FitReport::sumUp() {
    sumOfSquares = 0, largest = 0, worst = -1;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        sumOfSquares += residuals[k] * residuals[k];
        if (worst < 0 || residuals[k] > largest) largest = residuals[k], worst = static_cast<int>(k);
    }
    rms = std::sqrt(sumOfSquares / static_cast<double>(residuals.size()));
}

}  // namespace tautline
