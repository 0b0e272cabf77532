// SPDX-License-Identifier: Apache-2.0
/** Derivatives of a path with respect to the poses of its elements, against central differences. */
#include "tautline/paths/path_sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <random>

#include "tautline/error.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline {
namespace {

/** A path over each kind of surface with a via point, all touched. */
struct MixedScene {
    PathProblem problem;
    PathPose pose;
    PathSolution path;
    PathSolver solver;

    MixedScene() {
        problem.addPoint("origin");
        problem.addObstacle("cylinder", std::make_shared<Cylinder>(0.6), Vector3(0, 0.6, 0));
        problem.addObstacle("torus", std::make_shared<Torus>(0.9, 0.3), Vector3(0.62, 0, 0));
        problem.addPoint("via");
        problem.addObstacle("ellipsoid", std::make_shared<Ellipsoid>(Vector3(0.9, 0.55, 0.7)), Vector3(0, 0.55, 0));
        problem.addObstacle("sphere", std::make_shared<Sphere>(0.4), Vector3(0, -0.4, 0));
        problem.addPoint("insertion");
        const Matrix3 across = Eigen::AngleAxisd(kPi / 2, Vector3::UnitY()).toRotationMatrix();
        pose.X_GE = {Pose(Vector3(-0.4, -0.7, 0.5)), Pose(Vector3(0.8, 0.0, 0)), Pose(across, Vector3(2.6, 0.9, 0.1)),
                     Pose(Vector3(3.2, -0.6, 0.1)),  Pose(Vector3(4.4, 0.1, 0)), Pose(Vector3(5.9, 0.4, -0.2)),
                     Pose(Vector3(6.8, 0.6, -0.3))};
        solver.solve(problem, pose, path);
    }

    /** The scene moved along V for a time h. */
    PathPose calcMovedPose(const std::vector<SpatialVelocity>& V, double h) const {
        PathPose moved = pose;
        for (std::size_t e = 0; e < V.size(); ++e) {
            const double angle = h * V[e].w.norm();
            if (V[e].w.norm() > 0)
                moved.X_GE[e].R = Eigen::AngleAxisd(angle, V[e].w.normalized()).toRotationMatrix() * pose.X_GE[e].R;
            moved.X_GE[e].p += h * V[e].v;
        }
        return moved;
    }

    PathSolution solveMoved(const std::vector<SpatialVelocity>& V, double h) {
        PathSolution moved = path;
        solver.solve(problem, calcMovedPose(V, h), moved);
        return moved;
    }
};

std::vector<SpatialVelocity> makeMotion(unsigned seed, std::size_t n) {
    std::mt19937 random(seed);
    const auto number = [&random] { return 2 * (random() / static_cast<double>(std::mt19937::max())) - 1; };
    std::vector<SpatialVelocity> V(n);
    for (SpatialVelocity& v : V) v = {Vector3(number(), number(), number()), Vector3(number(), number(), number())};
    return V;
}

/** Differences of order four: truncation ~ h^4 = 2e-15 times the fifth derivative, rounding ~ 1e-12/h = 5e-9 (the
path error that Newton leaves, over h). */
constexpr double kStep = 2e-4;
template <class Function>
auto calcDifference(const Function& f) {
    return ((8 * (f(kStep) - f(-kStep)) - (f(2 * kStep) - f(-2 * kStep))) / (12 * kStep)).eval();
}

/** Unit forces, moments and contact points of all elements in one column, in ground. */
Eigen::VectorXd collect(const MixedScene& scene, const PathSolution& path, const PathPose& pose) {
    std::vector<SpatialForce> F;
    calcUnitForces(path, pose, F);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(12 * F.size());
    for (std::size_t e = 0; e < F.size(); ++e) {
        all.segment<3>(12 * e) = F[e].force, all.segment<3>(12 * e + 3) = F[e].moment;
        if (scene.problem.getElement(static_cast<int>(e)).isPoint()) continue;
        all.segment<3>(12 * e + 6) = pose.X_GE[e] * path.contacts[e].geodesic.P.x;
        all.segment<3>(12 * e + 9) = pose.X_GE[e] * path.contacts[e].geodesic.Q.x;
    }
    return all;
}

TEST(PathSensitivity, AllObstaclesOfTheSceneAreTouched) {
    const MixedScene scene;
    ASSERT_EQ(scene.path.status, PathStatus::Solved);
    for (int e : {1, 2, 4, 5}) EXPECT_TRUE(scene.path.contacts[e].isTouched) << e;
}

TEST(PathSensitivity, FirstDerivativeOfTheLengthIsMinusTheUnitForces) {
    MixedScene scene;
    std::vector<SpatialForce> F;
    calcUnitForces(scene.path, scene.pose, F);
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto V = makeMotion(seed, F.size());
        double derivative = 0;
        for (std::size_t e = 0; e < F.size(); ++e) derivative -= F[e].force.dot(V[e].v) + F[e].moment.dot(V[e].w);
        const double difference =
            calcDifference([&](double h) { return Eigen::Matrix<double, 1, 1>(scene.solveMoved(V, h).length); })[0];
        EXPECT_NEAR(derivative, difference, 1e-8 * std::max(1.0, std::abs(derivative))) << "seed " << seed;
    }
}

