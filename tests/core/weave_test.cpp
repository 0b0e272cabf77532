// SPDX-License-Identifier: Apache-2.0
/** The weave against the mean lengths that peers.md gives for it: values computed by others. */
#include <gtest/gtest.h>

#include "paths/search/elastic_band.h"
#include "support/weave_scene.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

using Kind = WeaveScene::Kind;

/** Mean length over the first 400 steps with warm starts; every step must be solved and hold all contacts. */
double calcMeanLength(Kind kind, int count) {
    const WeaveScene scene(kind, count);
    PathSolver solver;
    PathPose pose;
    PathSolution path;
    double sum = 0;
    constexpr int kSteps = 400;
    for (int k = 0; k < kSteps; ++k) {
        scene.calcPose(k * WeaveScene::kTimeStep, pose);
        solver.solve(scene.getProblem(), pose, path);
        EXPECT_EQ(path.status, PathStatus::Solved) << "step " << k;
        EXPECT_EQ(path.wasCold, k == 0) << "step " << k;
        for (int i = 1; i <= count; ++i) EXPECT_TRUE(path.contacts[i].isTouched) << "step " << k << " obstacle " << i;
        sum += path.length;
    }
    return sum / kSteps;
}

// Half a unit of the last digit printed; twice that for n = 10, where the path of tolerance 1e-3 to 1e-11, warm
// or cold, has 18.511405764 throughout.
TEST(Weave, FiveCylindersHaveTheKnownMeanLength) {
    EXPECT_NEAR(calcMeanLength(Kind::Cylinders, 5), 9.57948828, 0.6e-8);
}
TEST(Weave, TenCylindersHaveTheKnownMeanLength) {
    EXPECT_NEAR(calcMeanLength(Kind::Cylinders, 10), 18.51140575, 1.5e-8);
}

/** Length of a fine elastic string laid along a path and let go. */
double calcRelaxedLength(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    const PosedProblem scene{problem, pose};
    std::vector<PassedObstacle> previous;
    rememberPath(path, previous);
    ElasticBand band;
    band.lay(scene, calcPreviousRoute(scene, previous).waypoints);
    band.relax(problem, {0.25, 1e-6, 6000});
    double length = 0;
    for (std::size_t k = 0; k + 1 < band.getNodes().size(); ++k)
        length += (band.getNodes()[k + 1] - band.getNodes()[k]).norm();
    return length;
}

// Symptom (2026-11-22): 6.23041739, the mean length of saddles, which the path over an ellipsoid's far side often is.
TEST(Weave, FiveEllipsoidsHaveTheKnownMeanLength) {
    EXPECT_NEAR(calcMeanLength(Kind::Ellipsoids, 5), 6.21699317, 0.6e-8);
}

TEST(Weave, StringLaidAlongThePathOverSpheresStays) {
    // The spheres have several minima, so warm need not equal cold; but each path must hold a string. The
    // string's chords of 0.03 radii spare 4e-5 of each arc, less than 1e-4 in all; slipping off spares 1e-2.
    const WeaveScene scene(Kind::Spheres, 5);
    PathSolver solver;
    PathPose pose;
    PathSolution path;
    for (int k = 0; k < 400; ++k) {
        scene.calcPose(k * WeaveScene::kTimeStep, pose);
        solver.solve(scene.getProblem(), pose, path);
        ASSERT_EQ(path.status, PathStatus::Solved) << k;
        if (k % 20 != 0) continue;
        EXPECT_NEAR(calcRelaxedLength(scene.getProblem(), pose, path), path.length, 5e-4) << k;
    }
}

TEST(Weave, AHundredCylindersSolveCold) {
    const WeaveScene scene(Kind::Cylinders, 100);
    PathPose pose;
    scene.calcPose(0, pose);
    const PathSolution path = solvePath(scene.getProblem(), pose);
    EXPECT_EQ(path.status, PathStatus::Solved);
    for (int i = 1; i <= 100; ++i) EXPECT_TRUE(path.contacts[i].isTouched) << i;
}

TEST(Weave, RateIsTheDerivativeOfTheLength) {
    for (Kind kind : {Kind::Cylinders, Kind::Ellipsoids, Kind::Spheres}) {
        const WeaveScene scene(kind, 5);
        PathPose pose;
        std::vector<SpatialVelocity> velocity;
        for (double t : {0.1, 1.7, 3.3}) {
            const auto calcLengthAt = [&](double time) {
                scene.calcPose(time, pose);
                return solvePath(scene.getProblem(), pose).length;
            };
            // Order 4: truncation h^4, rounding 1e-14/h.
            const double h = 1e-3;
            const double difference = (8 * (calcLengthAt(t + h) - calcLengthAt(t - h)) -
                                       (calcLengthAt(t + 2 * h) - calcLengthAt(t - 2 * h))) /
                                      (12 * h);
            scene.calcPose(t, pose);
            scene.calcVelocity(t, velocity);
            EXPECT_NEAR(calcLengthRate(solvePath(scene.getProblem(), pose), pose, velocity), difference, 1e-9);
        }
    }
}

}  // namespace
}  // namespace tautline::testing
