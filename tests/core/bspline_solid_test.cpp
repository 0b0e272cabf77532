// SPDX-License-Identifier: Apache-2.0
/** The function of a BSplineSolid near its surface, far from it, and where one goes over into the other. */
#include "tautline/surfaces/bspline_solid.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/random.h"
#include "support/triangle_meshes.h"
#include "tautline/error.h"
#include "tautline/meshes/mesh_distance.h"
#include "tautline/surfaces/scaled_surface.h"
#include "tautline/surfaces/solid_fit.h"

namespace tautline {
namespace {

constexpr unsigned kSeed = 20261127;

const SolidFit& getBone() {
    static const SolidFit fit = fitSolid(testing::makeBoneMesh());
    return fit;
}

const MeshDistance& getBoneDistance() {
    static const MeshDistance distance(getBone().repaired.mesh);
    return distance;
}

/** Any place from deep inside to three lengths away, most of them near the surface. */
Vector3 drawPlace(testing::Random& random) {
    const std::vector<Vector3>& points = getBone().points;
    const Vector3& near = points[static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1))];
    return near + random.logUniform(1e-4, 1) * random.unitVector();
}

TEST(BSplineSolid, HasExactDerivativesNearFarAndBetween) {
    const BSplineSolid& solid = getBone().solid;
    const SolidGrid& grid = solid.getGrid();
    testing::Random random(kSeed);
    int near = 0, between = 0, far = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vector3 p = drawPlace(random);
        const ImplicitValue value = solid.calcImplicit(p);
        ++(std::abs(value.f) < grid.blendBegin ? near : std::abs(value.f) < grid.blendEnd ? between : far);
        const double step = 1e-4 * grid.spacing;
        for (int axis = 0; axis < 3; ++axis) {
            const ImplicitValue up = solid.calcImplicit(p + step * Vector3::Unit(axis));
            const ImplicitValue down = solid.calcImplicit(p - step * Vector3::Unit(axis));
            EXPECT_NEAR((up.f - down.f) / (2 * step), value.gradient[axis], 1e-6) << p.transpose();
            // Third derivatives have steps at the sides of cells: a difference across one is of first order.
            const Vector3 bend = (up.gradient - down.gradient) / (2 * step);
            EXPECT_LT((bend - value.hessian.col(axis)).norm() * grid.spacing, 1e-3) << p.transpose();
        }
        EXPECT_LE((value.hessian - value.hessian.transpose()).norm(), 1e-14 * value.hessian.norm());
        Vector3 N;
        solid.calcHeightAndNormal(p, N);
        EXPECT_NEAR(N.dot(value.gradient), value.gradient.norm(), 1e-14);
    }
    EXPECT_GT(near, 300);
    EXPECT_GT(between, 100);
    EXPECT_GT(far, 300);
}

/** Differences of first order over ever smaller steps across a place: f, gradient and Hessian have no jump there. */
TEST(BSplineSolid, IsTwiceContinuouslyDifferentiableAlongAnyLine) {
    const BSplineSolid& solid = getBone().solid;
    const double h = solid.getGrid().spacing;
    testing::Random random(kSeed);
    for (int line = 0; line < 20; ++line) {
        const Vector3 from = drawPlace(random), to = drawPlace(random);
        const int steps = static_cast<int>((to - from).norm() / (1e-3 * h));
        ImplicitValue before = solid.calcImplicit(from);
        double largest = 0;
        for (int i = 1; i <= steps; ++i) {
            const ImplicitValue here = solid.calcImplicit(from + (to - from) * i / steps);
            largest = std::max(largest, (here.hessian - before.hessian).norm() * h);
            before = here;
        }
        EXPECT_LT(largest, 0.05);  // over a thousandth of a cell; the Hessian itself is of order 1 / h
    }
}

TEST(BSplineSolid, IsOnTheRightSideAndNoFartherThanTwiceTheDistance) {
    const BSplineSolid& solid = getBone().solid;
    const double reach = std::sqrt(3.0) * solid.getGrid().width;  // of the smoothing
    testing::Random random(kSeed);
    for (int i = 0; i < 5000; ++i) {
        const Vector3 p = drawPlace(random);
        const double distance = getBoneDistance().calcSignedDistance(p), height = solid.calcHeight(p);
        if (std::abs(distance) < reach) continue;
        EXPECT_EQ(distance > 0, height > 0) << p.transpose();
        EXPECT_LT(std::abs(height), 2 * std::abs(distance) + reach) << p.transpose();
        EXPECT_GT(std::abs(height), 0.3 * std::abs(distance) - reach) << p.transpose();
    }
}

