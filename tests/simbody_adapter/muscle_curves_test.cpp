// SPDX-License-Identifier: Apache-2.0
/** Millard's curves against their published construction, evaluated by another method: de Casteljau's scheme in long
double, x(u) inverted by bisection, integrals by Simpson's rule. */
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "adapter_scenes.h"
#include "tautline/muscles/millard_2012.h"

namespace tautline::testing {
namespace {

using Long = long double;

struct Corner {
    std::array<Long, 6> x, y;
};

Long evaluate(std::array<Long, 6> c, Long u) {
    for (std::size_t n = 5; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i) c[i] = (1 - u) * c[i] + u * c[i + 1];
    return c[0];
}

/** The corner between two lines, as the appendix of Millard et al. (2013) draws it. */
Corner makeCorner(Long x0, Long y0, Long slope0, Long x1, Long y1, Long slope1, Long curviness) {
    const Long c = 0.1L + 0.8L * curviness;
    const Long xC = (y1 - y0 - x1 * slope1 + x0 * slope0) / (slope0 - slope1), yC = y0 + (xC - x0) * slope0;
    const Long xM = x0 + c * (xC - x0), yM = y0 + c * (yC - y0), xN = x1 + c * (xC - x1), yN = y1 + c * (yC - y1);
    return {{x0, xM, xM, xN, xN, x1}, {y0, yM, yM, yN, yN, y1}};
}

struct Reference {
    std::vector<Corner> corners;
    Long firstSlope, lastSlope;