TEST(PathSensitivity, RatesOfForcesAndContactPointsAreTheirDifferences) {
    MixedScene scene;
    PathSensitivity sensitivity;
    PathVariation variation;
    sensitivity.setPath(scene.problem, scene.pose, scene.path);
    double worst = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto V = makeMotion(seed, scene.pose.X_GE.size());
        ASSERT_TRUE(sensitivity.calcVariation(V, variation));
        const Eigen::VectorXd difference =
            calcDifference([&](double h) { return collect(scene, scene.solveMoved(V, h), scene.calcMovedPose(V, h)); });
        for (std::size_t e = 0; e < scene.pose.X_GE.size(); ++e) {
            const Vector3 rates[] = {variation.forceRate[e].force, variation.forceRate[e].moment, variation.PRate[e],
                                     variation.QRate[e]};
            for (int k = 0; k < 4; ++k) {
                const double error =
                    (rates[k] - difference.segment<3>(12 * e + 3 * k)).norm() / std::max(1.0, rates[k].norm());
                worst = std::max(worst, error);
                EXPECT_LT(error, 1e-6) << "quantity " << k << " of element " << e << ", seed " << seed;
            }
        }
    }
    std::cout << "largest relative difference " << worst << "\n";
}

TEST(PathSensitivity, LengthRateAgreesWithTheKinematics) {
    const MixedScene scene;
    PathSensitivity sensitivity;
    PathVariation variation;
    sensitivity.setPath(scene.problem, scene.pose, scene.path);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto V = makeMotion(seed, scene.pose.X_GE.size());
        sensitivity.calcVariation(V, variation);
        EXPECT_NEAR(variation.lengthRate, calcLengthRate(scene.path, scene.pose, V), 1e-13);
    }
}

TEST(PathSensitivity, SecondDerivativesAreSymmetric) {
    // For pure translations dL/dp is a gradient, and its derivative a symmetric matrix.
    MixedScene scene;
    PathSensitivity sensitivity;
    sensitivity.setPath(scene.problem, scene.pose, scene.path);
    const std::size_t n = scene.pose.X_GE.size();
    Eigen::MatrixXd hessian(3 * n, 3 * n);
    PathVariation variation;
    for (std::size_t column = 0; column < 3 * n; ++column) {
        std::vector<SpatialVelocity> V(n);
        V[column / 3].v[static_cast<int>(column % 3)] = 1;
        ASSERT_TRUE(sensitivity.calcVariation(V, variation));
        for (std::size_t e = 0; e < n; ++e) hessian.block<3, 1>(3 * e, column) = -variation.forceRate[e].force;
    }
    EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-10 * hessian.norm());
    EXPECT_GT(hessian.norm(), 0.1);
}

