// SPDX-License-Identifier: Apache-2.0
/** Moment arms of a hinge and their derivatives, from a path's first and second derivatives by the poses. */
#include <gtest/gtest.h>

#include <cstdio>

#include "support/surface_cases.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

/** Two bodies on a hinge about `axis` through `center`; the muscle runs from the first one, over a surface at the hinge
on its back, to the second one, which turns by q. The surface is fixed to either. */
class HingedArm {
public:
    HingedArm(std::shared_ptr<const Surface> surface, const Pose& X_ES, bool surfaceTurns)
        : m_X_ES(X_ES), m_surfaceTurns(surfaceTurns) {
        m_problem.addPoint("origin");
        m_problem.addObstacle("surface", std::move(surface), PassOnSide{X_ES.rotateBack(-Vector3::UnitX())});
        m_problem.addPoint("insertion");
    }

    static constexpr int kElements = 3;
    const Vector3 axis = Vector3(0.1, -0.05, 1).normalized(), center{0.005, 0.01, -0.004};

    PathPose calcPose(double q) const {
        const Pose turn = calcTurn(q);
        PathPose pose;
        pose.X_GE = {Pose(Vector3(-0.03, 0.3, 0.012)), m_surfaceTurns ? turn * m_X_ES : m_X_ES,
                     turn * Pose(Vector3(-0.045, -0.2, -0.015))};
        return pose;
    }
    /** dX/dq of all elements: the hinge's turning of those that it turns. */
    std::vector<SpatialVelocity> calcVelocity(const PathPose& pose) const {
        std::vector<SpatialVelocity> V(kElements);
        for (int e = m_surfaceTurns ? 1 : 2; e < kElements; ++e) V[e] = {axis, axis.cross(pose.X_GE[e].p - center)};
        return V;
    }
    PathSolution solve(double q) const { return solvePath(m_problem, calcPose(q)); }
    PathSolution solveFrom(const PathSolution& path, double q) {
        PathSolution moved = path;
        m_solver.solveKeepingContacts(m_problem, calcPose(q), moved);
        return moved;
    }

    /** r = -dL/dq = sum of F . v + M . axis over the elements that turn. */
    double calcMomentArm(const PathSolution& path, double q) const {
        const PathPose pose = calcPose(q);
        const auto V = calcVelocity(pose);
        std::vector<SpatialForce> F;
        calcUnitForces(path, pose, F);
        double r = 0;
        for (int e = 0; e < kElements; ++e) r += F[e].force.dot(V[e].v) + F[e].moment.dot(V[e].w);
        return r;
    }
    /** dr/dq: the forces change, and the velocities turn with the body, dv/dq = axis x v. */
    double calcMomentArmRate(const PathSolution& path, double q) const {
        const PathPose pose = calcPose(q);
        const auto V = calcVelocity(pose);
        std::vector<SpatialForce> F;
        calcUnitForces(path, pose, F);
        PathSensitivity sensitivity;
        PathVariation variation;
        sensitivity.setPath(m_problem, pose, path);
        EXPECT_TRUE(sensitivity.calcVariation(V, variation));
        double rate = 0;
        for (int e = 0; e < kElements; ++e)
            rate += variation.forceRate[e].force.dot(V[e].v) + variation.forceRate[e].moment.dot(V[e].w) +
                    F[e].force.dot(axis.cross(V[e].v));
        return rate;
    }

private:
    Pose calcTurn(double q) const {
        const Matrix3 R = Eigen::AngleAxisd(q, axis).toRotationMatrix();
        return {R, center - R * center};
    }

    Pose m_X_ES;
    bool m_surfaceTurns;
    PathProblem m_problem;
    PathSolver m_solver;
};

/** Central, of order six: truncation h^6 times seventh derivatives, rounding some 1e-13/h. */
template <class Function>
double calcDifference(const Function& f) {
    constexpr double h = 2e-3;
    return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

TEST(MomentArm, ItsDerivativeIsTheDifferenceOverAllKindsOfSurface) {
    const Matrix3 tilted = Eigen::AngleAxisd(0.05, Vector3(1, 2, 0).normalized()).toRotationMatrix();
    const Matrix3 body = makeBodyScaling(Vector3(1.3, 0.8, 1));
    const std::shared_ptr<const Surface> surfaces[] = {
        std::make_shared<Sphere>(0.05),
        std::make_shared<Cylinder>(0.04),
        std::make_shared<ParametricCylinder>(0.04),
        std::make_shared<Ellipsoid>(Vector3(0.05, 0.03, 0.08)),
        std::make_shared<ParametricEllipsoid>(Vector3(0.05, 0.03, 0.08)),
        std::make_shared<EllipticTorus>(0.03, 0.02, 0.04),
        std::make_shared<EllipticCylinder>(0.05, 0.03),
        std::make_shared<Capsule>(0.04, 0.05),
        std::make_shared<OffsetSurface>(std::make_shared<Ellipsoid>(Vector3(0.05, 0.03, 0.08)), 0.005),
        std::make_shared<ScaledImplicitSurface<Ellipsoid>>(Ellipsoid(Vector3(0.05, 0.03, 0.08)), body),
    };
    for (const auto& surface : surfaces)
        for (const bool surfaceTurns : {false, true})
            for (const double q : {0.05, 0.1}) {
                SCOPED_TRACE(surface->getDescription() + (surfaceTurns ? ", turning" : ", fixed") + ", q " +
                             std::to_string(q));
                HingedArm arm(surface, Pose(tilted, Vector3(0.003, -0.002, 0)), surfaceTurns);
                const PathSolution path = arm.solve(q);
                ASSERT_EQ(path.status, PathStatus::Solved);
                ASSERT_TRUE(path.contacts[1].isTouched);
                const auto calcPathAt = [&](double h) { return arm.solveFrom(path, q + h); };
                const double r = arm.calcMomentArm(path, q);
                EXPECT_NEAR(r, -calcDifference([&](double h) { return calcPathAt(h).length; }), 1e-8 * std::abs(r));
                const double rate = arm.calcMomentArmRate(path, q);
                const double difference =
                    calcDifference([&](double h) { return arm.calcMomentArm(calcPathAt(h), q + h); });
                // Over a cylinder about the hinge r is constant: relative to the arm itself, a rate per radian.
                EXPECT_NEAR(rate, difference, 1e-6 * std::max(std::abs(rate), 0.01 * std::abs(r)));
            }
}

}  // namespace
}  // namespace tautline::testing
