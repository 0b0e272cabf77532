// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <limits>
#include <utility>

namespace tautline {

/** Where a continuous function changes its sign, to the last digits: Chandrupatla's method (1997, Adv. Eng. Softw.
28:145), that is inverse quadratic interpolation where it is safe, else bisection.
@param f1, f2   the values at x1 and x2, not of one sign */
template <class Function>
double findRootInBracket(Function&& f, double x1, double f1, double x2, double f2) {
    constexpr int kMaxEvaluations = 200;  // bisection alone needs 60 to 110
    double x3 = x2, f3 = f2, share = 0.5;
    for (int i = 0; i < kMaxEvaluations && f1 != 0; ++i) {
        const double x = x1 + share * (x2 - x1), value = f(x);
        if ((value > 0) == (f1 > 0)) {
            x3 = x1, f3 = f1;
        } else {
            x3 = x2, f3 = f2;
            x2 = x1, f2 = f1;
        }
        x1 = x, f1 = value;
        const double best = std::abs(f1) < std::abs(f2) ? x1 : x2;
        const double least = 2 * std::numeric_limits<double>::epsilon() * std::abs(best) / std::abs(x2 - x1);
        if (least > 0.5 || x1 == x2) return best;
        const double xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
        share = 0.5;
        if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
            share = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
        share = std::fmin(std::fmax(share, least), 1 - least);
    }
    return std::abs(f1) < std::abs(f2) || f1 == 0 ? x1 : x2;
}

}  // namespace tautline
