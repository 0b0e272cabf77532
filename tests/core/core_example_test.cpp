// SPDX-License-Identifier: Apache-2.0
/** The README's example for the core alone, run as a user would. */
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "support/run_program.h"

namespace tautline::testing {
namespace {

/** Length of the example's path with the cylinder's axis at height y: planar once the cylinder is unrolled. */
double calcUnrolledLength(double y) {
    const double radius = 0.03, half = 0.1, shift = 0.05;
    const double tangent = std::sqrt(half * half + y * y - radius * radius);
    const double arc = radius * 2 * (std::atan2(half, -y) - std::atan2(tangent, radius));
    return std::hypot(2 * tangent + arc, shift);
}

TEST(CoreExample, PrintsWhatTheUnrolledCylinderGives) {
    std::string output;
    ASSERT_EQ(runProgram(TAUTLINE_CORE_EXAMPLE, output), 0) << output;
    double length = 0, rate = 0, force = 0;
    const char* numbers = std::strstr(output.c_str(), "length");
    ASSERT_NE(numbers, nullptr) << output;
    ASSERT_EQ(std::sscanf(numbers, "length %lf m, rate %lf m/s, at 100 N of tension the cylinder is pushed by %lf N",
                          &length, &rate, &force),
              3)
        << output;
    const double h = 1e-6, slope = (calcUnrolledLength(-0.01 + h) - calcUnrolledLength(-0.01 - h)) / (2 * h);
    const double printed = 1e-5;  // six digits
    EXPECT_NEAR(length, calcUnrolledLength(-0.01), printed * length);
    EXPECT_NEAR(rate, 0.2 * slope, printed * rate);
    EXPECT_NEAR(force, 100 * slope, printed * force);
    EXPECT_GT(force, 1);
}

}  // namespace
}  // namespace tautline::testing
