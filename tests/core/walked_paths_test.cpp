// SPDX-License-Identifier: Apache-2.0
/** A path that is continued along a motion against the cold answer to the same pose: equal, or said to be where it is
because of its history. */
#include <gtest/gtest.h>

#include <cmath>

#include "support/moving_scenes.h"
#include "support/path_scene.h"
#include "tautline/paths/path_explanation.h"

namespace tautline::testing {
namespace {

bool isSaid(const PathSolution& path) {
    return path.status != PathStatus::Solved || !path.followsHints() || path.dependsOnHistory();
}

bool areEqual(const PathSolution& a, const PathSolution& b) {
    return a.status == b.status && std::abs(a.length / b.length - 1) < 1e-9;
}

/** Counts of poses on random walks. */
struct Walks {
    int poses = 0, equal = 0, silent = 0, alarms = 0;

    void run(const PathSolverOptions& options, unsigned firstSeed, unsigned scenes) {
        constexpr int kPoses = 250;
        for (unsigned seed = firstSeed; seed < firstSeed + scenes; ++seed) {
            const WalkedScene scene(seed);
            PathSolver solver(options);
            PathSolution walked;
            for (int i = 0; i < kPoses; ++i) {
                const PathPose pose = scene.calcPose(static_cast<double>(i) / kPoses);
                solver.solve(scene.getProblem(), pose, walked);
                const PathSolution cold = solvePath(scene.getProblem(), pose);
                const bool isEqual = areEqual(walked, cold);
                ++poses;
                equal += isEqual;
                silent += !isEqual && !isSaid(walked) && !isSaid(cold);
                alarms += isEqual && walked.dependsOnHistory();
            }
        }
    }
};

TEST(WalkedPaths, EqualTheColdOnesOrSayWhyNotIfThatIsCompared) {
    PathSolverOptions options;
    options.comparesWithCold = true;
    Walks walks;
    walks.run(options, 1, 24);
    walks.run(options, 1001, 12);
    EXPECT_GE(walks.equal, 0.75 * walks.poses) << "a test of nothing";
    EXPECT_EQ(walks.silent, 0);
    EXPECT_EQ(walks.alarms, 0);
}

// Symptom of a comparison that disturbs what it compares: the workspace is shared.
TEST(WalkedPaths, AreTheSameWhetherComparedOrNot) {
    PathSolverOptions options;
    options.comparesWithCold = true;
    PathSolver plain, comparing(options);
    for (const unsigned seed : {4u, 29u, 40u}) {
        const WalkedScene scene(seed);
        PathSolution a, b;
        for (int i = 0; i < 100; ++i) {
            plain.solve(scene.getProblem(), scene.calcPose(0.01 * i), a);
            comparing.solve(scene.getProblem(), scene.calcPose(0.01 * i), b);
            ASSERT_EQ(a.length, b.length) << "seed " << seed << ", pose " << i;
            ASSERT_EQ(a.status, b.status);
        }
    }
}

// The rule costs next to nothing and is not complete: minima less than 60 degrees apart on a body are not told apart.
TEST(WalkedPaths, MostlySaySoByARuleThatCostsNothing) {
    Walks walks;
    walks.run({}, 1, 18);
    EXPECT_LE(walks.silent, 0.005 * walks.poses);
}

/** One obstacle at the origin between two points in the plane z = 0. */
PathScene makeScene(std::shared_ptr<const Surface> surface, const StartHint& hint, double yA, double yB) {
    PathScene scene;
    scene.point(Vector3(-2, yA, 0)).obstacle(std::move(surface), Pose()).point(Vector3(2, yB, 0.01));
    scene.problem.setHint(1, hint);
    return scene;
}

class PathsThatAreCarriedAcross : public ::testing::TestWithParam<std::shared_ptr<const Surface>> {};

// The ends sink from above the middle of the body to far below it, and the string is held up by it.
TEST_P(PathsThatAreCarriedAcross, SayThatAColdOneWouldPassOnTheOtherSide) {
    PathSolution path;
    PathSolver solver;
    for (double y = 0.3; y > -0.35; y -= 0.05) {
        const PathScene scene = makeScene(GetParam(), {}, y, y + 0.01);
        solver.solve(scene.problem, scene.pose, path);
        ASSERT_EQ(path.status, PathStatus::Solved);
        const PathSolution cold = scene.solve();
        if (std::abs(y + 0.005) < 0.03) continue;  // through the middle either side will do
        EXPECT_EQ(path.dependsOnHistory(), y < 0) << "y = " << y;
        EXPECT_EQ(areEqual(path, cold), y > 0) << "y = " << y;
        EXPECT_TRUE(path.followsHints());
        EXPECT_FALSE(cold.dependsOnHistory());
    }
    const PathScene scene = makeScene(GetParam(), {}, -0.3, -0.29);
    solver.solve(scene.problem, scene.pose, path);
    EXPECT_NE(explainStatus(scene.problem, scene.pose, path).find("continued round"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Over, PathsThatAreCarriedAcross,
                         ::testing::Values(std::make_shared<Cylinder>(0.5),
                                           std::make_shared<Ellipsoid>(Vector3(0.4, 0.5, 1.0))));

// What is asked for does not depend on history, however far round it leads.
TEST(WalkedPaths, OnTheSideAskedForAreWhereAColdOneIs) {
    for (const StartHint& hint : {StartHint(PassOnSide{Vector3(0, 1, 0)}), StartHint(PassNear{Vector3(0, 0.5, 0)}),
                                  StartHint(WindAround{-0.6})}) {
        PathSolution path;
        PathSolver solver;
        for (double y = 0.3; y > -0.45; y -= 0.05) {
            const PathScene scene = makeScene(std::make_shared<Cylinder>(0.5), hint, y, y + 0.01);
            solver.solve(scene.problem, scene.pose, path);
            EXPECT_TRUE(areEqual(path, scene.solve())) << "hint " << hint.index() << ", y = " << y;
            EXPECT_FALSE(path.dependsOnHistory()) << "hint " << hint.index() << ", y = " << y;
        }
    }
}

// About a drum that winds up a rope the straight line goes the short way.
TEST(WalkedPaths, ThatAreWoundUpDependOnTheirHistory) {
    const DrumScene drum;
    PathSolution path;
    PathSolver solver;
    for (double turned = 0; turned < 12; turned += 0.4) {
        solver.solve(drum.getProblem(), drum.calcPose(turned), path);
        ASSERT_NEAR(path.length, drum.calcLength(turned), 1e-8);
        const PathSolution cold = solvePath(drum.getProblem(), drum.calcPose(turned));
        EXPECT_EQ(path.dependsOnHistory(), !areEqual(path, cold)) << "turned by " << turned;
    }
}

}  // namespace
}  // namespace tautline::testing
