#pragma once
/** Adaptive integration of a geodesic with its two Jacobi fields, shared by implicit and parametric
surfaces. The surface's equations come as a template parameter, so that no call inside a step is virtual. */
#include <algorithm>

#include "tautline/dormand_prince_853.h"
#include "tautline/geodesic.h"

namespace tautline {

/** Integrates `equations` over the arc length `length`, signed.

`Equations` gives: `static constexpr int n`; `State = Eigen::Matrix<double, n, 1>`;
`void calcDerivative(const State&, State&)`; `void calcErrorWeights(const State&, State&)`, 1 over the
size that counts as 1 for each component; `void project(State&)`, back to surface, tangency and unit
speed; `void watch(const State&)`, called after each accepted step.

@param firstStep   suggestion for |h|, a function of the surface and accuracy alone, so that the answer does
                   not depend on what was shot before
@return number of accepted steps, or -1 if maxSteps did not suffice or a number stopped being finite */
template <class Equations>
int integrateGeodesic(Equations& equations, typename Equations::State& y, double length, double firstStep,
                      const GeodesicOptions& options) {
    using State = typename Equations::State;
    constexpr double kSafety = 0.9, kMinFactor = 0.2, kMaxFactor = 5.0, kOrder = 8.0;
    const auto derivative = [&equations](const State& state, State& slope) { equations.calcDerivative(state, slope); };
    State slope, yNew, error5, error3, weights;
    double done = 0, step = std::min(std::abs(length), firstStep);
    int accepted = 0;
    const double direction = length < 0 ? -1 : 1;
    equations.calcDerivative(y, slope);
    if (!y.allFinite() || !slope.allFinite() || !std::isfinite(length)) return -1;
    for (int attempt = 0; attempt < options.maxSteps && done < std::abs(length); ++attempt) {
        const double left = std::abs(length) - done;
        // The rest in equal steps: a last step of rounding size would cost as much as a whole one.
        const bool isLast = step >= left * (1 - 1e-12);
        const double h = direction * (isLast ? left : std::min(step, std::max(left / 2, step / 2)));
        stepDormandPrince853<Equations::n>(derivative, y, slope, h, yNew, error5, error3);
        equations.calcErrorWeights(y, weights);
        const double e5 = weights.cwiseProduct(error5).squaredNorm(), e3 = weights.cwiseProduct(error3).squaredNorm();
        // Error estimate of the 8(5,3) pair (Hairer, Norsett, Wanner, Sec. II.10).
        const double error = e5 > 0 ? e5 / std::sqrt(e5 + 0.01 * e3) : 0;
        if (!std::isfinite(error) || !yNew.allFinite()) {
            step = std::abs(h) * kMinFactor;
            continue;
        }
        const double factor = error > 0 ? kSafety * std::pow(options.accuracy / error, 1 / kOrder) : kMaxFactor;
        step = std::abs(h) * std::clamp(factor, kMinFactor, kMaxFactor);
        if (error > options.accuracy) continue;
        y = yNew;
        equations.project(y);
        equations.watch(y);
        done = isLast ? std::abs(length) : done + std::abs(h);
        ++accepted;
        if (!isLast) equations.calcDerivative(y, slope);
    }
    return done >= std::abs(length) ? accepted : -1;
}

/** Length of the first step for a curvature scale [1/m]: an angle on the circle of that curvature that the
pair usually gets through at `accuracy`. Only a guess: the error estimate has the last word. */
inline double calcFirstStep(double curvature, double accuracy) {
    const double angle = std::clamp(4.5 * std::pow(accuracy, 1.0 / 12.0), 0.2, 2.0);
    return curvature > 0 ? angle / curvature : kInfinity;
}

}  // namespace tautline
