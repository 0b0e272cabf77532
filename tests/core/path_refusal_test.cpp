// SPDX-License-Identifier: Apache-2.0
/** Input that is refused, with the name, the value and the limit. */
#include "tautline/paths/path_solver.h"

#include <gtest/gtest.h>

#include "support/path_scene.h"
#include "tautline/error.h"

namespace tautline::testing {
namespace {

template <class Action>
void expectRefused(const std::string& part, const Action& action) {
    try {
        action();
        ADD_FAILURE() << "accepted: " << part;
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(PathSolverRefuses, OptionsOutOfRangeWithNameAndValue) {
    const auto refuse = [](const std::string& part, auto change) {
        PathSolverOptions options;
        change(options);
        expectRefused(part, [&] { PathSolver solver(options); });
    };
    using Options = PathSolverOptions;
    refuse("pathErrorTolerance must be in (0, 0.1], but is 0", [](Options& o) { o.pathErrorTolerance = 0; });
    refuse("pathErrorTolerance must be in (0, 0.1], but is 0.5", [](Options& o) { o.pathErrorTolerance = 0.5; });
    refuse("pathErrorTolerance", [](Options& o) { o.pathErrorTolerance = kNaN; });
    refuse("maxIterations must be at least 1, but is 0", [](Options& o) { o.maxIterations = 0; });
    refuse("geodesic accuracy must be in (0, 0.1], but is -1", [](Options& o) { o.geodesics.accuracy = -1; });
    refuse("geodesic maxSteps must be at least 1, but is -3", [](Options& o) { o.geodesics.maxSteps = -3; });
}

TEST(PathSolverRefuses, ProblemsThatAreNoPath) {
    const auto sphere = std::make_shared<Sphere>(1);
    expectRefused("'ghost' has no surface", [] { PathProblem().addObstacle("ghost", nullptr); });
    expectRefused("must be finite", [&] { PathProblem().addObstacle("s", sphere, Vector3(0, kNaN, 0)); });
    expectRefused("is a point and takes no hint", [] {
        PathProblem problem;
        problem.addPoint("o");
        problem.setHint(0, Vector3::UnitX());
    });
    expectRefused("no element 7", [] { PathProblem().setHint(7, std::nullopt); });
    expectRefused("needs an origin and an insertion", [] { PathProblem().validate(); });
    expectRefused("ends with obstacle 's'", [&] {
        PathProblem problem;
        problem.addPoint("o");
        problem.addObstacle("s", sphere);
        problem.validate();
    });
    expectRefused("begins with obstacle 's'", [&] {
        PathProblem problem;
        problem.addObstacle("s", sphere);
        problem.addPoint("i");
        problem.validate();
    });
    expectRefused("2 poses for 3 elements", [&] {
        PathScene scene;
        scene.point(Vector3(0, 0, 0)).obstacle(sphere, Pose()).point(Vector3(3, 0, 0));
        scene.pose.X_GE.pop_back();
        scene.solve();
    });
    expectRefused("isActive has 1 entries for 3 elements", [&] {
        PathScene scene;
        scene.point(Vector3(0, 0, 0)).obstacle(sphere, Pose()).point(Vector3(3, 0, 0));
        scene.pose.isActive = {1};
        scene.solve();
    });
    expectRefused("needs a path that was solved before", [&] {
        PathScene scene;
        scene.point(Vector3(0, 0, 0)).point(Vector3(3, 0, 0));
        PathSolution empty;
        PathSolver().solveKeepingContacts(scene.problem, scene.pose, empty);
    });
}

TEST(PathSolverRefuses, ShapesWithBadDimensions) {
    expectRefused("sphere: radius must be positive and finite, but is -1", [] { Sphere(-1); });
    expectRefused("cylinder: radius", [] { Cylinder{kNaN}; });
    expectRefused("ellipsoid: semi-axis y", [] { Ellipsoid(Vector3(1, 0, 1)); });
    expectRefused("tube radius 2 must be less than the ring radius 1", [] { Torus(1, 2); });
}

}  // namespace
}  // namespace tautline::testing
