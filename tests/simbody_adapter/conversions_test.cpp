// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/conversions.h"

#include <gtest/gtest.h>

namespace tautline::testing {
namespace {

TEST(Conversions, VectorsComeBackBitForBit) {
    const SimTK::Vec3 v(1.1, -2.3, 3.7e-200);
    EXPECT_EQ(toSimTK(toEigen(v)), v);
    EXPECT_EQ(toEigen(v).z(), 3.7e-200);
}

TEST(Conversions, MatricesKeepRowsAndColumns) {
    const SimTK::Mat33 m(1, 2, 3, 4, 5, 6, 7, 8, 9);
    EXPECT_EQ(toEigen(m)(0, 2), 3);
    EXPECT_EQ(toEigen(m)(2, 0), 7);
    EXPECT_EQ(toSimTK(toEigen(m)), m);
}

TEST(Conversions, PosesMapPointsAlikeAndComeBack) {
    const SimTK::Rotation R(SimTK::BodyRotationSequence, 0.3, SimTK::XAxis, -1.1, SimTK::YAxis, 2.0, SimTK::ZAxis);
    const SimTK::Transform X(R, SimTK::Vec3(1, 2, 3));
    const SimTK::Vec3 p(0.4, -0.5, 0.6);
    EXPECT_LT((toSimTK(toPose(X) * toEigen(p)) - X * p).norm(), 1e-15);
    EXPECT_LT((toSimTK(toPose(X).shiftBack(toEigen(p))) - ~X * p).norm(), 1e-15);
    EXPECT_EQ(toTransform(toPose(X)).R().asMat33(), X.R().asMat33());
    EXPECT_EQ(toTransform(toPose(X)).p(), X.p());
}

TEST(Conversions, SpatialVectorsPutAnglesFirst) {
    const SimTK::SpatialVec V(SimTK::Vec3(1, 2, 3), SimTK::Vec3(4, 5, 6));
    EXPECT_EQ(toSpatialVelocity(V).w, Vector3(1, 2, 3));
    EXPECT_EQ(toSpatialVelocity(V).v, Vector3(4, 5, 6));
    EXPECT_EQ(toSpatialForce(V).moment, Vector3(1, 2, 3));
    EXPECT_EQ(toSpatialForce(V).force, Vector3(4, 5, 6));
    EXPECT_EQ(toSpatialVec(toSpatialVelocity(V)), V);
    EXPECT_EQ(toSpatialVec(toSpatialForce(V)), V);
}

}  // namespace
}  // namespace tautline::testing
