// SPDX-License-Identifier: Apache-2.0
/** Where strings slip off, in closed form, and paths followed from pose to pose. */
#include "tautline/paths/path_stability.h"

#include <gtest/gtest.h>

#include "paths/tracking/path_following.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"

namespace tautline {
namespace {

/** A string between (-l, y) and (l, y) over a surface about the origin that cuts the plane z = 0 in a unit circle. */
struct PressedString {
    explicit PressedString(std::shared_ptr<const Surface> surface) {
        problem.addPoint("A");
        problem.addObstacle("surface", std::move(surface), PassNear{Vector3(0, 1, 0)});
        problem.addPoint("B");
        pose.X_GE.resize(3);
    }
    void moveTo(double y) { pose.X_GE[0].p = Vector3(-l, y, 0), pose.X_GE[2].p = Vector3(l, y, 0); }

    /** Half the angle of the arc, counted from the top. */
    static double calcHalfAngle(double y) { return std::atan2(l, y) - std::acos(1 / std::hypot(l, y)); }

    static constexpr double l = 2;
    PathProblem problem;
    PathPose pose;
};

/** The path that stays in the plane, whether it is a minimum or not. */
PathSolution solveInPlane(PressedString& scene, double y) {
    PathSolver solver;
    scene.moveTo(0.99);
    PathSolution path;
    solver.solve(scene.problem, scene.pose, path);
    EXPECT_EQ(path.status, PathStatus::Solved);
    for (double at = 0.98; at > y; at -= 0.01) {
        scene.moveTo(std::max(at, y));
        solver.solveKeepingContacts(scene.problem, scene.pose, path);
    }
    scene.moveTo(y);
    solver.solveKeepingContacts(scene.problem, scene.pose, path);
    EXPECT_EQ(path.status, PathStatus::Solved);
    return path;
}

// Of an ellipsoid (1, 1, c) the plane z = 0 cuts a circle of Gaussian curvature 1/c^2: the sideways field is cos(s/c)
// from the top. It comes to zero at the ends of tangents of length m where tan(s/c) = c/m.
TEST(PathStability, TheMarginVanishesWhereAStringSlipsOff) {
    for (const double c : {0.3, 0.6, 0.9}) {
        PressedString scene(std::make_shared<Ellipsoid>(Vector3(1, 1, c)));
        const auto calcExcess = [&](double y) {
            const double m = std::sqrt(scene.l * scene.l + y * y - 1);
            return scene.calcHalfAngle(y) / c - std::atan2(c, m);
        };
        double low = -1, high = 0.99;  // the excess falls as y rises
        for (int i = 0; i < 60; ++i) {
            const double y = 0.5 * (low + high);
            (calcExcess(y) > 0 ? low : high) = y;
        }
        for (const double offset : {-1e-2, -1e-6, 1e-6, 1e-2}) {
            const PathSolution path = solveInPlane(scene, low + offset);
            const PathStability stability = calcPathStability(scene.problem, scene.pose, path);
            EXPECT_EQ(stability.element, 1);
            EXPECT_EQ(stability.isStable(), offset > 0) << "c " << c << ", margin " << stability.margin;
            // Linear through zero.
            EXPECT_GT(stability.margin / offset, 0.01) << c;
            EXPECT_LT(stability.margin / offset, 100) << c;
            EXPECT_EQ(isHoldingPath(scene.problem, scene.pose, path), stability.margin > kSlipMargin);
        }
    }
}

TEST(PathStability, WithoutContactThereIsNothingToLose) {
    PressedString scene(std::make_shared<Sphere>(1));
    scene.moveTo(1.1);
    PathSolution path;
    PathSolver().solve(scene.problem, scene.pose, path);
    EXPECT_EQ(calcPathStability(scene.problem, scene.pose, path).margin, 1);
    EXPECT_EQ(calcPathStability(scene.problem, scene.pose, path).element, -1);
}

/** A string over a small sphere whose end is carried past it: in one step Newton's method comes to the arc on the far
side, the longest one. */
struct PassedSphere {
    PassedSphere() {
        problem.addPoint("A");
        problem.addObstacle("sphere", std::make_shared<Sphere>(0.05));
        problem.addPoint("B");
        pose.X_GE = {Pose(Vector3(-1, 0, 0)), Pose(Vector3(0, 0.1, 0.03)), Pose()};
    }
    PathPose calcPose(double y) const {
        PathPose result = pose;
        result.X_GE[2].p = Vector3(1, y, 0);
        return result;
    }
    PathProblem problem;
    PathPose pose;
};

/** On the shortest way. */
bool follow(PathSolver& solver, const PathProblem& problem, const PathPose& from, const PathPose& to,
            PathSolution& path) {
    PoseMotion way;
    way.set(from, {}, 0, to);
    return PathFollower({}).follow(solver, problem, way, 0.5, 1, path);
}

TEST(PathFollowing, ALongStepEndsOnThePathThatShortOnesLeadTo) {
    const PassedSphere scene;
    PathSolver solver;
    PathSolution start;
    const PathPose from = scene.calcPose(0.15);
    solver.solve(scene.problem, from, start);
    ASSERT_EQ(start.status, PathStatus::Solved);
    ASSERT_TRUE(start.contacts[1].isTouched);
    PathSolution shortSteps = start;
    for (int i = 1; i <= 1000; ++i)
        solver.solveKeepingContacts(scene.problem, scene.calcPose(0.15 + 0.1 * i / 1000), shortSteps);
    const PathPose to = scene.calcPose(0.25);
    ASSERT_TRUE(isHoldingPath(scene.problem, to, shortSteps));
    PathSolution followed = start;
    ASSERT_TRUE(follow(solver, scene.problem, from, to, followed));
    EXPECT_NEAR(followed.length, shortSteps.length, 1e-13);
}

TEST(PathFollowing, IsNotCarriedBeyondTheLossOfStability) {
    PressedString scene(std::make_shared<Ellipsoid>(Vector3(1, 1, 0.3)));
    scene.moveTo(0.98);
    const PathPose from = scene.pose;
    PathSolver solver;
    PathSolution path;
    solver.solve(scene.problem, from, path);
    ASSERT_EQ(path.status, PathStatus::Solved);
    const double length = path.length;
    scene.moveTo(-0.5);
    EXPECT_FALSE(follow(solver, scene.problem, from, scene.pose, path));
    EXPECT_EQ(path.length, length);
}

}  // namespace
}  // namespace tautline
