// SPDX-License-Identifier: Apache-2.0
/** Length rate, forces and moments of paths: balance and power at any path error, derivative of the length. */
#include "tautline/paths/path_kinematics.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/shapes.h"
#include "tautline/error.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

/** A random path over all four shapes that holds its contacts, with random velocities of all elements. */
struct MovingScene {
    PathProblem problem;
    PathPose pose;
    std::vector<SpatialVelocity> velocity;

    explicit MovingScene(unsigned seed) {
        Random random(seed);
        const std::shared_ptr<const Surface> surfaces[] = {
            std::make_shared<Cylinder>(0.4), std::make_shared<Ellipsoid>(Vector3(0.45, 0.4, 0.9)),
            std::make_shared<Torus>(2.0, 0.3), std::make_shared<Sphere>(0.4)};
        problem.addPoint("origin");
        pose.X_GE.emplace_back(random.rotation(), Vector3(-1, 0, 0) + random.vector(0.1));
        for (int i = 0; i < 4; ++i) {
            // Over even ones and under odd ones, held between the neighbors. The tube of the torus passes
            // through (2, 0, 0) along z.
            const int side = i % 2 == 0 ? 1 : -1;
            Vector3 hint(0, 0.4 * side, 0), center(i, -0.25 * side, 0);
            Matrix3 R = Matrix3::Identity();
            if (i == 2) {
                // z_S = x_G turned into the ring's axis along y: the ring lies in the plane of x and z.
                R = Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()).toRotationMatrix();
                hint = Vector3(-2, 0, -0.3 * side), center += Vector3(2, 0.1 * side, 0);
            }
            problem.addObstacle("obstacle" + std::to_string(i), surfaces[i], hint);
            const Matrix3 tilt = Eigen::AngleAxisd(random.uniform(-0.1, 0.1), random.unitVector()).toRotationMatrix();
            pose.X_GE.emplace_back(tilt * R, center + random.vector(0.05));
            if (i == 1) {
                problem.addPoint("via");
                pose.X_GE.emplace_back(random.rotation(), Vector3(1.5, 0, 0) + random.vector(0.05));
            }
        }
        problem.addPoint("insertion");
        pose.X_GE.emplace_back(random.rotation(), Vector3(4, 0, 0) + random.vector(0.1));
        for (std::size_t e = 0; e < pose.X_GE.size(); ++e) velocity.push_back({random.vector(1), random.vector(1)});
    }

    PathPose calcPoseAt(double t) const {
        PathPose moved = pose;
        for (std::size_t e = 0; e < pose.X_GE.size(); ++e) {
            const Vector3 turn = velocity[e].w * t;
            if (turn.norm() > 0)
                moved.X_GE[e].R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose.X_GE[e].R;
            moved.X_GE[e].p += velocity[e].v * t;
        }
        return moved;
    }
};

constexpr int kScenes = 25;

TEST(PathKinematics, RateIsTheDerivativeOfTheLength) {
    int touched = 0;
    for (unsigned seed = 100; seed < 100 + kScenes; ++seed) {
        const MovingScene scene(seed);
        const PathSolution path = solvePath(scene.problem, scene.pose);
        ASSERT_EQ(path.status, PathStatus::Solved) << seed;
        for (const ObstacleContact& contact : path.contacts) touched += contact.isTouched;
        PathSolver solver;
        const auto calcLengthAt = [&](double t) {
            PathSolution moved = path;
            solver.solveKeepingContacts(scene.problem, scene.calcPoseAt(t), moved);
            return moved.length;
        };
        const double h = 2e-4;  // order 4: truncation h^4 times fifth derivatives up to 1e6, rounding 1e-14/h
        const double difference =
            (8 * (calcLengthAt(h) - calcLengthAt(-h)) - (calcLengthAt(2 * h) - calcLengthAt(-2 * h))) / (12 * h);
        EXPECT_NEAR(calcLengthRate(path, scene.pose, scene.velocity), difference, 1e-7) << seed;
    }
    EXPECT_GT(touched, 3 * kScenes);  // the scenes are not trivial
}

