// SPDX-License-Identifier: Apache-2.0
/** The Runge-Kutta pairs on equations whose solution is known. */
#include "tautline/geodesics/dormand_prince.h"

#include <gtest/gtest.h>

namespace tautline::testing {
namespace {

using State = Eigen::Matrix<double, 3, 1>;

/** z'' = -z as two equations, and x' = x z: a third one that is not linear; x = x0 exp(z'0 - z'). */
void calcDerivative(const State& y, State& slope) {
    slope = State(y[1], -y[0], y[0] * y[2]);
}

struct Step {
    State y;
    double estimate;
};

template <class Pair>
Step stepFromStart(double h) {
    const State y(0.8, 0.6, 0.5), weights = State::Ones();
    State slope;
    Step step;
    calcDerivative(y, slope);
    step.estimate = Pair::step(calcDerivative, y, slope, h, weights, step.y);
    return step;
}

State calcTruth(double h) {
    const double z = 0.8 * std::cos(h) + 0.6 * std::sin(h), zDot = 0.6 * std::cos(h) - 0.8 * std::sin(h);
    return {z, zDot, 0.5 * std::exp(0.6 - zDot)};
}

template <class Pair>
double calcError(double h) {
    return (stepFromStart<Pair>(h).y - calcTruth(h)).norm();
}

/** The exponent with which f falls between h and h/2. */
template <class Function>
double calcExponent(Function f, double h) {
    return std::log2(f(h) / f(h / 2));
}

TEST(DormandPrince, ErrorOfAStepFallsWithTheOrderPlusOne) {
    EXPECT_NEAR(calcExponent(calcError<DormandPrince54>, 0.2), 6, 0.3);
    // Of the oscillator: the error of x changes its sign with h, and shows its order only near rounding.
    const auto error853 = [](double h) {
        return (stepFromStart<DormandPrince853>(h).y - calcTruth(h)).head<2>().norm();
    };
    EXPECT_NEAR(calcExponent(error853, 0.4), 9, 0.3);
}

TEST(DormandPrince, EstimateFallsWithTheOrderOfThePairAndBoundsTheError) {
    const auto estimate54 = [](double h) { return stepFromStart<DormandPrince54>(h).estimate; };
    const auto estimate853 = [](double h) { return stepFromStart<DormandPrince853>(h).estimate; };
    EXPECT_NEAR(calcExponent(estimate54, 0.2), 5, 0.3);
    EXPECT_NEAR(calcExponent(estimate853, 0.2), 8, 0.3);
    for (double h : {0.05, 0.1, 0.2, 0.4}) {
        EXPECT_GT(estimate54(h), calcError<DormandPrince54>(h) / std::sqrt(3.0)) << h;
        EXPECT_GT(estimate853(h) + 1e-15, calcError<DormandPrince853>(h) / std::sqrt(3.0)) << h;
    }
}

TEST(DormandPrince, StepRatioUndoesTheEstimatesExponent) {
    for (double ratio : {1e-3, 0.5, 1.0, 40.0}) {
        EXPECT_NEAR(std::pow(DormandPrince54::calcStepRatio(ratio), 5), ratio, 1e-14 * ratio);
        EXPECT_NEAR(std::pow(DormandPrince853::calcStepRatio(ratio), 8), ratio, 1e-14 * ratio);
    }
}

TEST(DormandPrince, SlopeThatIsNotANumberIsToldByTheEstimate) {
    const auto derivative = [](const State&, State& slope) { slope.setConstant(std::nan("")); };
    State next;
    const State y = State::Zero(), slope = State::Ones(), weights = State::Ones();
    EXPECT_TRUE(std::isnan(DormandPrince54::step(derivative, y, slope, 0.1, weights, next)));
    EXPECT_TRUE(std::isnan(DormandPrince853::step(derivative, y, slope, 0.1, weights, next)));
}

}  // namespace
}  // namespace tautline::testing
