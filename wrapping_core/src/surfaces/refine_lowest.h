#pragma once

namespace tautline {

/** Where a function of one number is lowest in [a, b], in which it has one minimum: by thirds. */
template <class Function>
double refineLowest(const Function& calc, double a, double b, int refinements) {
    for (int i = 0; i < refinements; ++i) {
        const double left = a + (b - a) / 3, right = b - (b - a) / 3;
        const bool isLeftLower = calc(left) < calc(right);
        (isLeftLower ? b : a) = isLeftLower ? right : left;
    }
    return 0.5 * (a + b);
}

}  // namespace tautline