TEST(PathSensitivity, RigidMotionOfEverythingChangesNothing) {
    const MixedScene scene;
    PathSensitivity sensitivity;
    PathVariation variation;
    sensitivity.setPath(scene.problem, scene.pose, scene.path);
    const Vector3 w(0.3, -0.5, 0.7), v(1, 2, -1);
    std::vector<SpatialVelocity> V;
    for (const Pose& X : scene.pose.X_GE) V.push_back({w, v + w.cross(X.p)});
    ASSERT_TRUE(sensitivity.calcVariation(V, variation));
    EXPECT_NEAR(variation.lengthRate, 0, 1e-13);
    for (const Vector4& rate : variation.xiRate) EXPECT_LT(rate.norm(), 1e-11);
}

/** Path error with which a solve of the moved scene begins. */
double calcFirstError(MixedScene& scene, const std::vector<SpatialVelocity>& V, double h, const PathSolution& start) {
    PathSolution moved = start;
    scene.solver.solve(scene.problem, scene.calcMovedPose(V, h), moved);
    EXPECT_EQ(moved.status, PathStatus::Solved);
    EXPECT_FALSE(moved.wasCold);
    return moved.errorHistory.front();
}

TEST(PathPredictor, MakesTheErrorOfTheGuessSecondOrderInTheStep) {
    MixedScene scene;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const std::vector<SpatialVelocity> V = makeMotion(seed, scene.pose.X_GE.size());
        PathSensitivity sensitivity;
        sensitivity.setPath(scene.problem, scene.pose, scene.path);
        double previousPlain = 0, previousAhead = 0;
        for (const double h : {4e-3, 2e-3, 1e-3}) {
            PathSolution ahead = scene.path;
            ASSERT_TRUE(sensitivity.predictStarts(V, h, ahead));
            const double plain = calcFirstError(scene, V, h, scene.path), error = calcFirstError(scene, V, h, ahead);
            EXPECT_LT(error, 0.2 * plain) << "seed " << seed << ", step " << h;
            if (previousPlain > 0) {
                EXPECT_NEAR(plain / previousPlain, 0.5, 0.05) << "seed " << seed;
                EXPECT_NEAR(error / previousAhead, 0.25, 0.05) << "seed " << seed;
            }
            previousPlain = plain, previousAhead = error;
        }
    }
}

std::string findRefusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "accepted";
}

// Symptom (2026-11-25): a segmentation fault for a path that had not been solved, and for too few velocities.
TEST(PathSensitivity, RefusesWhatDoesNotBelongTogether) {
    MixedScene scene;
    PathSensitivity sensitivity;
    PathVariation variation;
    const std::vector<SpatialVelocity> all(7), few(3);
    EXPECT_EQ(findRefusal([&] { sensitivity.calcVariation(all, variation); }), "path sensitivity: no path was set");
    EXPECT_EQ(findRefusal([&] { sensitivity.setPath(scene.problem, scene.pose, PathSolution()); }),
              "path sensitivity: problem of 7 elements, but a path of 0 and 7 poses");
    EXPECT_EQ(findRefusal([&] { sensitivity.calcVariation(all, variation); }), "path sensitivity: no path was set");
    PathSolution cut = scene.path;
    cut.segments.pop_back();
    EXPECT_EQ(findRefusal([&] { sensitivity.setPath(scene.problem, scene.pose, cut); }),
              "path sensitivity: contacts make 6 straight segments, but the path has 5");
    sensitivity.setPath(scene.problem, scene.pose, scene.path);
    EXPECT_EQ(findRefusal([&] { sensitivity.calcVariation(few, variation); }),
              "path sensitivity: got 3 velocities for 7 elements");
    PathSolution next = scene.path;
    EXPECT_EQ(findRefusal([&] { sensitivity.predictStarts(few, 0.1, next); }),
              "path sensitivity: got 3 velocities for 7 elements");
    EXPECT_TRUE(sensitivity.calcVariation(all, variation));
}

}  // namespace
}  // namespace tautline
