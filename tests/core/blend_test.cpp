// SPDX-License-Identifier: Apache-2.0
/** The smooth union of several bodies: its function and derivatives, and strings in and over its grooves. */
#include "tautline/surfaces/blend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/path_scene.h"
#include "support/seeded_random.h"
#include "support/taut_polyline.h"
#include "tautline/error.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/half_space.h"

namespace tautline::testing {
namespace {

Pose turned(double angle, const Vector3& axis, const Vector3& p) {
    return {Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), p};
}

std::shared_ptr<const Blend> makeThreeBodies(double radius) {
    return std::make_shared<Blend>(
        std::vector<BlendPart>{
            {std::make_shared<Sphere>(0.5), Pose(Vector3(-0.4, 0.1, 0))},
            {std::make_shared<Ellipsoid>(Vector3(0.6, 0.3, 0.4)), turned(0.4, Vector3(1, 2, 3), Vector3(0.3, 0, 0.1))},
            {std::make_shared<Cylinder>(0.2), turned(1.1, Vector3(1, 0, 0), Vector3(0, 0.3, 0.2))}},
        radius);
}

TEST(Blend, HasTheDerivativesOfItsDifferences) {
    constexpr unsigned kSeed = 5;
    SCOPED_TRACE(kSeed);
    SeededRandom random(kSeed);
    const auto blend = makeThreeBodies(0.1);
    constexpr double h = 1e-5;
    for (int i = 0; i < 300; ++i) {
        const Vector3 p = random.vector(1.2);
        const ImplicitValue at = blend->calcImplicit(p);
        if (at.f < -0.1) continue;  // near the medial axes
        for (int k = 0; k < 3; ++k) {
            const ImplicitValue ahead = blend->calcImplicit(p + h * Vector3::Unit(k));
            const ImplicitValue back = blend->calcImplicit(p - h * Vector3::Unit(k));
            EXPECT_NEAR(at.gradient[k], (ahead.f - back.f) / (2 * h), 1e-8);
            // Where the third derivatives jump, by 2/k^2 times a gradient's cube, differences are off by h as much.
            EXPECT_LT((at.hessian.col(k) - (ahead.gradient - back.gradient) / (2 * h)).norm(), 2 * h);
        }
    }
}

// In the band the function is that of the nearest part, but for what another one adds; outside it is that part's.
TEST(Blend, IsTheNearestPartWhereNoOtherIsNear) {
    const auto blend = makeThreeBodies(0.02);
    const double k = 2 * std::sqrt(2) * 0.02;
    SeededRandom random(6);
    int numAlone = 0, numBlended = 0;
    for (int i = 0; i < 500; ++i) {
        const Vector3 p = random.vector(1.2);
        std::vector<double> distances;
        for (const BlendPart& part : blend->getParts()) {
            const Body body{part.surface.get(), part.X_SP};
            const double height = body.calcHeight(p);
            distances.push_back(std::copysign((p - body.findNearestPoint(p)).norm(), height));
        }
        std::sort(distances.begin(), distances.end());
        const double f = blend->calcImplicit(p).f;
        if (distances[0] < 0) continue;
        if (distances[1] - distances[0] > 1.01 * k) {
            EXPECT_NEAR(f, distances[0], 1e-5);
            ++numAlone;
        } else {
            EXPECT_LE(f, distances[0] + 1e-5);
            EXPECT_GE(f, distances[0] - k / 3);
            ++numBlended;
        }
    }
    EXPECT_GT(numAlone, 100);
    EXPECT_GT(numBlended, 10);
}

TEST(Blend, OfPlanesAtRightAnglesHasItsRadiusInTheMiddle) {
    constexpr double r = 0.3;
    // Outward are x + z and -x + z, turned planes through the y axis.
    const auto plane = std::make_shared<HalfSpace>(1.0);
    const Blend blend({{plane, turned(kPi / 4, Vector3::UnitY(), Vector3::Zero())},
                       {plane, turned(-kPi / 4, Vector3::UnitY(), Vector3::Zero())}},
                      r);
    const SurfacePoint bottom = blend.findSurfacePoint(Vector3(0, 0.2, 0.1));
    const DarbouxFrame frame = blend.calcFrame(bottom, Vector3::UnitX());
    EXPECT_NEAR(bottom.p.z(), 2 * std::sqrt(2) * r / 6 * std::sqrt(2), 1e-14);
    EXPECT_NEAR(frame.kappaN, 1 / r, 1e-12);  // hollow
    EXPECT_NEAR(frame.kappaB, 0, 1e-12);
}

// From cylinder to cylinder the string bridges the groove: two circles and the line between their tops.
TEST(Blend, IsBridgedFromBodyToBody) {
    constexpr double r = 0.3, d = 0.35;
    for (const double radius : {0.02, 0.1}) {
        SCOPED_TRACE(radius);
        const auto cylinder = std::make_shared<Cylinder>(r);
        PathScene scene;
        scene.point(Vector3(-1.5, 0.1, -0.3));
        scene.obstacle(std::make_shared<Blend>(std::vector<BlendPart>{{cylinder, Pose(Vector3(-d, 0, 0))},
                                                                      {cylinder, Pose(Vector3(d, 0, 0))}},
                                               radius),
                       Pose());
        scene.point(Vector3(1.4, 0.05, 0.5));
        const PathSolution path = scene.solve();
        ASSERT_EQ(path.status, PathStatus::Solved) << explainStatus(scene.problem, scene.pose, path);
        ASSERT_EQ(path.contacts[1].getNumArcs(), 2);
        const auto calcSide = [&](double along, double height) {
            const double distance = std::hypot(along, height), tangent = std::sqrt(distance * distance - r * r);
            return tangent + r * (kPi / 2 - std::atan2(height, along) - std::acos(r / distance));
        };
        // Cylinders unroll: along their axes the string only rises.
        const double section = calcSide(1.5 - d, 0.1) + 2 * d + calcSide(1.4 - d, 0.05);
        EXPECT_NEAR(path.length, std::hypot(section, 0.8), 1e-10);
    }
}

// Where two spheres overlap a string lies in the groove with a kink (path_search_test.cpp); over their blend it is
// smooth.
TEST(Blend, HoldsAStringInItsGroove) {
    for (const double depth : {0.03, 0.04, 0.06, 0.08}) {
        SCOPED_TRACE(depth);
        const auto sphere = std::make_shared<Sphere>(0.025);
        PathScene scene;
        scene.point(Vector3(0.03, 0.2, 0));
        scene.obstacle(std::make_shared<Blend>(std::vector<BlendPart>{{sphere, Pose(Vector3(0, 0, 0.018))},
                                                                      {sphere, Pose(Vector3(0, 0, -0.018))}},
                                               0.005),
                       Pose(), Vector3(0.025, 0, 0));
        scene.point(Vector3(0.03 - depth, -0.2, 0));
        const PathSolution path = scene.solve();
        ASSERT_EQ(path.status, PathStatus::Solved) << explainStatus(scene.problem, scene.pose, path);
        EXPECT_TRUE(path.contacts[1].isTouched);
        EXPECT_LT(std::abs(path.contacts[1].geodesic.P.x.z()), 1e-9);  // in the plane between the spheres
        std::vector<Vector3> course;
        calcDrawingPoints(path, scene.problem, scene.pose, 0.1, course);
        TautPolyline polyline({{scene.problem.getElement(1).surface.get(), Pose()}}, course, 400);
        ASSERT_TRUE(polyline.relax(1e-8, 20000));
        EXPECT_NEAR(path.length, polyline.calcLength(), 1e-5 * path.length);
    }
}

TEST(Blend, RefusesWhatIsNoBlend) {
    const auto sphere = std::make_shared<Sphere>(1);
    const auto refusal = [](const std::vector<BlendPart>& parts, double radius) -> std::string {
        try {
            Blend blend(parts, radius);
        } catch (const InvalidInput& e) {
            return e.what();
        }
        return "taken";
    };
    EXPECT_NE(refusal({}, 0.1).find("at least one part"), std::string::npos);
    EXPECT_NE(refusal({{nullptr, Pose()}}, 0.1).find("part 0 has no surface"), std::string::npos);
    EXPECT_NE(refusal({{sphere, Pose()}}, 0).find("radius must be positive"), std::string::npos);
    EXPECT_NE(refusal({{sphere, Pose()}}, kNaN).find("radius must be positive"), std::string::npos);
    EXPECT_NE(refusal({{sphere, Pose(Vector3(kNaN, 0, 0))}}, 0.1).find("pose of part 0"), std::string::npos);
    EXPECT_NE(
        refusal({{sphere, Pose()}, {sphere, Pose(-Matrix3::Identity(), Vector3::Zero())}}, 0.1).find("part 1 is none"),
        std::string::npos);
    EXPECT_EQ(makeBlend({sphere, std::make_shared<Sphere>(2)}, 0.1)->getSize(), 1);
}

}  // namespace
}  // namespace tautline::testing