    Long findParameter(const Corner& corner, Long x) const {
        Long low = 0, high = 1;
        for (int i = 0; i < 80; ++i) (evaluate(corner.x, (low + high) / 2) < x ? low : high) = (low + high) / 2;
        return (low + high) / 2;
    }
    Long calcValue(Long x) const {
        const Corner &first = corners.front(), &last = corners.back();
        if (x < first.x[0]) return first.y[0] + firstSlope * (x - first.x[0]);
        if (x > last.x[5]) return last.y[5] + lastSlope * (x - last.x[5]);
        for (const Corner& corner : corners)
            if (x <= corner.x[5]) return evaluate(corner.y, findParameter(corner, x));
        return 0;
    }
    /** From the first point to x, not before it. */
    Long calcIntegral(Long x) const {
        const int n = 2000;
        const Long from = corners.front().x[0], h = (x - from) / n;
        Long sum = 0;
        for (int i = 0; i < n; ++i)
            sum += calcValue(from + i * h) + 4 * calcValue(from + (i + 0.5L) * h) + calcValue(from + (i + 1) * h);
        return sum * h / 6;
    }
};

void expectCurve(const SmoothCurve& curve, const Reference& reference, double from, double to, double integralError) {
    const double step = (to - from) / 500.3;
    for (double x = from; x < to; x += step)
        EXPECT_NEAR(curve.calcValue(x), static_cast<double>(reference.calcValue(x)), 1e-13) << x;
    const Long h = 1e-6L;
    for (double x = from; x < to; x += 7 * step) {
        const Long slope = (reference.calcValue(x + h) - reference.calcValue(x - h)) / (2 * h);
        EXPECT_NEAR(curve.calcDerivative(x), static_cast<double>(slope), 1e-6 * (1 + std::abs(curve.calcDerivative(x))))
            << x;
    }
    for (double x : {from + 0.4 * (to - from), from + 0.8 * (to - from), to})
        EXPECT_NEAR(curve.calcIntegral(x), static_cast<double>(reference.calcIntegral(x)), integralError) << x;
}

TEST(MuscleCurves, ActiveForceLengthIsThatOfThePaper) {
    const Long x0 = 0.4441L, x1 = 0.73L, x3 = 1.8123L, low = 0.1L, slope = 0.8616L;
    const Long y1 = 1 - slope * (0.95L - x1), steep = 1.25L * y1 / (x1 - x0);
    const Long xa = x0 + (x1 - x0) / 2, ya = y1 / 2, xb = x1 + (0.95L - x1) / 2, yb = y1 + (1 - y1) / 2;
    const Long xc = 1.05L + (x3 - 1.05L) / 2, down = -1 / (x3 - 0.05L - 1.05L);
    const Reference reference{{makeCorner(x0, low, 0, xa, ya, steep, 1), makeCorner(xa, ya, steep, xb, yb, slope, 1),
                               makeCorner(xb, yb, slope, 1, 1, 0, 1), makeCorner(1, 1, 0, xc, 0.5L, down, 1),
                               makeCorner(xc, 0.5L, down, x3, low, 0, 1)},
                              0,
                              0};
    const SmoothCurve curve = ActiveForceLengthCurve().makeCurve();
    expectCurve(curve, reference, 0.2, 2, 1e-7);
    EXPECT_EQ(curve.calcValue(1), 1);
    EXPECT_NEAR(curve.calcDerivative(1), 0, 1e-12);
    EXPECT_EQ(curve.calcValue(0.1), 0.1);
    EXPECT_EQ(curve.calcValue(3), 0.1);
}

TEST(MuscleCurves, ForceVelocityIsThatOfThePaper) {
    const Reference reference{
        {makeCorner(-1, 0, 0, -0.9L, 0.0125L, 0.25L, 0.6L), makeCorner(-0.9L, 0.0125L, 0.25L, 0, 1, 5, 0.6L),
         makeCorner(0, 1, 5, 0.9L, 1.3925L, 0.15L, 0.9L), makeCorner(0.9L, 1.3925L, 0.15L, 1, 1.4L, 0, 0.9L)},
        0,
        0};
    const SmoothCurve curve = ForceVelocityCurve().makeCurve();
    expectCurve(curve, reference, -1.2, 1.2, 1e-6);
    EXPECT_EQ(curve.calcValue(-1), 0);
    EXPECT_EQ(curve.calcValue(0), 1);
    EXPECT_EQ(curve.calcValue(1), 1.4);
    EXPECT_EQ(curve.calcValue(5), 1.4);
    EXPECT_NEAR(curve.calcDerivative(0), 5, 1e-12);
}

TEST(MuscleCurves, FiberForceLengthIsThatOfThePaperAndGoesOnStraight) {
    const Long stiffness = 2 / 0.7L, foot = 0.1L / stiffness;
    const Reference reference{{makeCorner(1, 0, 0, 1 + foot, 0.1L * foot, 0.2L, 0.75L),
                               makeCorner(1 + foot, 0.1L * foot, 0.2L, 1.7L, 1, stiffness, 0.75L)},
                              0,
                              stiffness};
    const SmoothCurve curve = FiberForceLengthCurve().makeCurve();
    expectCurve(curve, reference, 0.9, 2.5, 1e-7);
    EXPECT_NEAR(curve.calcValue(1.7), 1, 1e-15);
    EXPECT_NEAR(curve.calcValue(3.7), 1 + 2 * 2 / 0.7, 1e-13);
    EXPECT_EQ(curve.calcIntegral(0.5), 0);
}

TEST(MuscleCurves, TendonForceLengthIsThatOfThePaperAndGoesOnStraight) {
    const Long one = 1.049L, stiffness = 1.375L / 0.049L, toeForce = 2.0L / 3, toe = one - (1 - toeForce) / stiffness;
    const Long foot = 1 + (toe - 1) / 10, middle = one - (1 - toeForce / 2) / stiffness;
    const Long slope = toeForce / 2 / (middle - foot), x = foot + (middle - foot) / 2, y = slope * (x - foot);
    const Reference reference{
        {makeCorner(1, 0, 0, x, y, slope, 0.5L), makeCorner(x, y, slope, toe, toeForce, stiffness, 0.5L)},
        0,
        stiffness};
    const SmoothCurve curve = TendonForceLengthCurve().makeCurve();
    expectCurve(curve, reference, 0.98, 1.08, 1e-9);
    EXPECT_NEAR(curve.calcValue(1.049), 1, 1e-13);
    EXPECT_NEAR(curve.calcDerivative(1.049), 1.375 / 0.049, 1e-12);
    EXPECT_EQ(curve.calcValue(0.9), 0);
}

TEST(MuscleCurves, ArgumentOfASumIsWhereBisectionFindsIt) {
    const SmoothCurve curve = ForceVelocityCurve().makeCurve();
    for (double yScale : {0.0, 0.01, 0.3, 1.0})
        for (double xScale : {0.001, 0.1})
            for (double value = -0.5; value < 2; value += 0.0371) {
                Long low = -1e4L, high = 1e4L;
                for (int i = 0; i < 120; ++i) {
                    const Long v = (low + high) / 2;
                    (yScale * curve.calcValue(static_cast<double>(v)) + xScale * v < value ? low : high) = v;
                }
                EXPECT_NEAR(curve.findArgument(yScale, xScale, value, 1e4), static_cast<double>(low),
                            1e-9 * (1 + std::abs(static_cast<double>(low))))
                    << yScale << " " << xScale << " " << value;
            }
}

TEST(MuscleCurves, RefusesWhatIsNoSmoothCorner) {
    ForceVelocityCurve steep;
    steep.concentricSlopeNearVmax = 6;  // above the slope at rest
    EXPECT_MESSAGE(steep.makeCurve(), "ForceVelocityCurve: between (");
    FiberForceLengthCurve half;
    half.curviness = 0.5;
    EXPECT_MESSAGE(half.makeCurve(), "of its three optional parameters 1 are given, but it must be all or none");
    ActiveForceLengthCurve reversed;
    reversed.transitionNormFiberLength = 0.4;
    EXPECT_MESSAGE(reversed.makeCurve(), "ActiveForceLengthCurve: the lengths must be 0 <= 0.444");
}

}  // namespace
}  // namespace tautline::testing
