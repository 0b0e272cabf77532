// SPDX-License-Identifier: Apache-2.0
/** What derivatives of a length do where contact changes: the first are continuous, the second jump by a known amount.
 */
#include <gtest/gtest.h>

#include "support/random.h"
#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/sphere.h"

namespace tautline::testing {
namespace {

constexpr double kRadius = 0.7, kBefore = 1.3, kAfter = 0.8;  ///< of the circle; from the origin to T, from T to q = 0
constexpr double kSlope = 1.1;                                ///< of the insertion's motion against the line [rad]

/** A string over a round obstacle in a plane. At q = 0 it is the straight tangent at T = (0, 0), the circle's center
being C = (0, -R); the insertion moves by q d with d = (cos, -sin) of kSlope: with q > 0 towards the obstacle. */
struct TangentScene {
    PathProblem problem;
    PathPose pose;
    Vector3 d_G;

    TangentScene(std::shared_ptr<const Surface> surface, double q) {
        Random random(8);
        const Pose X(random.rotation(), random.vector(1));
        problem.addPoint("origin");
        problem.addObstacle("obstacle", std::move(surface), PassOnSide{Vector3::UnitY()});
        problem.addPoint("insertion");
        const Vector3 d(std::cos(kSlope), -std::sin(kSlope), 0);
        d_G = X.rotate(d);
        pose.X_GE = {Pose(X * Vector3(-kBefore, 0, 0)), X * Pose(Vector3(0, -kRadius, 0)),
                     Pose(X * Vector3(Vector3(kAfter, 0, 0) + q * d))};
    }
    PathSolution solve(bool isTouched) const {
        PathSolution path = solvePath(problem, pose);
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_EQ(path.contacts[1].isTouched, isTouched);
        return path;
    }
};

struct Derivatives {
    double length, first, second;
};

/** By q. The insertion's velocity is constant, so d2L = -dF/dq . d with F its unit force. */
Derivatives calcDerivatives(const TangentScene& scene, const PathSolution& path) {
    PathSensitivity sensitivity;
    PathVariation variation;
    sensitivity.setPath(scene.problem, scene.pose, path);
    EXPECT_TRUE(sensitivity.calcVariation({{}, {}, {Vector3::Zero(), scene.d_G}}, variation));
    return {path.length, variation.lengthRate, -variation.forceRate[2].force.dot(scene.d_G)};
}

/** dL/dq = e . d, e being the last segment's direction, so d2L/dq2 = de/dq . d. The straight string turns about the
origin: de/dq = d_n/(l1 + l2) for the part d_n of d across it. The touching one turns about its last contact point Q,
since Q itself moves along e when the string rolls up: de/dq = d_n/l2. So

    dL = cos(kSlope) from both sides,     d2L = sin^2/(l1 + l2) lifted,     sin^2/l2 touched:

it jumps up by sin^2 l1/(l2 (l1 + l2)) at touchdown, and down by the same at lift-off. */
TEST(ContactChange, FirstDerivativeIsContinuousAndSecondJumpsAsTheClosedFormSays) {
    constexpr double kNear = 1e-9;  // deep enough to be seen: 1e-10 counts as touching
    const double across = std::pow(std::sin(kSlope), 2);
    const std::shared_ptr<const Surface> surfaces[] = {std::make_shared<Sphere>(kRadius),
                                                       std::make_shared<Cylinder>(kRadius),
                                                       std::make_shared<ParametricSphere>(kRadius)};
    for (const auto& surface : surfaces) {
        SCOPED_TRACE(surface->getDescription());
        const TangentScene before(surface, -kNear), after(surface, kNear);
        const Derivatives lifted = calcDerivatives(before, before.solve(false)),
                          touched = calcDerivatives(after, after.solve(true));
        EXPECT_NEAR(lifted.length, kBefore + kAfter, 2 * kNear);
        EXPECT_NEAR(touched.length, kBefore + kAfter, 2 * kNear);
        EXPECT_NEAR(lifted.first, std::cos(kSlope), 1e-8);
        EXPECT_NEAR(touched.first, lifted.first, 1e-8);
        EXPECT_NEAR(lifted.second, across / (kBefore + kAfter), 1e-7);
        EXPECT_NEAR(touched.second, across / kAfter, 1e-7);
        EXPECT_NEAR(touched.second - lifted.second, across * kBefore / (kAfter * (kBefore + kAfter)), 1e-7);
    }
}

/** Both branches go on smoothly past the change while the contact set is kept, and meet at it with one slope. */
TEST(ContactChange, KeptContactSetsMeetWithOneSlopeAtTheChange) {
    const auto surface = std::make_shared<Sphere>(kRadius);
    const TangentScene before(surface, -0.1), after(surface, 0.1), at(surface, 0);
    const double across = std::pow(std::sin(kSlope), 2);
    PathSolver solver;
    PathSolution lifted = before.solve(false), touched = after.solve(true);
    solver.solveKeepingContacts(at.problem, at.pose, lifted);
    solver.solveKeepingContacts(at.problem, at.pose, touched);
    ASSERT_FALSE(lifted.contacts[1].isTouched);
    ASSERT_TRUE(touched.contacts[1].isTouched);
    EXPECT_NEAR(touched.contacts[1].start.length, 0, 1e-10);
    const Derivatives one = calcDerivatives(at, lifted), other = calcDerivatives(at, touched);
    EXPECT_NEAR(one.length, other.length, 1e-12);
    EXPECT_NEAR(one.first, other.first, 1e-10);
    EXPECT_NEAR(other.second - one.second, across * kBefore / (kAfter * (kBefore + kAfter)), 1e-9);
}

}  // namespace
}  // namespace tautline::testing
