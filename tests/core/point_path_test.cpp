// SPDX-License-Identifier: Apache-2.0
/** Paths without obstacles, which are laid and not searched for. */
#include <gtest/gtest.h>

#include <limits>

#include "support/seeded_random.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/sphere.h"

namespace tautline::testing {
namespace {

Pose makePlace(const Vector3& p) {
    Pose X;
    X.R = Matrix3::Identity();
    X.p = p;
    return X;
}

/** A sphere far away has the same path searched for. */
TEST(PointPath, IsThatOfASearchPastADistantObstacle) {
    SeededRandom random(20261127);
    for (int trial = 0; trial < 50; ++trial) {
        PathProblem points, withSphere;
        PathPose at, atWithSphere;
        for (int e = 0; e < 6; ++e) {
            points.addPoint("p" + std::to_string(e));
            withSphere.addPoint("p" + std::to_string(e));
            at.X_GE.push_back(makePlace({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}));
            atWithSphere.X_GE.push_back(at.X_GE.back());
            const bool isActive = e == 0 || e == 5 || random.uniform(0, 1) < 0.7;
            at.isActive.push_back(isActive);
            atWithSphere.isActive.push_back(isActive);
            if (e != 3) continue;
            withSphere.addObstacle("far", std::make_shared<Sphere>(1.0));
            atWithSphere.X_GE.push_back(makePlace({40, 50, 60}));
            atWithSphere.isActive.push_back(1);
        }
        const PathSolution laid = solvePath(points, at), found = solvePath(withSphere, atWithSphere);
        EXPECT_EQ(laid.status, PathStatus::Solved);
        EXPECT_EQ(laid.length, found.length);
        EXPECT_EQ(laid.pathError, 0.0);
        EXPECT_FALSE(laid.wasCold);
        ASSERT_EQ(laid.contacts.size(), 6u);
        ASSERT_EQ(laid.segments.size(), found.segments.size());
        for (std::size_t i = 0; i < laid.segments.size(); ++i) {
            EXPECT_EQ(laid.segments[i].A, found.segments[i].A);
            EXPECT_EQ(laid.segments[i].B, found.segments[i].B);
            EXPECT_EQ(laid.segments[i].e, found.segments[i].e);
        }
    }
}

TEST(PointPath, PointsThatCoincideHaveADirectionAndNoLength) {
    PathProblem problem;
    for (const char* name : {"a", "b", "c"}) problem.addPoint(name);
    PathPose pose;
    for (const double x : {0.0, 0.0, 2.0}) pose.X_GE.push_back(makePlace({x, 0, 0}));
    const PathSolution path = solvePath(problem, pose);
    EXPECT_EQ(path.length, 2.0);
    EXPECT_EQ(path.segments.at(0).length, 0.0);
    EXPECT_EQ(path.segments.at(0).e.norm(), 1.0);
}

TEST(PointPath, IsNoneInAPoseThatIsNotFinite) {
    PathProblem problem;
    for (const char* name : {"a", "b"}) problem.addPoint(name);
    PathPose pose;
    for (const double x : {0.0, std::numeric_limits<double>::infinity()}) pose.X_GE.push_back(makePlace({x, 0, 0}));
    EXPECT_EQ(solvePath(problem, pose).status, PathStatus::NotConverged);
}

}  // namespace
}  // namespace tautline::testing
