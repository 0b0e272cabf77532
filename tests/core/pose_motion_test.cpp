// SPDX-License-Identifier: Apache-2.0
/** Screws, and the way of elements from one pose to another. */
#include "paths/tracking/pose_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace tautline::testing {
namespace {

SpatialVelocity multiply(double factor, const SpatialVelocity& V) {
    return {factor * V.w, factor * V.v};
}

double calcDifference(const Pose& A, const Pose& B) {
    return (A.R - B.R).norm() + (A.p - B.p).norm();
}

// What makes a map the exponential: it is a one-parameter group, and begins as the displacement says.
TEST(Screw, IsAGroupThatBeginsAsTheDisplacementSays) {
    Random random(3);
    for (const double size : {1e-7, 5e-5, 2e-4, 0.1, 1.0, 6.0}) {
        const SpatialVelocity V{random.vector(size), random.vector(1)};
        const Pose whole = calcScrew(V);
        EXPECT_LT(calcDifference(calcScrew(multiply(0.3, V)) * calcScrew(multiply(0.7, V)), whole), 1e-14) << size;
        constexpr double h = 1e-5;
        const Pose ahead = calcScrew(multiply(h, V)), back = calcScrew(multiply(-h, V));
        EXPECT_LT(((ahead.p - back.p) / (2 * h) - V.v).norm(), 1e-8);
        const Matrix3 W = (ahead.R - back.R) / (2 * h);
        EXPECT_LT((Vector3(W(2, 1), W(0, 2), W(1, 0)) - V.w).norm(), 1e-8);
    }
}

TEST(Screw, IsFoundFromItsPoseUpToHalfATurn) {
    Random random(4);
    for (const double angle : {0.0, 1e-9, 1e-4, 0.5, 3.0, kPi - 1e-7}) {
        const SpatialVelocity V{angle * random.vector(1).normalized(), random.vector(1)};
        const SpatialVelocity found = calcScrewDisplacement(calcScrew(V));
        EXPECT_LT((found.w - V.w).norm() + (found.v - V.v).norm(), 1e-8) << angle;
    }
    const Pose half(Eigen::AngleAxisd(kPi, Vector3(1, 2, 3).normalized()).toRotationMatrix(), Vector3(4, 5, 6));
    EXPECT_LT(calcDifference(calcScrew(calcScrewDisplacement(half)), half), 1e-12);
}

/** A body that turns about an axis at rest by `turn`, with what is foretold of it. */
struct TurningBody {
    Vector3 axis_G = Vector3(1, -2, 0.5).normalized(), center_G = Vector3(0.3, 0.1, -0.2);
    Pose X_0{Eigen::AngleAxisd(0.7, Vector3(0, 1, 1).normalized()).toRotationMatrix(), Vector3(1, 0.4, 0.2)};

    Pose calcPose(double turn) const {
        const Matrix3 R = Eigen::AngleAxisd(turn, axis_G).toRotationMatrix();
        return {R * X_0.R, center_G + R * (X_0.p - center_G)};
    }
    SpatialVelocity calcVelocity(double speed) const {
        return {speed * axis_G, speed * axis_G.cross(X_0.p - center_G)};
    }
};

TEST(PoseMotion, KeepsToTheCircleWithTheTurnsNearestToThoseForetold) {
    const TurningBody body;
    PathPose from, to, between;
    from.X_GE = {body.calcPose(0)};
    for (const double turn : {0.2, 3.0, kPi, 6.0, 2 * kPi, 20.0, -9.0})
        for (const double surprise : {0.0, 0.4, -3.0}) {
            to.X_GE = {body.calcPose(turn)};
            PoseMotion way;
            way.set(from, {body.calcVelocity((turn - surprise) / 0.5)}, 0.5, to);
            for (const double share : {0.0, 0.1, 0.5, 0.99, 1.0}) {
                way.calcPose(share, between);
                EXPECT_LT(calcDifference(between.X_GE[0], body.calcPose(share * turn)), 1e-12) << turn << " " << share;
            }
        }
}

TEST(PoseMotion, IsTheShortestScrewWhereNothingIsForetold) {
    const TurningBody body;
    PathPose from, to, between;
    from.X_GE = {body.calcPose(0)};
    to.X_GE = {body.calcPose(4)};
    PoseMotion way;
    way.set(from, {}, 1, to);
    way.calcPose(0.5, between);
    EXPECT_LT(calcDifference(between.X_GE[0], body.calcPose(0.5 * (4 - 2 * kPi))), 1e-12);
}

TEST(PoseMotion, BoundsTheTurnOfTwoElements) {
    const TurningBody body;
    PathPose from, to;
    from.X_GE = {body.calcPose(0), Pose()};
    to.X_GE = {body.calcPose(9), Pose()};
    PoseMotion way;
    way.set(from, {body.calcVelocity(8), {}}, 1, to);
    EXPECT_NEAR(way.calcTurnBound(0, 1), 9, 1e-12);
    EXPECT_NEAR(way.calcTurnBound(1, 0), 9, 1e-12);
}

}  // namespace
}  // namespace tautline::testing