/** Balance and power of a path's unit forces (thesis Sec. 6.3), whatever its error. */
void expectBalanceAndPower(const MovingScene& scene, const PathSolution& path) {
    std::vector<SpatialForce> F;
    calcUnitForces(path, scene.pose, F);
    ASSERT_EQ(F.size(), scene.pose.X_GE.size());
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    double power = 0;
    for (std::size_t e = 0; e < F.size(); ++e) {
        force += F[e].force;
        moment += F[e].moment + scene.pose.X_GE[e].p.cross(F[e].force);
        power += F[e].force.dot(scene.velocity[e].v) + F[e].moment.dot(scene.velocity[e].w);
    }
    EXPECT_LT(force.norm(), 1e-12);
    EXPECT_LT(moment.norm(), 1e-12 * path.length);
    const double rate = calcLengthRate(path, scene.pose, scene.velocity);
    EXPECT_NEAR(power, -rate, 1e-10 * std::max(1.0, std::abs(rate)));  // of velocities of size 1
}

TEST(PathKinematics, ForcesBalanceAndTheirPowerIsMinusTheRateOnSolvedPaths) {
    for (unsigned seed = 200; seed < 200 + kScenes; ++seed) {
        const MovingScene scene(seed);
        expectBalanceAndPower(scene, solvePath(scene.problem, scene.pose));
    }
}

TEST(PathKinematics, ForcesBalanceAndTheirPowerIsMinusTheRateOnBadlyUnsolvedPaths) {
    PathSolverOptions options;
    options.maxIterations = 1;
    options.allowsColdStart = false;
    double largestError = 0;
    for (unsigned seed = 300; seed < 300 + kScenes; ++seed) {
        const MovingScene scene(seed);
        PathSolution path = solvePath(scene.problem, scene.pose);
        MovingScene moved = scene;
        moved.pose = scene.calcPoseAt(0.3);
        PathSolver(options).solve(moved.problem, moved.pose, path);
        largestError = std::max(largestError, path.pathError);
        expectBalanceAndPower(moved, path);
    }
    EXPECT_GT(largestError, 0.1);
}

TEST(PathKinematics, SegmentEndsFollowTheElementsWithoutRelativeMotion) {
    // All elements share one rigid motion: the length does not change.
    Random random(401);
    MovingScene scene(400);
    const SpatialVelocity rigid{random.vector(3), random.vector(3)};
    for (std::size_t e = 0; e < scene.velocity.size(); ++e)
        scene.velocity[e] = {rigid.w, rigid.v + rigid.w.cross(scene.pose.X_GE[e].p)};
    EXPECT_NEAR(calcLengthRate(solvePath(scene.problem, scene.pose), scene.pose, scene.velocity), 0, 1e-13);
}

TEST(PathKinematics, DrawingPointsRunAlongThePath) {
    const MovingScene scene(402);
    const PathSolution path = solvePath(scene.problem, scene.pose);
    std::vector<Vector3> points;
    calcDrawingPoints(path, scene.problem, scene.pose, 0.01, points);
    double polygon = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) polygon += (points[i + 1] - points[i]).norm();
    // A chord of angle d spares d^2/24 of its arc.
    EXPECT_LT(polygon, path.length * (1 + 1e-12));
    EXPECT_GT(polygon, path.length * (1 - 0.01 * 0.01 / 24));
    EXPECT_LT((points.front() - scene.pose.X_GE.front().p).norm(), 1e-15);
    EXPECT_LT((points.back() - scene.pose.X_GE.back().p).norm(), 1e-15);
}

TEST(PathKinematics, RefusesTooFewVelocitiesAndAnglesThatAreNotPositive) {
    const MovingScene scene(403);
    const PathSolution path = solvePath(scene.problem, scene.pose);
    const std::vector<SpatialVelocity> few(scene.velocity.begin(), scene.velocity.end() - 1);
    const auto findRefusal = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(findRefusal([&] { calcLengthRate(path, scene.pose, few); }),
              "length rate: got " + std::to_string(few.size()) + " velocities for " +
                  std::to_string(scene.velocity.size()) + " elements");
    std::vector<Vector3> points;
    for (const double angle : {0.0, -0.5, kNaN}) {
        const std::string refusal =
            findRefusal([&] { calcDrawingPoints(path, scene.problem, scene.pose, angle, points); });
        EXPECT_EQ(refusal.rfind("drawing points: maxAngle must be positive, but is ", 0), 0u) << refusal;
    }
}

}  // namespace
}  // namespace tautline::testing
