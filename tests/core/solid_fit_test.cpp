// SPDX-License-Identifier: Apache-2.0
/** Solids fitted to meshes of known shapes approach these as the meshes get finer, and faults of meshes do not matter.
 */
#include "tautline/surfaces/solid_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.h"
#include "support/triangle_meshes.h"
#include "tautline/error.h"
#include "tautline/meshes/mesh_distance.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline {
namespace {

constexpr unsigned kSeed = 20261127;

/** A string from one point to another, over an obstacle in ground that it passes near `near`. */
PathSolution solveOver(std::shared_ptr<const Surface> surface, const Vector3& from, const Vector3& to,
                       const Vector3& near) {
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("obstacle", std::move(surface), PassNear{near});
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(from), Pose(), Pose(to)};
    return solvePath(problem, pose);
}

/** A shape at three resolutions, each of half the edges of the one before, with the width in proportion to them. */
struct Refinement {
    std::string name;
    std::shared_ptr<const Surface> exact;
    std::vector<TriangleMesh> meshes;
    double coarsestWidth;
    Vector3 from, to, near;
};

std::vector<Refinement> makeRefinements() {
    const Vector3 axes(0.05, 0.03, 0.08);
    Refinement sphere{"sphere",    std::make_shared<Sphere>(0.05), {}, 0.008, {-0.1, 0.01, 0}, {0.09, 0, 0.03},
                      {0, 0.05, 0}};
    Refinement ellipsoid{
        "ellipsoid", std::make_shared<Ellipsoid>(axes), {}, 0.006, {-0.1, 0, 0.02}, {0.09, 0.01, -0.03}, {0, 0.03, 0}};
    Refinement torus{
        "torus", std::make_shared<Torus>(0.1, 0.03), {}, 0.006, {0.1, -0.02, 0.06}, {0.12, 0.03, -0.07}, {0.13, 0, 0}};
    for (const int level : {0, 1, 2}) {
        sphere.meshes.push_back(testing::scaleMesh(testing::makeBallMesh(2 + level), Vector3::Constant(0.05)));
        ellipsoid.meshes.push_back(testing::scaleMesh(testing::makeBallMesh(2 + level), axes));
        torus.meshes.push_back(testing::makeTorusMesh(0.1, 0.03, 12 << level));
    }
    return {sphere, ellipsoid, torus};
}

/** The kernel has no negative weights, so what it misses is of second order in its width, as are the facets' sagittas
in their edges: a quarter is left at each step. */
TEST(SolidFit, LengthsOverFinerMeshesConvergeWithTheSquareOfTheWidth) {
    for (const Refinement& shape : makeRefinements()) {
        const PathSolution exact = solveOver(shape.exact, shape.from, shape.to, shape.near);
        ASSERT_EQ(exact.status, PathStatus::Solved) << shape.name;
        ASSERT_GT(exact.contacts[1].start.length, 0.02) << shape.name;
        std::vector<double> errors;
        double width = shape.coarsestWidth;
        for (const TriangleMesh& mesh : shape.meshes) {
            SolidFitOptions options;
            options.width = width;
            const auto solid = std::make_shared<BSplineSolid>(fitSolid(mesh, options).solid);
            const PathSolution path = solveOver(solid, shape.from, shape.to, shape.near);
            EXPECT_EQ(path.status, PathStatus::Solved) << shape.name << ", width " << width;
            errors.push_back(exact.length - path.length);
            width /= 2;
        }
        EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.25) << shape.name << " " << errors[0] << " " << errors[1];
        EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.25) << shape.name << " " << errors[1] << " " << errors[2];
        EXPECT_LT(std::abs(errors[2]), 2e-3 * exact.length) << shape.name;
    }
}

/** To first order a ball's distance r - R becomes r - R + w^2 / r under a kernel of variance w^2 along each axis. */
TEST(SolidFit, ABallShrinksByTheSquareOfTheWidthOverItsRadius) {
    const double radius = 0.05, width = 0.005;
    SolidFitOptions options;
    options.width = width;
    for (const double spacing : {width / 1.7, width, 1.6 * width}) {
        options.spacing = spacing;
        const SolidFit fit = fitSolid(testing::scaleMesh(testing::makeBallMesh(4), Vector3::Constant(radius)), options);
        testing::Random random(kSeed);
        for (int i = 0; i < 100; ++i) {
            const Vector3 foot = fit.solid.findSurfacePoint(0.06 * random.unitVector()).p;
            EXPECT_NEAR(radius - foot.norm(), width * width / radius, 0.15 * width * width / radius) << spacing;
        }
        EXPECT_NEAR(fit.report.rms, width * width / radius, 0.2 * width * width / radius);
    }
}

