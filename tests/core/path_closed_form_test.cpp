// SPDX-License-Identifier: Apache-2.0
/** Paths solved by hand. Path error 1e-11 and less leaves lengths exact to rounding: 1e-13 relative. */
#include "tautline/paths/path_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/path_scene.h"
#include "support/planar_chain.h"
#include "support/random.h"

namespace tautline::testing {
namespace {

TEST(PathSolverClosedForm, CylinderWithObliqueTangents) {
    Random random(90);
    const double r = 0.4;
    int wrapped = 0;
    for (double dz : {0.0, 0.3, -2.0, 20.0})
        for (int sense : {1, -1})
            for (const Vector2& I : {Vector2(1.3, 0), Vector2(0.2, -0.9), Vector2(-0.9, -0.5), Vector2(-0.9, 0.4)}) {
                const Vector2 O(-1, 0.1);
                const double planar = calcPlanarLength({{O}, {Vector2(0, 0), r, sense}, {I}});
                // Middle of the arc: halfway round from O to I on the side that the sense makes.
                const double from = std::atan2(O.y(), O.x());
                double turn = std::fmod(sense * (std::atan2(I.y(), I.x()) - from) + 4 * kPi, 2 * kPi);
                const double arc = turn - std::acos(r / O.norm()) - std::acos(r / I.norm());
                if (arc < 0.05) continue;  // the straight line is free on this side
                ++wrapped;
                const double middle = from + sense * turn / 2;
                PathScene scene;
                scene.point(Vector3(O.x(), O.y(), 0));
                scene.obstacle(std::make_shared<Cylinder>(r), Pose(),
                               Vector3(r * std::cos(middle), r * std::sin(middle), dz / 2));
                scene.point(Vector3(I.x(), I.y(), dz));
                scene = scene.movedBy(random.pose(3));
                const PathSolution path = scene.solve();
                SCOPED_TRACE("dz " + std::to_string(dz) + " turn " + std::to_string(turn));
                ASSERT_EQ(path.status, PathStatus::Solved);
                ASSERT_TRUE(path.contacts[1].isTouched);
                EXPECT_NEAR(path.length, std::hypot(planar, dz), 1e-12 * path.length);
            }
    EXPECT_GE(wrapped, 16);
}

TEST(PathSolverClosedForm, SphereGreatCircle) {
    Random random(91);
    const double r = 0.5;
    for (double y : {0.49, 0.4, 0.1, 1e-3}) {  // height of the line over the center, from grazing to the middle
        const double planar = calcPlanarLength({{Vector2(-1, y)}, {Vector2(0, 0), r, -1}, {Vector2(1.5, y)}});
        PathScene scene;
        scene.point(Vector3(-1, y, 0))
            .obstacle(std::make_shared<Sphere>(r), Pose(), Vector3(0, r, 0.1))
            .point(Vector3(1.5, y, 0));
        const PathSolution path = scene.movedBy(random.pose(3)).solve();
        ASSERT_EQ(path.status, PathStatus::Solved) << y;
        EXPECT_NEAR(path.length, planar, 1e-12 * planar) << y;
    }
}

TEST(PathSolverClosedForm, LiftedOffPathIsTheStraightLine) {
    for (double y : {0.4 + 1e-9, 0.5, 3.0}) {
        PathScene scene;
        scene.point(Vector3(-1, y, 0)).obstacle(std::make_shared<Cylinder>(0.4), Pose(), Vector3(0, 0.4, 0));
        scene.point(Vector3(1, y, 0.5));
        const PathSolution path = scene.solve();
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_FALSE(path.contacts[1].isTouched);
        EXPECT_EQ(path.segments.size(), 1u);
        EXPECT_NEAR(path.length, std::hypot(2, 0.5), 1e-15);
        EXPECT_NEAR(path.contacts[1].clearance.distance, y - 0.4, 1e-14);
    }
}

TEST(PathSolverClosedForm, BeltsOverTwoCylinders) {
    for (int second : {-1, 1}) {  // open belt, crossed belt
        const std::vector<PlanarStop> stops = {{Vector2(-2, -0.5)},
                                               {Vector2(-1, 0), 0.4, -1},
                                               {Vector2(1, 0.1), 0.7, second},
                                               {Vector2(2.5, second == 1 ? 1.0 : -1.0)}};
        PathScene scene;
        scene.point(Vector3(-2, -0.5, 0))
            .obstacle(std::make_shared<Cylinder>(0.4), Pose(Vector3(-1, 0, 0)), Vector3(0, 0.4, 0));
        scene.obstacle(std::make_shared<Cylinder>(0.7), Pose(Vector3(1, 0.1, 0)), Vector3(0, -0.7 * second, 0));
        scene.point(Vector3(2.5, second == 1 ? 1.0 : -1.0, 0));
        const PathSolution path = scene.solve();
        ASSERT_EQ(path.status, PathStatus::Solved);
        EXPECT_NEAR(path.length, calcPlanarLength(stops), 1e-13 * path.length);
    }
}

TEST(PathSolverClosedForm, UnitCircleOfThesisTab2_1) {
    // O on the circle at 8/9 pi, I at distance 2: the string leaves at pi/3. O is lifted by a hair, since a point
    // on the surface has no direction to it.
    const double phi = 8.0 / 9 * kPi, lift = 1e-7;
    PathScene scene;
    scene.point((1 + lift) * Vector3(std::cos(phi), std::sin(phi), 0));
    scene.obstacle(std::make_shared<Cylinder>(1), Pose(), Vector3(0, 1, 0)).point(Vector3(2, 0, 0));
    const PathSolution path = scene.solve();
    ASSERT_EQ(path.status, PathStatus::Solved);
    const Vector3 Q = path.contacts[1].geodesic.Q.x;
    EXPECT_NEAR(std::atan2(Q.y(), Q.x()), kPi / 3, 1e-11);
    // The lift by h adds no more than (2h)^(3/2)/3.
    EXPECT_NEAR(path.length, (8.0 / 9 - 1.0 / 3) * kPi + std::sqrt(3), 1e-10);
}

TEST(PathSolverClosedForm, PlanarChainOfFourSurfaces) {
    const PathScene scene = makePlanarChain();
    const PathSolution path = scene.solve();
    ASSERT_EQ(path.status, PathStatus::Solved);
    EXPECT_NEAR(path.length, 15 + kPi / 2 * (1 + 1 + 1.5 + 2), 1e-10);
    std::vector<SpatialForce> F;
    calcUnitForces(path, scene.pose, F);
    // By hand: force e_out - e_in; moments about z, about the ground's origin and about each element's.
    const Vector2 forces[] = {{0, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}, {0, -1}};
    const double aboutGround[] = {0, -2, -3.5, 2, -0.5, 4}, aboutElement[] = {0, 10, 0, 10, 0, 0};
    for (int e = 0; e < 6; ++e) {
        EXPECT_LT((F[e].force - Vector3(forces[e].x(), forces[e].y(), 0)).norm(), 1e-9) << e;
        EXPECT_LT((F[e].moment - Vector3(0, 0, aboutElement[e])).norm(), 1e-9) << e;
        const Vector3 moment_G = F[e].moment + scene.pose.X_GE[e].p.cross(F[e].force);
        EXPECT_LT((moment_G - Vector3(0, 0, aboutGround[e])).norm(), 1e-9) << e;
    }
}

TEST(PathSolverClosedForm, ViaPoints) {  // osim-format.md, "Analytic cases"
    const Vector3 points[] = {{0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {-4, 1, 2}, {-4, 0, 0}};
    PathScene scene;
    for (const Vector3& p : points) scene.point(p);
    const PathSolution path = scene.solve();
    EXPECT_EQ(path.status, PathStatus::Solved);
    EXPECT_NEAR(path.length, 7 + std::sqrt(5), 1e-14);
    std::vector<SpatialForce> F;
    calcUnitForces(path, scene.pose, F);
    const double a = 1 / std::sqrt(5), b = 2 / std::sqrt(5);
    const Vector3 forces[] = {{0, 1, 0}, {0, -1, 1}, {-1, 0, -1}, {1, -a, -b}, {0, a, b}};
    for (int e = 0; e < 5; ++e) {
        EXPECT_LT((F[e].force - forces[e]).norm(), 1e-15) << e;
        EXPECT_EQ(F[e].moment.norm(), 0) << e;
    }
}

TEST(PathSolverClosedForm, MomentArmOfACylinderOnAPin) {  // osim-format.md, "Analytic cases"
    const double r = 0.2, reach = 0.5;
    const auto solveAt = [&](double q, double& arm) {
        PathScene scene;
        scene.point(Vector3(-reach, 0, 0)).obstacle(std::make_shared<Cylinder>(r), Pose(), Vector3(0, r, 0));
        scene.point(Vector3(reach * std::cos(q), reach * std::sin(q), 0));
        const PathSolution path = scene.solve();
        std::vector<SpatialVelocity> V(3);
        V[2].v = Vector3(-reach * std::sin(q), reach * std::cos(q), 0);
        arm = -calcLengthRate(path, scene.pose, V);
        return path;
    };
    double arm;
    EXPECT_TRUE(solveAt(0, arm).contacts[1].isTouched);
    EXPECT_NEAR(arm, r, 1e-12);
    const PathSolution lifted = solveAt(kPi / 2, arm);
    EXPECT_FALSE(lifted.contacts[1].isTouched);
    EXPECT_NEAR(lifted.length, reach * std::sqrt(2), 1e-15);
    EXPECT_NEAR(arm, reach * std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(solveAt(kPi * (1 - 1e-6), arm).length, 0, 2e-6);
    EXPECT_NEAR(arm, reach, 1e-10);
}

}  // namespace
}  // namespace tautline::testing
