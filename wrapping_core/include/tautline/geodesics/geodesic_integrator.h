// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Adaptive integration of a geodesic with its two Jacobi fields, shared by implicit and parametric
surfaces. The surface's equations come as a template parameter, so that no call inside a step is virtual. */
#include <algorithm>

#include "tautline/geodesics/dormand_prince.h"
#include "tautline/geodesics/geodesic.h"

namespace tautline {

/** Length of the first step: the angle on the circle of the sharpest curvature at the start. Only a guess: the error
estimate has the last word. */
inline double calcFirstStep(const DarbouxFrame& P, double angle) {
    const double curvature = std::max({std::abs(P.kappaN), std::abs(P.kappaB), std::abs(P.tauG)});
    return curvature > 0 ? angle / curvature : kInfinity;
}

/** Integrates `equations` from geodesic.P over the arc length `length`, signed, and sets all of `geodesic` but its end.

`Equations` gives: `static constexpr int n`; `State = Eigen::Matrix<double, n, 1>`, whose last four are the Jacobi
fields a, a', r, r'; `void calcDerivative(const State&, State&)`; `void calcErrorWeights(const State&, State&)`, 1 over
the size that counts as 1 for each component but those four; `double size`, the surface's; `void project(State&)`, back
to surface, tangency and unit speed; `void calcProjectedDerivative(const State&, State&)`, the derivative at the start
and where project() has just been; `double maxKappaN`, the largest since the start, kept by project().

@param y   in: the start; out: the end, or where the integrator gave up because maxSteps did not suffice or a
           number stopped being finite (geodesic.converged = false) */
template <class Pair, class Equations>
void integrateGeodesic(Equations& equations, typename Equations::State& y, double length,
                       const ShootingOptions& options, ShotGeodesic& geodesic) {
    using State = typename Equations::State;
    constexpr double kSafety = 0.9, kMinFactor = 0.2, kMaxFactor = 5.0;
    constexpr int kA = Equations::n - 4, kR = Equations::n - 2;
    const auto derivative = [&equations](const State& state, State& slope) { equations.calcDerivative(state, slope); };
    State slope, yNew, weights;
    y.template tail<4>() << 1, 0, 0, 1;
    geodesic.length = length;
    geodesic.steps = 0, geodesic.hasConjugatePoint = false;
    equations.maxKappaN = geodesic.P.kappaN;
    // The first step depends on the start and the accuracy alone, so that the answer does not depend on what was shot
    // before.
    double done = 0,
           step = std::min(std::abs(length), calcFirstStep(geodesic.P, Pair::calcFirstAngle(options.accuracy)));
    const double direction = length < 0 ? -1 : 1, jacobiUnits[4] = {1, equations.size, 1 / equations.size, 1};
    equations.calcProjectedDerivative(y, slope);
    const bool isFinite = std::isfinite(y.sum() + slope.sum() + length);
    for (int attempt = 0; isFinite && attempt < options.maxSteps && done < std::abs(length); ++attempt) {
        const double left = std::abs(length) - done;
        // The rest in equal steps: a last step of rounding size would cost as much as a whole one.
        const bool isLast = step >= left * (1 - 1e-12);
        const double h = direction * (isLast ? left : std::min(step, std::max(left / 2, step / 2)));
        equations.calcErrorWeights(y, weights);
        for (int i = 0; i < 4; ++i)  // relative to fields that have grown
            weights[kA + i] = jacobiUnits[i] / std::max(1.0, jacobiUnits[i] * std::abs(y[kA + i]));
        const double error = Pair::step(derivative, y, slope, h, weights, yNew);
        if (!std::isfinite(error)) {  // as it is where a slope is not, and with it yNew
            step = std::abs(h) * kMinFactor;
            continue;
        }
        if (error <= options.accuracy) {
            y = yNew;
            equations.project(y);
            if (y[kR] * direction <= 0) geodesic.hasConjugatePoint = true;
            done = isLast ? std::abs(length) : done + std::abs(h);
            ++geodesic.steps;
            if (isLast) break;
            equations.calcProjectedDerivative(y, slope);
        }
        const double factor = error > 0 ? kSafety * Pair::calcStepRatio(options.accuracy / error) : kMaxFactor;
        step = std::abs(h) * std::clamp(factor, kMinFactor, kMaxFactor);
    }
    geodesic.converged = isFinite && done >= std::abs(length);
    if (!geodesic.converged) geodesic.steps = -1;
    geodesic.a = y[kA], geodesic.aDot = y[kA + 1], geodesic.r = y[kR], geodesic.rDot = y[kR + 1];
    geodesic.maxKappaN = equations.maxKappaN;
}

/** With the pair that suits the accuracy. */
template <class Equations>
void integrateGeodesic(Equations& equations, typename Equations::State& y, double length,
                       const ShootingOptions& options, ShotGeodesic& geodesic) {
    constexpr double kLoose = 1e-4;  // from here on, common arcs are one step of either pair
    if (options.accuracy < kLoose)
        integrateGeodesic<DormandPrince853>(equations, y, length, options, geodesic);
    else
        integrateGeodesic<DormandPrince54>(equations, y, length, options, geodesic);
}

}  // namespace tautline
