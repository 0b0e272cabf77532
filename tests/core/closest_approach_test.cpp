// SPDX-License-Identifier: Apache-2.0
/** Where a straight line comes low over a surface: the search for it, and what a path makes of what it finds. */
#include "surfaces/closest_approach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/path_scene.h"
#include "support/random.h"
#include "support/surface_cases.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/scaled_surface.h"

namespace tautline::testing {
namespace {

/** Lowest of many heights along a line. */
double calcLowestOfMany(const Surface& surface, const Vector3& A, const Vector3& e, double length) {
    constexpr int kSamples = 4000;
    double lowest = kInfinity;
    for (int i = 0; i <= kSamples; ++i) lowest = std::min(lowest, surface.calcHeight(A + i * length / kSamples * e));
    return lowest;
}

// 2026-11-25: a layer over a sheared torus read clear where the line ran through it: the lowest place over the base,
// led on by Newton's method, ended at the line's end.
TEST(ClosestApproach, IsBelowTheSurfaceWhereManySamplesSayFromNearAndFromFar) {
    int below = 0;
    for (const SurfaceCase& c : makeSurfaceCases()) {
        const bool hasRings = c.name.find("Torus") != std::string::npos;
        if (!hasRings && c.name.find("Pear") == std::string::npos && c.name.find("Offset") == std::string::npos)
            continue;
        if (c.name.find("Patch") != std::string::npos) continue;  // feet on their extensions are not unique
        Random random(41);
        const double size = c.surface->getSize();
        for (const double reach : {3.0, 30.0, 300.0})
            for (int i = 0; i < 15; ++i) {
                const Vector3 middle = c.center + c.extent * random.vector(0.8), e = random.vector(1).normalized();
                const Vector3 A = middle - reach * size * e;
                const double length = 2 * reach * size;
                const double s = c.surface->findLowestPoint(A, e, length);
                const double found = c.surface->calcHeight(A + s * e);
                // Heights are exact in sign and near the surface, elsewhere of the right magnitude (surface.h).
                const double lowest = calcLowestOfMany(*c.surface, A, e, length);
                EXPECT_TRUE(found <= 1.5 * std::abs(lowest)) << c.name << " " << reach << " " << found << " " << lowest;
                EXPECT_TRUE(found < 0 || lowest > -1e-6 * size) << c.name << " " << reach << " " << lowest;
                if (found < 0) ++below;
            }
    }
    EXPECT_GT(below, 100);
}

TEST(ClosestApproach, IsNoneAtATangentEnd) {
    const Torus torus(1, 0.2);
    const Vector3 top(1, 0, 0.2), e(1, 0, 0);  // leaves the tube outwards
    EXPECT_FALSE(findClosestApproach(torus, top, e, 5, 0.2));
    EXPECT_FALSE(findClosestApproach(torus, top + 5 * e, -e, 5, 0.2));
    const auto across = findClosestApproach(torus, top, -e, 5, 0.2);  // and inwards, over the other side of the tube
    ASSERT_TRUE(across);
    EXPECT_NEAR(across->s, 2, 1e-6);
    EXPECT_NEAR(across->height, 0, 1e-12);
}

TEST(ClosestApproach, EndsTheSearchOnLinesBeyondAllMeasure) {
    const Torus torus(1, 0.2);
    for (const double length : {1e8, 1e16, 1e30, 1e300})
        for (const Vector3& e : {Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(0.6, 0, 0.8)}) {
            const Vector3 top(1, 0, 0.2);
            const auto place = findClosestApproach(torus, top, e, length, 0.2);
            EXPECT_TRUE(!place || std::isfinite(place->height));
            EXPECT_TRUE(std::isfinite(torus.findLowestPoint(top - length * e, e, length)));
        }
}

/** A line above a lying ring that tilts. */
PathScene makeTiltingRing(double tilt) {
    const Matrix3 R = Eigen::AngleAxisd(tilt, Vector3::UnitY()).toRotationMatrix();
    PathScene scene;
    scene.point(Vector3(-3, 0, 0.05)).obstacle(std::make_shared<Torus>(1, 0.02), Pose(R, Vector3::Zero()));
    scene.point(Vector3(3, 0, 0.05));
    return scene;
}

// 2026-11-25: solved, straight through the tube, 0.08 of its radius deep: the place that was watched was on the
// other side of the ring, and none of seventeen heights along the line was low.
TEST(ClosestApproach, ARingThatTiltsInOneStepIsTouchedOnTheSideThatWasNotWatched) {
    for (const double dip : {1e-6, 4e-4, 2e-3}) {
        const double tilt = std::asin(0.05 - 0.02 + dip);
        PathSolver solver;
        PathSolution path = makeTiltingRing(tilt).solve();
        ASSERT_TRUE(path.contacts[1].isTouched);
        const Vector3 touched = path.contacts[1].geodesic.P.x;
        path = makeTiltingRing(0.5 * tilt).solve();
        ASSERT_FALSE(path.contacts[1].isTouched);
        ASSERT_GT(path.contacts[1].clearance.C.p.x() * touched.x(), 0);
        const PathScene other = makeTiltingRing(-tilt);
        solver.solve(other.problem, other.pose, path);
        EXPECT_EQ(path.status, PathStatus::Solved);
        ASSERT_TRUE(path.contacts[1].isTouched) << dip;
        EXPECT_NEAR(path.length, other.solve().length, 1e-12) << dip;
    }
}

// 2026-11-25: solved, straight through: 400 samples, each 25 sizes from the next.
TEST(ClosestApproach, ABodyIsMetByLinesFromTenThousandSizesAway) {
    Random random(5);
    int solved = 0;
    for (int i = 0; i < 40; ++i) {
        const Vector3 e = random.vector(1).normalized(), middle = random.vector(0.3);
        PathScene scene;
        scene.point(middle - 1e4 * e).obstacle(std::make_shared<Capsule>(1, 2), Pose()).point(middle + 1e4 * e);
        const PathSolution path = scene.solve();
        EXPECT_TRUE(path.contacts[1].isTouched || path.status != PathStatus::Solved) << i;
        if (path.status == PathStatus::Solved) ++solved;
    }
    EXPECT_GE(solved, 36);
}

// 2026-11-25: the string was on the other side of an elliptic cylinder that rose by two sizes in one step, and passed
// through one that rose by three.
TEST(ClosestApproach, AStringStaysAboveACylinderThatRisesInOneStep) {
    const std::shared_ptr<const Surface> surfaces[] = {
        std::make_shared<Cylinder>(0.5), std::make_shared<EllipticCylinder>(0.8, 0.5),
        std::make_shared<ParametricEllipticCylinder>(0.8, 0.5),
        makeScaledSurface(std::make_shared<Cylinder>(0.5), Matrix3(Vector3(1.6, 1, 1).asDiagonal()))};
    for (const auto& surface : surfaces)
        for (const double rise : {0.25, 0.5, 1.0, 1.25, 1.5, 2.0, 3.0, 5.0}) {
            PathScene scene;
            scene.point(Vector3(-6, 0.6, 0.05)).obstacle(surface, Pose()).point(Vector3(6, 0.6, 0.05));
            PathSolution path = scene.solve();
            ASSERT_FALSE(path.contacts[1].isTouched);
            scene.pose.X_GE[1].p.y() = rise;
            PathSolver().solve(scene.problem, scene.pose, path);
            EXPECT_EQ(path.status, PathStatus::Solved);
            ASSERT_TRUE(path.contacts[1].isTouched) << surface->getDescription() << " " << rise;
            EXPECT_GT(path.contacts[1].geodesic.P.N.y(), 0) << surface->getDescription() << " " << rise;
        }
}

}  // namespace
}  // namespace tautline::testing
