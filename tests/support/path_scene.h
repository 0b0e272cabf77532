// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

/** A problem with its poses, built in one go. */
struct PathScene {
    PathProblem problem;
    PathPose pose;

    PathScene& point(const Vector3& p) {
        problem.addPoint("point" + std::to_string(problem.getNumElements()));
        pose.X_GE.emplace_back(p);
        return *this;
    }
    PathScene& obstacle(std::shared_ptr<const Surface> surface, const Pose& X,
                        std::optional<Vector3> hint_S = std::nullopt) {
        problem.addObstacle("obstacle" + std::to_string(problem.getNumElements()), std::move(surface), hint_S);
        pose.X_GE.push_back(X);
        return *this;
    }
    PathSolution solve(const PathSolverOptions& options = {}) const { return solvePath(problem, pose, options); }
    PathScene movedBy(const Pose& X) const {
        PathScene moved = *this;
        for (Pose& X_GE : moved.pose.X_GE) X_GE = X * X_GE;
        return moved;
    }
};

/** Finite and drawable, whatever the status (path_solution.h). */
inline void expectDrawable(const PathScene& scene, const PathSolution& path) {
    EXPECT_TRUE(std::isfinite(path.length) && std::isfinite(path.pathError));
    ASSERT_FALSE(path.segments.empty());
    for (const StraightSegment& s : path.segments) {
        EXPECT_TRUE(s.A.allFinite() && s.B.allFinite() && s.e.allFinite() && std::isfinite(s.length));
        EXPECT_NEAR(s.e.norm(), 1, 1e-14);
    }
    // An end that lies on a surface is lifted off by 1e-7 of its size (path_solver.h), all others stay.
    EXPECT_LT((path.segments.front().A - scene.pose.X_GE.front().p).norm(), 2e-7);
    EXPECT_LT((path.segments.back().B - scene.pose.X_GE.back().p).norm(), 2e-7);
    std::vector<Vector3> points;
    calcDrawingPoints(path, scene.problem, scene.pose, 0.1, points);
    for (const Vector3& p : points) EXPECT_TRUE(p.allFinite());
    std::vector<SpatialForce> F;
    calcUnitForces(path, scene.pose, F);
    for (const SpatialForce& f : F) EXPECT_TRUE(f.force.allFinite() && f.moment.allFinite());
}

/** Four quarter circles in a plane (osim-format.md, "Analytic cases"): radii 1, 1, 1.5, 2, straight parts of 15. */
inline PathScene makePlanarChain() {
    const Matrix3 turned = Eigen::AngleAxisd(kPi / 2, Vector3::UnitY()).toRotationMatrix();
    PathScene scene;
    const auto add = [&](std::shared_ptr<const Surface> surface, const Matrix3& R, const Vector3& p,
                         const Vector3& middle_G) {
        const Pose X(R, p);
        scene.obstacle(std::move(surface), X, X.shiftBack(middle_G));
    };
    const double h = std::sqrt(0.5);
    scene.point(Vector3(0, 0, 0));
    add(std::make_shared<Torus>(10, 1), turned, Vector3(1, 11, 0), Vector3(1 - h, 1 + h, 0));
    add(std::make_shared<Ellipsoid>(Vector3(1, 1, 6)), Matrix3::Identity(), Vector3(4.5, 1, 0),
        Vector3(4.5 + h, 1 + h, 0));
    add(std::make_shared<Torus>(10, 1.5), turned, Vector3(4, -12, 0), Vector3(4 + 1.5 * h, -2 - 1.5 * h, 0));
    add(std::make_shared<Cylinder>(2), Matrix3::Identity(), Vector3(-2, -1.5, 0), Vector3(-2 - 2 * h, -1.5 - 2 * h, 0));
    scene.point(Vector3(-4, 0, 0));
    return scene;
}

}  // namespace tautline::testing
