// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "tautline/error.h"

namespace tautline {

// Each throws InvalidInput naming the parameter, its value and the limit.

inline void requirePositive(double value, const char* what) {
    require(std::isfinite(value) && value > 0, what, " must be positive and finite, but is ", value);
}

inline void requireNotNegative(double value, const char* what) {
    require(std::isfinite(value) && value >= 0, what, " must be finite and not negative, but is ", value);
}

inline void requireFraction(double value, const char* what) {
    require(value >= 0 && value <= 1, what, " must be in [0, 1], but is ", value);
}

inline void requireAboveOne(double value, const char* what) {
    require(std::isfinite(value) && value > 1, what, " must be finite and above 1, but is ", value);
}

/** exp(x) - 1, constant above 300: no pose leads to an infinite force, of which the next sum would make a NaN. */
inline double calcBoundedExpm1(double x) {
    return std::expm1(std::min(x, 300.0));
}

}  // namespace tautline
