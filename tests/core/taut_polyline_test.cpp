// SPDX-License-Identifier: Apache-2.0
/** The truths of the tests' own, against each other and against what is known without any of them. */
#include "support/taut_polyline.h"

#include <gtest/gtest.h>

#include "support/asked_scenes.h"
#include "support/random.h"
#include "support/string_about_axis.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline {
namespace {

using testing::AskedScene;
using testing::AskedSceneMaker;
using testing::TautString;

/** Beyond the tangent lines from both ends, a string over a sphere lies on the great circle. */
double calcLengthOverSphere(double radius, const Vector3& A, const Vector3& B) {
    const double angle = std::acos(A.normalized().dot(B.normalized()));
    const double arc = angle - std::acos(radius / A.norm()) - std::acos(radius / B.norm());
    if (arc < 0) return (B - A).norm();
    return std::sqrt(A.squaredNorm() - radius * radius) + radius * arc + std::sqrt(B.squaredNorm() - radius * radius);
}

TEST(TautPolyline, FallsOverASphereOntoTheGreatCircle) {
    testing::Random random(1);
    const Sphere sphere(1);
    for (int i = 0; i < 40; ++i) {
        const Vector3 A = random.uniform(1.05, 4) * random.unitVector(),
                      B = random.uniform(1.05, 4) * random.unitVector();
        const TautString string =
            testing::findTautString(sphere, testing::makeCourseOver(A, B, random.unitVector(), 1.5));
        ASSERT_TRUE(string.isSmooth()) << i;
        EXPECT_NEAR(string.length, calcLengthOverSphere(1, A, B), 1e-9) << i;
    }
}

TEST(TautPolyline, AgreesWithTheHelixAboutACylinder) {
    testing::Random random(2);
    const Cylinder cylinder(0.5);
    for (int i = 0; i < 20; ++i) {
        const Vector3 A =
            testing::makeOnCylinder(random.uniform(0.55, 3), random.uniform(-kPi, kPi), random.uniform(-1, 1));
        const Vector3 B =
            testing::makeOnCylinder(random.uniform(0.55, 3), random.uniform(-kPi, kPi), random.uniform(-1, 1));
        for (const auto& way : testing::calcBothWays(0.5, A, B)) {
            const TautString string =
                testing::findTautString(cylinder, testing::makeCourseAboutAxis(A, B, way.turning, 1));
            ASSERT_TRUE(string.isSmooth()) << i;
            EXPECT_NEAR(string.length, way.length, 1e-9) << i;
            const Vector2 direction = string.middle.head<2>().normalized(),
                          expected = way.middle.head<2>().normalized();
            EXPECT_LT((direction - expected).norm(), way.isTouching ? 1e-8 : 0.03) << i;  // straight ones are sampled
            EXPECT_NEAR(testing::calcTurning(string.nodes), way.turning, 1e-9);
        }
    }
}

// The rows of the inputs that went wrong: by hand.
TEST(StringAboutAxis, WrapsOnTheSideAlsoWhereTheStraightLineIsClearOnTheOther) {
    const auto first = testing::findStringOnSide(1, Vector3(1, 2, 0), Vector3(-4, 0, 0), Vector3::UnitX());
    ASSERT_TRUE(first);
    EXPECT_NEAR(first->length, 7.69645993, 5e-9);
    const auto second = testing::findStringOnSide(1, Vector3(-1, 3, 0), Vector3(-3, -1, 0), Vector3::UnitX());
    ASSERT_TRUE(second);
    EXPECT_NEAR(second->length, 8.21429744, 5e-9);
    const auto clear = testing::findStringOnSide(1, Vector3(-3, 1.5, 0), Vector3(3, 1.5, 0), Vector3::UnitY());
    ASSERT_TRUE(clear);
    EXPECT_DOUBLE_EQ(clear->length, 6);
}

// Two spheres that overlap: the string lies in the groove, where one arc on each is not the answer.
TEST(TautPolyline, FallsIntoTheGrooveBetweenTwoSpheres) {
    const Sphere sphere(0.025);
    const Vector3 A(0.02, 0.2, 0.001), B(-0.1, -0.2, -0.001);
    testing::TautPolyline string({{&sphere, Pose(Vector3(0, 0, 0.018))}, {&sphere, Pose(Vector3(0, 0, -0.018))}},
                                 {A, Vector3(0.05, 0, 0), B}, 400);
    ASSERT_TRUE(string.relax(1e-7, 20000));
    EXPECT_NEAR(string.calcLength(), 0.432346, 2e-6);
}

}  // namespace
}  // namespace tautline
