// SPDX-License-Identifier: Apache-2.0
/** Newton's method and the contact set, and the promises of the solver. */
#include "tautline/paths/path_solver.h"

#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "support/path_scene.h"
#include "support/planar_chain.h"
#include "support/weave_scene.h"

namespace tautline::testing {
namespace {

TEST(PathSolver, ConvergesQuadratically) {
    int pairs = 0;
    for (WeaveScene::Kind kind : {WeaveScene::Kind::Cylinders, WeaveScene::Kind::Ellipsoids}) {
        const WeaveScene weave(kind, 5);
        PathSolver solver;
        PathPose pose;
        PathSolution path;
        for (double t = 0; t < 8; t += 0.4) {
            weave.calcPose(t, pose);
            solver.solve(weave.getProblem(), pose, path);
            ASSERT_EQ(path.status, PathStatus::Solved);
            const std::vector<double>& error = path.errorHistory;
            EXPECT_EQ(error.back(), path.pathError);
            // From 1e-7 on the square is rounding.
            for (std::size_t i = 0; i + 1 < error.size(); ++i) {
                if (error[i] > 0.03 || error[i] < 1e-7) continue;
                // The constant is the scene's: curvature over straight length, at most 25 or so here.
                EXPECT_LT(error[i + 1], 40 * error[i] * error[i] + 1e-13) << i;
                ++pairs;
            }
        }
    }
    EXPECT_GT(pairs, 40);
}

TEST(PathSolver, KeptContactStaysSmoothPastLiftOff) {
    // A cylinder sinks away below the line y = 0; the closed form holds on with arcs below zero.
    const double r = 0.4;
    PathScene scene;
    scene.point(Vector3(-1, 0, 0)).obstacle(std::make_shared<Cylinder>(r), Pose(Vector3(0, -0.3, 0)), Vector3(0, r, 0));
    scene.point(Vector3(1.5, 0, 0));
    PathSolver solver;
    PathSolution path = scene.solve();
    ASSERT_TRUE(path.contacts[1].isTouched);
    for (double top : {0.1, 0.03, 1e-3, 1e-6, 0.0, -1e-6, -1e-3, -0.01, -0.03}) {
        scene.pose.X_GE[1].p.y() = top - r;
        solver.solveKeepingContacts(scene.problem, scene.pose, path);
        EXPECT_EQ(path.status, PathStatus::Solved) << top;
        const std::vector<PlanarStop> stops = {{Vector2(-1, 0)}, {Vector2(0, top - r), r, -1}, {Vector2(1.5, 0)}};
        EXPECT_NEAR(path.length, calcPlanarLength(stops, false), 1e-13) << top;
        EXPECT_EQ(path.contacts[1].start.length < -1e-12, top < -1e-9) << top;
    }
    solver.solve(scene.problem, scene.pose, path);  // and lifts when it may
    EXPECT_FALSE(path.contacts[1].isTouched);
    EXPECT_NEAR(path.length, 2.5, 1e-15);
}

TEST(PathSolver, SwitchedOffElementIsPassedOver) {
    PathScene scene;
    scene.point(Vector3(0, 0, 0))
        .point(Vector3(1, 1, 0))
        .obstacle(std::make_shared<Sphere>(0.2), Pose(Vector3(1.5, 0.1, 0)));
    scene.point(Vector3(2, 0, 0));
    const double withAll = scene.solve().length;
    scene.pose.isActive = {1, 0, 1, 1};
    const PathSolution withoutPoint = scene.solve();
    EXPECT_EQ(withoutPoint.status, PathStatus::Solved);
    EXPECT_NEAR(withoutPoint.length, calcPlanarLength({{Vector2(0, 0)}, {Vector2(1.5, -0.1), 0.2, 1}, {Vector2(2, 0)}}),
                0.5);
    EXPECT_LT(withoutPoint.length, withAll);
    scene.pose.isActive = {1, 0, 0, 1};
    EXPECT_NEAR(scene.solve().length, 2, 1e-15);
}

TEST(PathSolver, AnswersDoNotDependOnWhatWasSolvedBefore) {
    const PathScene chain = makePlanarChain();
    const WeaveScene weave(WeaveScene::Kind::Ellipsoids, 7);
    PathPose pose;
    weave.calcPose(0.3, pose);
    PathSolver used;
    PathSolution other, path;
    used.solve(weave.getProblem(), pose, other);
    used.solve(chain.problem, chain.pose, path);
    const PathSolution fresh = chain.solve();
    EXPECT_EQ(path.length, fresh.length);
    EXPECT_EQ(path.errorHistory, fresh.errorHistory);
    for (int e = 1; e < 5; ++e) EXPECT_EQ(path.contacts[e].start.length, fresh.contacts[e].start.length);
}

TEST(PathSolver, WarmEqualsCold) {
    for (WeaveScene::Kind kind : {WeaveScene::Kind::Cylinders, WeaveScene::Kind::Ellipsoids}) {
        const WeaveScene weave(kind, 6);
        PathPose pose;
        PathSolver solver;
        PathSolution warm;
        for (double t : {0.0, 0.02, 0.1, 0.5, 3.0}) {
            weave.calcPose(t, pose);
            solver.solve(weave.getProblem(), pose, warm);
            const PathSolution cold = solvePath(weave.getProblem(), pose);
            EXPECT_NEAR(warm.length, cold.length, 1e-12 * cold.length);
            for (std::size_t i = 0; i < warm.segments.size(); ++i)
                EXPECT_LT((warm.segments[i].e - cold.segments[i].e).norm(), 1e-10);
        }
    }
}

PathScene makeArcOver(std::shared_ptr<const Surface> surface) {
    PathScene scene;
    scene.point({-2, 0.3, 0.2}).obstacle(std::move(surface), Pose()).point({2, 0.2, -0.1});
    return scene;
}

const std::vector<std::shared_ptr<const Surface>> kArcSurfaces = {
    std::make_shared<Ellipsoid>(Vector3(1, 2, 1.2)), std::make_shared<Cylinder>(1), std::make_shared<Sphere>(1),
    std::make_shared<ParametricEllipsoid>(Vector3(1, 2, 1.2))};

TEST(PathSolver, ArcsThatAreKnownAreNotShotAgain) {
    for (const auto& surface : kArcSurfaces) {
        PathScene scene = makeArcOver(surface);
        PathSolver solver;
        PathSolution path;
        solver.solve(scene.problem, scene.pose, path);
        ASSERT_TRUE(path.contacts[1].isTouched);
        const double length = path.length;
        solver.solve(scene.problem, scene.pose, path);
        EXPECT_EQ(path.shots, 0) << surface->getDescription();
        EXPECT_EQ(path.length, length);
        scene.pose.X_GE[0].p.y() += 0.02;
        PathSolver().solve(scene.problem, scene.pose, path);
        EXPECT_GT(path.iterations, 1);
        EXPECT_EQ(path.shots, path.iterations) << surface->getDescription();
        EXPECT_NEAR(path.length, scene.solve().length, 1e-14);
    }
}

TEST(PathSolver, ArcsOfAnotherSurfaceOrAccuracyAreShotAgain) {
    PathSolution path = makeArcOver(std::make_shared<Ellipsoid>(Vector3(1, 2, 1.2))).solve();
    // A copy is the same surface, another one of the same shape is not.
    const Ellipsoid original(Vector3(1, 2, 1.2)), copy = original, twin(Vector3(1, 2, 1.2));
    EXPECT_EQ(copy.getId(), original.getId());
    EXPECT_NE(twin.getId(), original.getId());
    const PathScene thin = makeArcOver(std::make_shared<Ellipsoid>(Vector3(0.9, 2, 1.1)));
    PathSolver solver;
    solver.solve(thin.problem, thin.pose, path);
    EXPECT_GT(path.shots, 0);
    EXPECT_NEAR(path.length, thin.solve().length, 1e-14);
    PathSolverOptions rough;
    rough.geodesics.accuracy = 1e-6;
    path = thin.solve(rough);
    solver.solve(thin.problem, thin.pose, path);
    EXPECT_GT(path.shots, 0);
    EXPECT_NEAR(path.length, thin.solve().length, 1e-14);
}

TEST(PathSolver, WarmSolveDoesNotAllocate) {
    for (WeaveScene::Kind kind : {WeaveScene::Kind::Cylinders, WeaveScene::Kind::Ellipsoids}) {
        const WeaveScene weave(kind, 10);
        PathPose pose;
        PathSolver solver;
        PathSolution path;
        weave.calcPose(0, pose);
        solver.solve(weave.getProblem(), pose, path);
        weave.calcPose(0.5, pose);  // a large step: more iterations than any that follows
        solver.solve(weave.getProblem(), pose, path);
        weave.calcPose(0.52, pose);
        const long before = allocationCount;
        solver.solve(weave.getProblem(), pose, path);
        EXPECT_EQ(allocationCount - before, 0);
        EXPECT_GT(path.iterations, 0);
        EXPECT_FALSE(path.wasCold);
    }
    PathScene ring;  // that is touched in two places
    ring.point(Vector3(-0.3, 0.02, 0.01))
        .obstacle(std::make_shared<Torus>(0.1, 0.03), Pose())
        .point(Vector3(0.3, 0.01, 0.01));
    PathSolver solver;
    PathSolution path;
    for (int i = 0; i < 6; ++i) {
        ring.pose.X_GE[0].p.y() += 1e-3;
        const long before = allocationCount;
        solver.solve(ring.problem, ring.pose, path);
        solver.solveKeepingContacts(ring.problem, ring.pose, path);
        EXPECT_TRUE(i < 3 || allocationCount == before) << i;
        EXPECT_EQ(path.contacts[1].getNumArcs(), 2);
    }
    const long before = allocationCount;
    const std::vector<int> numbers(static_cast<std::size_t>(before % 7 + 100));  // of a size unknown when compiled
    EXPECT_GT(allocationCount, before) << numbers.data();                        // the counter counts
}

}  // namespace
}  // namespace tautline::testing