TEST(SolidFit, AConvexMeshGivesAConvexSolid) {
    TriangleMesh octahedron;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {0.04, -0.04}) octahedron.points.push_back(side * Vector3::Unit(axis));
    octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    SolidFitOptions options;
    options.width = 0.004;
    const BSplineSolid solid = fitSolid(octahedron, options).solid;
    testing::Random random(kSeed);
    double sharpest = 0;
    for (int i = 0; i < 2000; ++i) {
        const SurfacePoint point = solid.findSurfacePoint(0.05 * random.unitVector());
        const DarbouxFrame frame = solid.calcFrame(point, random.unitVector());
        // A distance in floats, and a lattice that samples its ridges: of the order of 1e-3 of the sharpest curvature.
        EXPECT_LT(frame.kappaN, 0.5);
        sharpest = std::min(sharpest, frame.kappaN);
    }
    EXPECT_LT(sharpest, -100);  // at the corners, which are as round as the width
}

TEST(SolidFit, HolesDoubleFacesAndOverlapsDoNotShow) {
    const TriangleMesh sound = testing::makeBoneMesh();
    const SolidFit whole = fitSolid(sound);
    TriangleMesh faulty = sound;
    testing::Random random(kSeed);
    for (int i = 0; i < 8; ++i) {
        const auto at = random.integer(0, faulty.countTriangles() - 1);
        faulty.triangles.erase(faulty.triangles.begin() + at);
    }
    for (std::size_t i = 0; i < 50; ++i) {
        const auto triangle = faulty.triangles[7 * i];
        faulty.triangles.push_back(triangle);
        std::swap(faulty.triangles[5 * i + 1][0], faulty.triangles[5 * i + 1][1]);
    }
    // A ball wholly inside, its faces inward: it must be no cavity.
    TriangleMesh inner = testing::scaleMesh(testing::makeBallMesh(2), Vector3::Constant(0.004));
    for (auto& triangle : inner.triangles) std::swap(triangle[0], triangle[1]);
    faulty = testing::joinMeshes(faulty, inner);
    SolidFitOptions options;
    options.width = whole.solid.getGrid().width;
    const SolidFit fit = fitSolid(faulty, options);
    EXPECT_EQ(fit.repaired.closedHoles, 8);
    EXPECT_EQ(fit.repaired.doubleTriangles, 50);
    EXPECT_EQ(fit.repaired.parts, 2);
    EXPECT_LT(fit.solid.calcHeight(Vector3::Zero()), -0.5 * options.width);  // within the ball inside
    for (const Vector3& point : whole.points) {
        const Vector3 foot = whole.solid.findSurfacePoint(point).p;
        EXPECT_NEAR(fit.solid.calcHeight(foot), 0, 0.3 * options.width);
    }
}

TEST(SolidFit, ResidualsAreTakenOnTheOutsideOnly) {
    const TriangleMesh ball = testing::scaleMesh(testing::makeBallMesh(3), Vector3::Constant(0.05));
    const TriangleMesh two = testing::joinMeshes(ball, testing::scaleMesh(ball, Vector3::Ones(), Vector3(0.03, 0, 0)));
    SolidFitOptions options;
    options.width = 0.002;
    const SolidFit fit = fitSolid(two, options);
    for (const Vector3& point : fit.points) {
        EXPECT_GT(point.norm(), 0.0495 - 1e-3);
        EXPECT_GT((point - Vector3(0.03, 0, 0)).norm(), 0.0495 - 1e-3);
    }
    ASSERT_EQ(fit.points.size(), fit.report.residuals.size());
    const Vector3& worst = fit.points[static_cast<std::size_t>(fit.report.worst)];
    EXPECT_NEAR(worst.x(), 0.015, 0.005);  // in the groove, which smoothing fills
    EXPECT_GT(fit.report.largest, 2 * fit.report.rms);
}

TEST(SolidFit, RefusesWidthsAndSpacingsOutOfProportion) {
    const TriangleMesh ball = testing::scaleMesh(testing::makeBallMesh(2), Vector3::Constant(0.05));
    const auto expectRefusal = [&](double width, double spacing, const std::string& message) {
        SolidFitOptions options;
        options.width = width, options.spacing = spacing;
        try {
            fitSolid(ball, options);
            ADD_FAILURE() << "not refused: " << message;
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
    };
    expectRefusal(-0.001, 0, "solid fit: width must be positive and finite, but is -0.001");
    expectRefusal(kNaN, 0, "solid fit: width must be positive and finite, but is nan");
    expectRefusal(0.001, 0.01, "solid fit: a spacing must lie between width / 1.8 and 1.7 width, but it is 0.01");
    expectRefusal(0.01, 0.001, "solid fit: a spacing must lie between width / 1.8 and 1.7 width");
    expectRefusal(1e-6, 0, "bricks are more than 134217728: choose a wider spacing");
}

}  // namespace
}  // namespace tautline