TEST(BSplineSolid, IsReachedFromAnywhere) {
    const BSplineSolid& solid = getBone().solid;
    testing::Random random(kSeed);
    for (int i = 0; i < 3000; ++i) {
        const Vector3 p = drawPlace(random) + (i % 10 == 0 ? random.vector(20) : Vector3::Zero());
        const Vector3 foot = solid.findSurfacePoint(p).p;
        EXPECT_LT(std::abs(solid.calcHeight(foot)), 1e-13) << p.transpose();
        const double distance = getBoneDistance().findNearest(p).distance;
        EXPECT_LT((foot - p).norm(), 1.5 * distance + 3 * solid.getGrid().width) << p.transpose();
    }
}

TEST(BSplineSolid, TakesAnyNumbersWithoutACrash) {
    const BSplineSolid& solid = getBone().solid;
    for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e300, 1e-300})
        for (int axis = 0; axis < 3; ++axis) {
            Vector3 p(0.01, 0.02, 0.03);
            p[axis] = odd;
            solid.calcImplicit(p);
            EXPECT_EQ(std::isfinite(solid.calcHeight(p)), std::abs(odd) < 1e100);
        }
    EXPECT_TRUE(std::isfinite(solid.calcHeight(Vector3(1e6, -1e6, 1e6))));
}

/** Non-uniform scaling of a body, as models have it. */
TEST(BSplineSolid, IsScaledAsItsMeshWouldBe) {
    const Vector3 factors(1.2, 0.9, 1.1);
    const auto solid = std::make_shared<BSplineSolid>(getBone().solid);
    const auto scaled = makeScaledSurface(solid, Matrix3(factors.asDiagonal()));
    testing::Random random(kSeed);
    for (int i = 0; i < 100; ++i) {
        const Vector3 foot = solid->findSurfacePoint(drawPlace(random)).p;
        EXPECT_NEAR(scaled->calcHeight(factors.cwiseProduct(foot)), 0, 1e-12);
    }
}

TEST(BSplineSolid, RefusesGridsThatDoNotHangTogether) {
    const SolidGrid sound =
        fitSolid(testing::scaleMesh(testing::makeBallMesh(1), Vector3::Constant(0.1))).solid.getGrid();
    BSplineSolid{sound};
    const auto expectRefusal = [&](const std::function<void(SolidGrid&)>& spoil, const std::string& message) {
        SolidGrid grid = sound;
        spoil(grid);
        try {
            BSplineSolid solid(grid);
            ADD_FAILURE() << "not refused: " << message;
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
    };
    expectRefusal([](SolidGrid& grid) { grid.spacing = 0; }, "spacing must be positive and finite, but is 0");
    expectRefusal([](SolidGrid& grid) { grid.size = kNaN; }, "size must be positive and finite, but is nan");
    expectRefusal([](SolidGrid& grid) { grid.blendEnd = grid.blendBegin; }, "must end above it");
    expectRefusal([](SolidGrid& grid) { grid.origin.x() = kInfinity; }, "origins must be finite");
    // Squares of such lengths are no numbers: 2026-11-28, heights that were none.
    expectRefusal([](SolidGrid& grid) { grid.farSpacing = 1e200; }, "coarse spacing must lie between");
    expectRefusal([](SolidGrid& grid) { grid.spacing = 1e-200; }, "spacing must lie between");
    expectRefusal([](SolidGrid& grid) { grid.farOrigin.y() = -1e200; }, "origins must be finite, and no farther");
    expectRefusal([](SolidGrid& grid) { grid.controls[5] = 1e35f; }, "control value 5 is 1.00000004");
    expectRefusal([](SolidGrid& grid) { grid.numBricks[1] = 0; }, "bricks along an axis, got 0");
    expectRefusal([](SolidGrid& grid) { grid.numBricks[1] = 2000000; }, "bricks along an axis, got 2000000");
    expectRefusal([](SolidGrid& grid) { grid.bricks.pop_back(); }, "bricks, got");
    expectRefusal([](SolidGrid& grid) { grid.bricks[0] = -3; }, "brick 0 names control values -3");
    expectRefusal([](SolidGrid& grid) { grid.bricks[0] = 100000; }, "brick 0 names control values 100000");
    expectRefusal([](SolidGrid& grid) { grid.controls.pop_back(); }, "1331 control values for each brick");
    expectRefusal([](SolidGrid& grid) { grid.controls[5] = std::nanf(""); }, "control value 5 is nan");
    expectRefusal([](SolidGrid& grid) { grid.farControls[7] = -1; }, "coarse control value 7 is -1");
    expectRefusal([](SolidGrid& grid) { grid.farControls.clear(); }, "coarse control values, got 0");
}

}  // namespace
}  // namespace tautline
