// SPDX-License-Identifier: Apache-2.0
/** How the runs of a sweep are drawn. */
#include "sweep/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr std::uint64_t kSeed = 2026;

TEST(Sampling, IsTheSameForASeedAndAnotherForAnother) {
    EXPECT_EQ(drawRandom(50, 3, kSeed), drawRandom(50, 3, kSeed));
    EXPECT_NE(drawRandom(50, 3, kSeed), drawRandom(50, 3, kSeed + 1));
    EXPECT_EQ(drawLatinHypercube(50, 3, kSeed), drawLatinHypercube(50, 3, kSeed));
    EXPECT_NE(drawLatinHypercube(50, 3, kSeed), drawLatinHypercube(50, 3, kSeed + 1));
}

// The generator is the standard's (its 10000th number from the default seed is fixed there); the way from its bits to
// numbers is ours, so that no library changes a sweep.
TEST(Sampling, GivesTheseNumbersOnEveryMachine) {
    const UnitSamples samples = drawRandom(10000, 1, 5489);
    EXPECT_EQ(samples[9999][0], static_cast<double>(9981545732273789042U >> 11) * 0x1p-53);
}

TEST(Sampling, StaysInTheUnitCubeAndCoversIt) {
    for (const UnitSamples& samples : {drawRandom(4000, 2, kSeed), drawLatinHypercube(4000, 2, kSeed)})
        for (std::size_t d = 0; d < 2; ++d) {
            double sum = 0, squares = 0;
            for (const std::vector<double>& x : samples) {
                ASSERT_TRUE(x[d] >= 0 && x[d] < 1);
                sum += x[d], squares += x[d] * x[d];
            }
            EXPECT_NEAR(sum / 4000, 0.5, 4 / std::sqrt(12 * 4000.0));
            EXPECT_NEAR(squares / 4000, 1.0 / 3, 0.02);
        }
}

TEST(Sampling, LatinHypercubeHasOnePointInEachPartOfEachCoordinate) {
    for (const int count : {1, 2, 7, 100}) {
        const UnitSamples samples = drawLatinHypercube(count, 4, kSeed);
        for (std::size_t d = 0; d < 4; ++d) {
            std::vector<int> inPart(static_cast<std::size_t>(count));
            for (const std::vector<double>& x : samples) ++inPart[static_cast<std::size_t>(x[d] * count)];
            EXPECT_EQ(std::count(inPart.begin(), inPart.end(), 1), count) << "coordinate " << d << " of " << count;
        }
    }
}

TEST(Sampling, CoordinatesOfALatinHypercubeDoNotGoTogether) {
    const UnitSamples samples = drawLatinHypercube(1000, 2, kSeed);
    double correlation = 0;
    for (const std::vector<double>& x : samples) correlation += (x[0] - 0.5) * (x[1] - 0.5) / 1000;
    EXPECT_LT(std::abs(correlation), 4.0 / 12 / std::sqrt(1000.0));
}

}  // namespace
}  // namespace tautline
