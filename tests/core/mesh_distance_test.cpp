// SPDX-License-Identifier: Apache-2.0
#include "tautline/meshes/mesh_distance.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/triangle_meshes.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr unsigned kSeed = 20261127;

/** The cube [-1, 1]^3. */
TriangleMesh makeCube() {
    TriangleMesh cube;
    for (int i = 0; i < 8; ++i) cube.points.push_back({i & 1 ? 1.0 : -1, i & 2 ? 1.0 : -1, i & 4 ? 1.0 : -1});
    for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        cube.triangles.push_back({a, b, c});
        cube.triangles.push_back({a, c, d});
    }
    return cube;
}

/** Distance to the cube in closed form. */
double calcCubeDistance(const Vector3& p) {
    const Vector3 beyond = p.cwiseAbs() - Vector3::Ones();
    return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

TEST(MeshDistance, OfACubeIsItsClosedForm) {
    const MeshDistance distance(makeCube());
    EXPECT_DOUBLE_EQ(calcVolume(distance.getMesh()), 8);
    EXPECT_DOUBLE_EQ(calcArea(distance.getMesh()), 24);
    testing::Random random(kSeed);
    for (int i = 0; i < 2000; ++i) {
        const Vector3 p = random.vector(2);
        EXPECT_NEAR(distance.calcSignedDistance(p), calcCubeDistance(p), 1e-14) << p.transpose();
    }
}

TEST(MeshDistance, IsThatOfTheNearestOfAllTriangles) {
    const TriangleMesh mesh = testing::makeTorusMesh(0.3, 0.1, 12);
    const MeshDistance all(mesh);
    std::vector<MeshDistance> single;
    for (const auto& triangle : mesh.triangles) single.emplace_back(TriangleMesh{mesh.points, {triangle}});
    testing::Random random(kSeed);
    for (int i = 0; i < 100; ++i) {
        const Vector3 p = random.vector(0.6);
        double least = kInfinity;
        for (const MeshDistance& one : single) least = std::min(least, one.findNearest(p).distance);
        const MeshDistance::Nearest nearest = all.findNearest(p);
        EXPECT_DOUBLE_EQ(nearest.distance, least);
        EXPECT_DOUBLE_EQ((nearest.point - p).norm(), least);
        EXPECT_EQ(all.findNearest(p, 0.99 * least).triangle, -1);
        EXPECT_DOUBLE_EQ(all.findNearest(p, 1.01 * least).distance, least);
    }
}

TEST(MeshDistance, WindingNumberCountsThePartsAroundAPoint) {
    const TriangleMesh ball = testing::makeBallMesh(3);
    const MeshDistance two(testing::joinMeshes(ball, testing::scaleMesh(ball, Vector3::Ones(), Vector3(1, 0, 0))));
    testing::Random random(kSeed);
    for (int i = 0; i < 1000; ++i) {
        const Vector3 p = random.vector(2.5);
        const double first = p.norm(), second = (p - Vector3(1, 0, 0)).norm();
        if (std::abs(first - 1) < 0.02 || std::abs(second - 1) < 0.02) continue;  // between facets and ball
        EXPECT_NEAR(two.calcWindingNumber(p), (first < 1) + (second < 1), 0.02) << p.transpose();
    }
}

TEST(MeshDistance, WindingNumberDoesNotLeakThroughAHole) {
    TriangleMesh ball = testing::makeBallMesh(3);
    const auto isCap = [&](const std::array<int, 3>& triangle) {
        return ball.points[static_cast<std::size_t>(triangle[0])].z() > 0.9;
    };
    ball.triangles.erase(std::remove_if(ball.triangles.begin(), ball.triangles.end(), isCap), ball.triangles.end());
    const MeshDistance open(ball);
    for (const double z : {-1.2, -1.05}) EXPECT_LT(open.calcWindingNumber({0, 0, z}), 0.1);
    for (const double z : {-0.95, 0.0, 0.5, 0.7}) EXPECT_GT(open.calcWindingNumber({0, 0, z}), 0.5);
    for (const double z : {1.1, 2.0}) EXPECT_LT(open.calcWindingNumber({0, 0, z}), 0.5);
}

TEST(MeshDistance, PointsThatAreNoneHaveNoNearestOne) {
    const MeshDistance distance(makeCube());
    EXPECT_EQ(distance.findNearest(Vector3::Constant(kNaN)).triangle, -1);
    EXPECT_FALSE(distance.isInside(Vector3::Constant(kNaN)));
    EXPECT_FALSE(distance.isInside(Vector3::Constant(1e300)));
}

TEST(MeshDistance, RefusesMeshesThatAreNone) {
    const auto expectRefusal = [](const TriangleMesh& mesh, const std::string& message) {
        try {
            MeshDistance distance(mesh);
            ADD_FAILURE() << "not refused: " << message;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.what(), message);
        }
    };
    TriangleMesh mesh = makeCube();
    mesh.triangles.clear();
    expectRefusal(mesh, "mesh: has no triangles");
    mesh = makeCube();
    mesh.points[3].y() = kNaN;
    expectRefusal(mesh, "mesh: points must be finite, but point 3 is (  1 nan  -1)");
    mesh = makeCube();
    mesh.triangles[5][1] = 8;
    expectRefusal(mesh, "mesh: triangle 5 has a corner at point 8, but there are 8 points");
}

}  // namespace
}  // namespace tautline
