// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/scalar_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace tautline::models {
namespace {

constexpr double kTight = 1e-14;

TEST(ScalarFunction, IsZeroByDefault) {
    const ScalarFunction zero;
    EXPECT_EQ(zero.calcValue(3.0), 0.0);
    EXPECT_EQ(zero.calcDerivative(3.0), 0.0);
    EXPECT_TRUE(zero.isConstant());
}

TEST(ScalarFunction, ConstantAndLinear) {
    const ScalarFunction five = ScalarFunction::constant(5.0);
    EXPECT_EQ(five.calcValue(-7.0), 5.0);
    EXPECT_EQ(five.calcDerivative(-7.0), 0.0);
    const ScalarFunction line = ScalarFunction::linear(-2.0, 3.0);
    EXPECT_EQ(line.calcValue(4.0), -5.0);
    EXPECT_EQ(line.calcDerivative(4.0), -2.0);
    EXPECT_EQ(line.calcSecondDerivative(4.0), 0.0);
    EXPECT_FALSE(line.isConstant());
    EXPECT_TRUE(ScalarFunction::linear(0.0, 3.0).isConstant());
}

TEST(ScalarFunction, PolynomialHasTheHighestPowerFirst) {
    // 2 x^3 - x^2 + 4 x - 5 at 3: 54 - 9 + 12 - 5; slope 6 x^2 - 2 x + 4; curvature 12 x - 2.
    const ScalarFunction cubic = ScalarFunction::polynomial({2.0, -1.0, 4.0, -5.0});
    EXPECT_EQ(cubic.calcValue(3.0), 52.0);
    EXPECT_EQ(cubic.calcDerivative(3.0), 52.0);
    EXPECT_EQ(cubic.calcSecondDerivative(3.0), 34.0);
}

TEST(ScalarFunction, PiecewiseLinearGoesOnWithItsEndSlopes) {
    const ScalarFunction lines = ScalarFunction::piecewiseLinear({0.0, 1.0, 3.0}, {1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(lines.calcValue(0.5), 2.0);
    EXPECT_DOUBLE_EQ(lines.calcValue(2.0), 2.5);
    EXPECT_DOUBLE_EQ(lines.calcValue(-1.0), -1.0);
    EXPECT_DOUBLE_EQ(lines.calcValue(5.0), 1.0);
    EXPECT_DOUBLE_EQ(lines.calcDerivative(1.0), -0.5) << "to the right of a knot";
    EXPECT_EQ(lines.calcSecondDerivative(2.0), 0.0);
}

TEST(ScalarFunction, ScalingActsOnValueAndDerivativesAndMultiplies) {
    const ScalarFunction scaled = ScalarFunction::polynomial({1.0, 0.0, 0.0}).scaledBy(3.0).scaledBy(-2.0);
    EXPECT_EQ(scaled.calcValue(2.0), -24.0);
    EXPECT_EQ(scaled.calcDerivative(2.0), -24.0);
    EXPECT_EQ(scaled.calcSecondDerivative(2.0), -12.0);
    EXPECT_TRUE(scaled.scaledBy(0.0).isConstant());
}

TEST(ScalarFunction, SineHasItsAmplitudePhaseAndOffset) {
    const ScalarFunction sine = ScalarFunction::sine(3, 2, SimTK::Pi / 6, 1);
    EXPECT_NEAR(sine.calcValue(0), 2.5, 1e-15);
    EXPECT_NEAR(sine.calcValue(SimTK::Pi / 6), 4, 1e-15);  // the crest
    EXPECT_NEAR(sine.calcDerivative(0), 6 * std::sqrt(0.75), 1e-15);
    EXPECT_FALSE(sine.isConstant());
    EXPECT_TRUE(ScalarFunction::sine(3, 0, 1, 1).isConstant());
    EXPECT_THROW(ScalarFunction::sine(3, SimTK::NaN, 1, 1), std::invalid_argument);
}

TEST(SimmSpline, OfTwoKnotsIsTheLine) {
    const ScalarFunction line = ScalarFunction::simmSpline({1.0, 3.0}, {2.0, 6.0});
    EXPECT_DOUBLE_EQ(line.calcValue(2.0), 4.0);
    EXPECT_DOUBLE_EQ(line.calcValue(10.0), 20.0);
    EXPECT_DOUBLE_EQ(line.calcDerivative(-4.0), 2.0);
}

TEST(SimmSpline, OfThreeKnotsIsTheParabola) {
    const ScalarFunction parabola = ScalarFunction::simmSpline({0.0, 1.0, 3.0}, {0.0, 1.0, 9.0});
    for (double x : {0.0, 0.3, 1.0, 2.0, 3.0}) {
        EXPECT_NEAR(parabola.calcValue(x), x * x, kTight);
        EXPECT_NEAR(parabola.calcDerivative(x), 2 * x, kTight);
        EXPECT_NEAR(parabola.calcSecondDerivative(x), 2.0, kTight);
    }
    EXPECT_NEAR(parabola.calcValue(4.0), 15.0, kTight) << "9 + 6 (4 - 3)";
    EXPECT_NEAR(parabola.calcValue(-1.0), 0.0, kTight);
    EXPECT_EQ(parabola.calcSecondDerivative(4.0), 0.0);
}

TEST(SimmSpline, RepeatsCubics) {
    // The end conditions take the third derivative from four knots, so a cubic comes out exactly.
    const auto cubic = [](double x) { return 2.0 - x + 0.5 * x * x - 0.25 * x * x * x; };
    const auto slope = [](double x) { return -1.0 + x - 0.75 * x * x; };
    const std::vector<double> x{-1.0, -0.4, 0.5, 0.7, 2.0, 3.5};
    std::vector<double> y;
    for (double knot : x) y.push_back(cubic(knot));
    const ScalarFunction spline = ScalarFunction::simmSpline(x, y);
    for (double at = -1.0; at <= 3.5; at += 0.05) {
        EXPECT_NEAR(spline.calcValue(at), cubic(at), 20 * kTight);
        EXPECT_NEAR(spline.calcDerivative(at), slope(at), 100 * kTight);
        EXPECT_NEAR(spline.calcSecondDerivative(at), 1.0 - 1.5 * at, 500 * kTight);
    }
    EXPECT_NEAR(spline.calcValue(4.5), cubic(3.5) + slope(3.5), 100 * kTight);
}

TEST(SimmSpline, FiveKnotsByHand) {
    // y = 0 0 1 0 0 at 0..4: the third difference at the end is -3/6, so g1 - g0 = -1/2, and
    // by symmetry g3 = g1, g4 = g0. The rows at 1 and 2: g0 + 4 g1 + g2 = 1, 2 g1 + 4 g2 = -2.
    // With g0 = g1 + 1/2: 5 g1 + g2 = 1/2 and g2 = -1/2 - g1/2, so g1 = 2/9, g0 = 13/18,
    // g2 = -11/18; y''/6 = g.
    const ScalarFunction spline = ScalarFunction::simmSpline({0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 0.0, 1.0, 0.0, 0.0});
    EXPECT_NEAR(spline.calcSecondDerivative(0.0), 6 * 13.0 / 18, kTight);
    EXPECT_NEAR(spline.calcSecondDerivative(1.0), 6 * 2.0 / 9, kTight);
    EXPECT_NEAR(spline.calcSecondDerivative(2.0), -6 * 11.0 / 18, kTight);
    EXPECT_NEAR(spline.calcSecondDerivative(3.0), 6 * 2.0 / 9, kTight);
    EXPECT_NEAR(spline.calcSecondDerivative(4.0), 6 * 13.0 / 18, kTight);
    EXPECT_NEAR(spline.calcDerivative(2.0), 0.0, kTight) << "by symmetry";
}

TEST(SimmSpline, IsTwiceContinuouslyDifferentiableInside) {
    std::mt19937 random(20250101);
    std::uniform_real_distribution<double> step(0.05, 1.0), height(-1.0, 1.0);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> x{0.0}, y{height(random)};
        for (int i = 1; i < 4 + trial % 7; ++i) {
            x.push_back(x.back() + step(random));
            y.push_back(height(random));
        }
        const ScalarFunction spline = ScalarFunction::simmSpline(x, y);
        for (std::size_t i = 0; i < x.size(); ++i) {
            EXPECT_NEAR(spline.calcValue(x[i]), y[i], 1e-12);
            if (i == 0 || i + 1 == x.size()) continue;
            const double before = std::nextafter(x[i], -1e9);
            for (int order = 0; order <= 2; ++order) {
                const double here = spline.calcDerivativeOfOrder(order, x[i]);
                EXPECT_NEAR(spline.calcDerivativeOfOrder(order, before), here, 1e-10 * (1 + std::abs(here)));
            }
        }
    }
}

TEST(ScalarFunction, DerivativesAgreeWithDifferences) {
    const std::vector<double> x{-1.2, -0.5, 0.1, 0.9, 2.1}, y{0.4, -0.2, 0.9, 0.3, 0.5};
    const ScalarFunction functions[] = {ScalarFunction::simmSpline(x, y),
                                        ScalarFunction::simmSpline(x, y).scaledBy(-1.7),
                                        ScalarFunction::polynomial({0.3, -1.0, 0.2, 2.0}),
                                        ScalarFunction::linear(2.0, 1.0),
                                        ScalarFunction::sine(0.7, 1.3, 0.2, -0.4),
                                        ScalarFunction::sine(0.7, 1.3, 0.2, -0.4).scaledBy(-2.0)};
    const double h = 1e-5;  // near the cube root of the rounding unit
    for (const ScalarFunction& function : functions) {
        for (double at : {-2.0, -0.9, 0.0, 0.5, 1.5, 3.0}) {
            const double slope = (function.calcValue(at + h) - function.calcValue(at - h)) / (2 * h);
            const double second = (function.calcDerivative(at + h) - function.calcDerivative(at - h)) / (2 * h);
            EXPECT_NEAR(function.calcDerivative(at), slope, 1e-8);
            EXPECT_NEAR(function.calcSecondDerivative(at), second, 1e-8);
        }
    }
}

TEST(SimmSpline, RepeatedAbscissaeStayFinite) {
    const ScalarFunction spline = ScalarFunction::simmSpline({0.0, 1.0, 1.0, 2.0}, {0.0, 1.0, 1.0, 2.0});
    for (double at : {0.0, 0.5, 1.0, 1.5, 2.0}) EXPECT_TRUE(std::isfinite(spline.calcValue(at)));
}

TEST(ScalarFunction, RefusesWhatIsNoFunction) {
    EXPECT_THROW(ScalarFunction::polynomial({}), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::polynomial({NAN}), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::simmSpline({0.0}, {0.0}), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::simmSpline({0.0, 1.0}, {0.0}), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::simmSpline({1.0, 0.0}, {0.0, 1.0}), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::constant(INFINITY), std::invalid_argument);
    EXPECT_THROW(ScalarFunction::constant(1.0).scaledBy(NAN), std::invalid_argument);
}

}  // namespace
}  // namespace tautline::models
