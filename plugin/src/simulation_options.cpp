// SPDX-License-Identifier: Apache-2.0
#include "simulation_options.h"

#include <algorithm>
#include <cmath>

#include "tautline/error.h"

namespace tautline {
namespace {

constexpr double kLongest = 1e6;   ///< [s]
constexpr double kMostRows = 1e7;  ///< kept in memory until the end of the run

}  // namespace

void SimulationOptions::validate() const {
    require(duration > 0 && duration <= kLongest, "--duration is ", duration, ", but must be above 0 and at most ",
            kLongest, " s");
    require(interval > 0 && std::isfinite(interval), "--interval is ", interval, ", but must be above 0 and finite");
    require(duration / interval <= kMostRows, "--interval is ", interval, ", which makes ", duration / interval,
            " rows of the duration of ", duration, " s, but there may be at most ", kMostRows);
    require(accuracy >= 1e-14 && accuracy <= 0.1, "--accuracy is ", accuracy, ", but must be in [1e-14, 0.1]");
}

int SimulationOptions::calcNumRows() const {
    return std::max(1, static_cast<int>(std::ceil(duration / interval - 1e-9)));
}

}  // namespace tautline
