/** Degenerate scenes: an answer, finite, whatever it is. */
#include "tautline/paths/path_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/path_scene.h"
#include "support/random.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/elliptic_cylinder.h"

namespace tautline::testing {
namespace {

TEST(PathSolverDegenerate, EveryShapeFromEveryAwkwardPlace) {
    const std::shared_ptr<const Surface> surfaces[] = {std::make_shared<Sphere>(0.5), std::make_shared<Cylinder>(0.5),
                                                       std::make_shared<Ellipsoid>(Vec3(0.5, 1, 2)),
                                                       std::make_shared<Torus>(1, 0.25)};
    struct Line {
        const char* name;
        Vec3 O, I;
    };
    const Line lines[] = {{"through the centre", {-3, 0, 0}, {3, 0, 0}},
                          {"along the axis", {0, 0, -3}, {0, 0, 3}},
                          {"both at the centre", {0, 0, 0}, {0, 0, 0}},
                          {"coincident outside", {3, 0, 0}, {3, 0, 0}},
                          {"tangent", {-3, 0.5, 0}, {3, 0.5, 0}},
                          {"ending on the surface", {-3, 0, 0}, {-0.5, 0, 0}},
                          {"from centre to surface", {0, 0, 0}, {0.5, 0, 0}}};
    for (const auto& surface : surfaces)
        for (const Line& line : lines)
            for (const std::optional<Vec3>& hint :
                 {std::optional<Vec3>(), std::optional<Vec3>(Vec3(0, 1, 0)), std::optional<Vec3>(Vec3(0, 0, 0))}) {
                SCOPED_TRACE(surface->getDescription() + " " + line.name + (hint ? " with hint" : ""));
                PathScene scene;
                scene.point(line.O).obstacle(surface, Pose(), hint).point(line.I);
                expectDrawable(scene, scene.solve());
            }
}

// Symptom (2026-11-25): not_converged, "still slides", since the string lay in a plane of symmetry and stayed there.
TEST(PathSolverDegenerate, ChordsThroughAxesAndCentresAreSolvedInBothForms) {
    const std::shared_ptr<const Surface> surfaces[] = {std::make_shared<Sphere>(0.4),
                                                       std::make_shared<ParametricSphere>(0.4),
                                                       std::make_shared<Cylinder>(0.4),
                                                       std::make_shared<ParametricCylinder>(0.4),
                                                       std::make_shared<EllipticCylinder>(0.4, 0.3),
                                                       std::make_shared<ParametricEllipticCylinder>(0.4, 0.3),
                                                       std::make_shared<Capsule>(0.4, 1.0, 0.3),
                                                       std::make_shared<ParametricCapsule>(0.4, 1.0, 0.3),
                                                       std::make_shared<Ellipsoid>(Vec3(0.4, 0.3, 0.2)),
                                                       std::make_shared<ParametricEllipsoid>(Vec3(0.4, 0.3, 0.2))};
    for (const auto& surface : surfaces)
        for (const double a : {0.6, 1.0, 8.0})
            for (const double slant : {0.0, 0.5, -0.1})
                for (const bool alongY : {false, true}) {
                    const Vec3 side = alongY ? Vec3(0, a, slant) : Vec3(a, 0, slant);
                    SCOPED_TRACE(surface->getDescription() + " " + std::to_string(a) + " " + std::to_string(slant));
                    PathScene scene;
                    scene.point(-side).obstacle(surface, Pose()).point(1.25 * side);
                    const PathSolution path = scene.solve();
                    EXPECT_EQ(path.status, PathStatus::Solved);
                    EXPECT_TRUE(path.contacts[1].isTouched);
                    EXPECT_GT(path.length, 2.25 * side.norm());
                }
}

TEST(PathSolverDegenerate, EllipsoidsAsThinAsOneToTwentyAreSolvedFromAnywhere) {
    Random random(12);
    for (int i = 0; i < 40; ++i)
        for (const bool isBroadside : {true, false}) {
            const Vec3 ahead = isBroadside ? Vec3(0, 0, 2) : Vec3(2, 0, 0), spread(0.3, 0.3, isBroadside ? 0.3 : 0.015);
            PathScene scene;
            scene.point(ahead + random.vector(1).cwiseProduct(spread));
            scene.obstacle(std::make_shared<Ellipsoid>(Vec3(1, 0.8, 0.05)), Pose());
            scene.point(random.vector(1).cwiseProduct(spread) - ahead);
            EXPECT_EQ(scene.solve().status, PathStatus::Solved) << i << isBroadside;
        }
}

// Symptom (2026-11-22): segments of length 0 with e = 0 where both ends lie on the surface itself.
TEST(PathSolverDegenerate, EndsOnTheSurfaceLeaveUnitDirections) {
    PathScene scene;
    scene.point(Vec3(-0.5, 0, 0)).obstacle(std::make_shared<Sphere>(0.5), Pose()).point(Vec3(0.5, 0, 0));
    expectDrawable(scene, scene.solve());
}

// Symptom (2026-11-22): not_converged or not_minimum where a muscle's origin lies exactly on its wrap surface.
TEST(PathSolverDegenerate, PathFromAPointOnTheSurfaceLeavesItAlongAGeodesic) {
    // Half around the cylinder, and a quarter and a bit to a tangent line; heights of 1e-7 radii change 1e-10 of
    // length.
    PathScene around;
    around.point(Vec3(-0.5, 0, 0)).obstacle(std::make_shared<Cylinder>(0.5), Pose(), Vec3(0, 0.5, 0));
    around.point(Vec3(0.5, 0, 0));
    const PathSolution half = around.solve();
    EXPECT_EQ(half.status, PathStatus::Solved);
    EXPECT_NEAR(half.length, kPi / 2, 1e-9);
    for (const std::optional<Vec3>& hint : {std::optional<Vec3>(), std::optional<Vec3>(Vec3(0, 0.5, 0))}) {
        PathScene away;
        away.point(Vec3(-0.5, 0, 0)).obstacle(std::make_shared<Cylinder>(0.5), Pose(), hint).point(Vec3(3, 0.3, 0));
        const PathSolution path = away.solve();
        const double distance = std::hypot(3, 0.3);
        const double turn = kPi - std::atan2(0.3, 3) - std::acos(0.5 / distance);
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_NEAR(path.length, 0.5 * turn + std::sqrt(distance * distance - 0.25), 1e-9);
    }
}

TEST(PathSolverDegenerate, LineAlongTheAxisOfATorusRunsThroughItsHole) {
    PathScene scene;
    scene.point(Vec3(0, 0, -3)).obstacle(std::make_shared<Torus>(1, 0.25), Pose()).point(Vec3(0, 0, 3));
    const PathSolution path = scene.solve();
    EXPECT_EQ(path.status, PathStatus::Solved);
    EXPECT_EQ(path.length, 6);
}

TEST(PathSolverDegenerate, LineThatJustTouchesHasItsOwnLength) {
    for (double y : {0.5, 0.5 - 1e-12, 0.5 + 1e-12, 0.5 - 1e-9}) {
        PathScene scene;
        scene.point(Vec3(-1, y, 0))
            .obstacle(std::make_shared<Sphere>(0.5), Pose(), Vec3(0, 0.5, 0))
            .point(Vec3(2, y, 0));
        const PathSolution path = scene.solve();
        EXPECT_EQ(path.status, PathStatus::Solved) << y;
        EXPECT_NEAR(path.length, 3, 1e-14) << y;  // a dip of 1e-9 lengthens by its square
    }
}

}  // namespace
}  // namespace tautline::testing
