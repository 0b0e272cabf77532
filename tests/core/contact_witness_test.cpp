// SPDX-License-Identifier: Apache-2.0
/** Where a string comes down on a ring that it touches already, and where the pressure turns inside an arc. */
#include "tautline/paths/contact_witness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/torus.h"

namespace tautline {
namespace {

/** A string over the far tube of a lying ring, whose other end is lowered until it meets the near tube too. */
struct StringOverRing {
    PathProblem problem;
    PathPose pose;
    PathSolution path;
    PathSolver solver;

    StringOverRing() {
        problem.addPoint("origin");
        problem.addObstacle("ring", std::make_shared<Torus>(1, 0.2), Vector3(1, 0, 0.2));
        problem.addPoint("insertion");
        pose.X_GE = {Pose(Vector3(-3, 0, 1.0)), Pose(), Pose(Vector3(2, 0, -0.6))};
        solver.solve(problem, pose, path);
    }
    void lower(double z) {
        pose.X_GE[0].p.z() = z;
        solver.solveKeepingContacts(problem, pose, path);
    }
    double calcWitness() const { return calcContactWitness(problem, pose, path, 1); }
};

TEST(ContactWitness, KnowsTheHeightAtWhichASegmentPassesTheOtherSideOfARing) {
    StringOverRing scene;
    ASSERT_EQ(scene.path.status, PathStatus::Solved);
    for (const double z : {1.0, 0.7, 0.4, 0.25, 0.21, 0.19, 0.15}) {
        scene.lower(z);
        ASSERT_EQ(scene.path.status, PathStatus::Solved);
        // From the tangent point inwards the line is n . x = n . c + r, n its normal: the other center is 2 n_x below.
        const Vector3 n = scene.path.contacts[1].geodesic.P.N;
        const double height = -n.dot(Vector3(-2, 0, 0));
        const SurfaceReturn lowest = findSurfaceReturn(scene.problem, scene.pose, scene.path, 1);
        EXPECT_NEAR(lowest.height, std::min(1.0, height / 0.2), 1e-9) << z;
        const double arc = scene.path.contacts[1].start.length / scene.problem.getElement(1).surface->getSize();
        EXPECT_EQ(scene.calcWitness(), std::min(lowest.height, arc)) << z;
        EXPECT_EQ(scene.calcWitness() < 0, !verifyPath(scene.problem, scene.pose, scene.path).isMinimum()) << z;
    }
}

TEST(ContactWitness, FallsThroughZeroWhereTheLineTouchesBothTubes) {
    StringOverRing scene;
    double high = 1.0, low = 0.1;  // touched twice at the height of the tubes' tops
    scene.lower(high);
    ASSERT_GT(scene.calcWitness(), 0);
    scene.lower(low);
    ASSERT_LT(scene.calcWitness(), 0);
    while (high - low > 1e-12) {
        const double z = 0.5 * (low + high);
        scene.lower(z);
        (scene.calcWitness() < 0 ? low : high) = z;
    }
    EXPECT_NEAR(high, 0.2, 1e-9);
}

TEST(SplitWitness, IsThePressureWhereItTurnsInsideTheArc) {
    // Along the top of the ring's tube pressure is next to nothing, and turns where the arc dips to the inner side.
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("ring", std::make_shared<Torus>(1, 0.2));
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE.resize(3);
    PathSolution path;
    path.contacts.resize(3);
    path.segments.resize(2);
    ObstacleContact& contact = path.contacts[1];
    contact.isTouched = true;
    int pressing = 0, pulling = 0;
    for (const double rho : {0.81, 0.9, 0.99, 1.01, 1.1, 1.19}) {
        contact.start.point = problem.getElement(1).surface->findSurfacePoint(Vector3(rho, 0, 0.3));
        contact.start.tangent = Vector3(0, 1, 0);  // along the ring: it presses on the outer half of the tube only
        contact.start.length = 0.05;
        problem.getElement(1).surface->shootGeodesic(contact.start, {}, contact.geodesic);
        const double witness = calcSplitWitness(problem, {}, path, 1);
        EXPECT_EQ(witness > 0, contact.start.point.p.head<2>().norm() > 1) << rho;
        (witness > 0 ? pressing : pulling) += 1;
    }
    EXPECT_EQ(pressing, 3);
    EXPECT_EQ(pulling, 3);
}

TEST(SplitWitness, IsOneOnConvexSurfacesAndLiftedOnes) {
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("cylinder", std::make_shared<Cylinder>(1));
    problem.addObstacle("ring", std::make_shared<Torus>(1, 0.2));
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-3, 0.5, 0)), Pose(), Pose(Vector3(9, 9, 9)), Pose(Vector3(3, 0.5, 0))};
    const PathSolution path = solvePath(problem, pose);
    ASSERT_TRUE(path.contacts[1].isTouched);
    EXPECT_EQ(calcSplitWitness(problem, {}, path, 1), 1);
    EXPECT_EQ(calcSplitWitness(problem, {}, path, 2), 1);
}

}  // namespace
}  // namespace tautline
