// SPDX-License-Identifier: Apache-2.0
/** Derivatives of a geodesic's end frames under the four natural variations against central differences. */
#include <gtest/gtest.h>

#include "paths/equations/path_error.h"
#include "support/shapes.h"

namespace tautline::testing {
namespace {

constexpr double kAccuracy = 1e-14;
// Central differences: with noise n of the shots and step h (in sizes), n/h of rounding and h^2 of truncation;
// h = cbrt(n) makes both n^(2/3). Truncation is multiplied by third derivatives of the shape.
const double kStep = std::cbrt(1e-14);
constexpr double kTolerance = 2e-7;

struct Ends {
    DarbouxFrame P, Q;
};

class GeodesicVariation : public ::testing::TestWithParam<Shape> {
protected:
    const Surface& surface() const { return *GetParam().surface; }

    Ends shootVaried(const GeodesicStart& start, int variation, double amount) const {
        Vector4 correction = Vector4::Zero();
        correction[variation] = amount;
        const DarbouxFrame P = surface().calcFrame(start.point, start.tangent);
        const GeodesicStart varied = calcCorrectedStart(surface(), start, P, correction);
        const ShotGeodesic g = shoot(surface(), varied, varied.length, {kAccuracy, 5000});
        return {g.P, g.Q};
    }

    void compare(const FrameVariations& d, int j, const DarbouxFrame& plus, const DarbouxFrame& minus, double h,
                 double growth) const {
        // Columns 0, 1, 3 are per meter, column 2 per radian; x is a length, N and B are not.
        const double size = surface().getSize(), unit = j == 2 ? 1 : size, tolerance = kTolerance * growth;
        EXPECT_LT(((plus.x - minus.x) / (2 * h) - d.x.col(j)).norm() * unit / size, tolerance) << "x, variation " << j;
        EXPECT_LT(((plus.N - minus.N) / (2 * h) - d.N.col(j)).norm() * unit, tolerance) << "N, variation " << j;
        EXPECT_LT(((plus.B - minus.B) / (2 * h) - d.B.col(j)).norm() * unit, tolerance) << "B, variation " << j;
    }
};

TEST_P(GeodesicVariation, EqualsCentralDifferences) {
    Random random(41);
    const double size = surface().getSize();
    for (int i = 0; i < 6; ++i) {
        GeodesicStart start = makeRandomStart(GetParam(), random);
        for (double length : {0.0, 1e-6, 0.4, -0.6, 2.5}) {
            SCOPED_TRACE("geodesic " + std::to_string(i) + " of length " + std::to_string(length) + " sizes");
            start.length = length * size;
            const ShotGeodesic g = shoot(surface(), start, start.length, {kAccuracy, 5000});
            const FrameVariations dP = calcStartVariations(g.P), dQ = calcEndVariations(g.Q, g);
            const double fields = 1 + std::abs(g.a) + std::abs(g.r) / size, growth = fields * fields * fields;
            for (int j = 0; j < kVariations; ++j) {
                const double h = kStep * (j == 2 ? 1 : size);
                const Ends plus = shootVaried(start, j, h), minus = shootVaried(start, j, -h);
                compare(dP, j, plus.P, minus.P, h, 1);
                compare(dQ, j, plus.Q, minus.Q, h, growth);
            }
        }
    }
}

TEST_P(GeodesicVariation, ShiftAlongTheGeodesicEqualsLengthening) {  // at Q: Eqn. 4.12 and 4.46
    Random random(42);
    const GeodesicStart start = makeRandomStart(GetParam(), random);
    const ShotGeodesic g = shoot(surface(), start, surface().getSize());
    const FrameVariations d = calcEndVariations(g.Q, g);
    EXPECT_EQ((d.x.col(0) - d.x.col(3)).norm() + (d.N.col(0) - d.N.col(3)).norm() + (d.B.col(0) - d.B.col(3)).norm(),
              0);
}

INSTANTIATE_TEST_SUITE_P(AllShapes, GeodesicVariation, ::testing::ValuesIn(makeShapes()), getShapeName);

}  // namespace
}  // namespace tautline::testing
