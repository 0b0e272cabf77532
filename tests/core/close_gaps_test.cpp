// SPDX-License-Identifier: Apache-2.0
/** Gaps between bodies are filled to where a ball of their width comes to rest, and nothing else is. */
#include "tautline/meshes/close_gaps.h"

#include <gtest/gtest.h>

#include <map>

#include "support/triangle_meshes.h"
#include "tautline/error.h"
#include "tautline/meshes/mesh_distance.h"

namespace tautline {
namespace {

/** Two balls of radius 1 with their middles at x = -c and c. */
TriangleMesh makeTwoBalls(double c) {
    const TriangleMesh ball = testing::makeBallMesh(3);
    TriangleMesh both;
    for (const double side : {-1.0, 1.0}) {
        const int first = static_cast<int>(both.points.size());
        for (const Vector3& p : ball.points) both.points.push_back(p + side * c * Vector3::UnitX());
        for (const auto& corners : ball.triangles)
            both.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
    }
    return both;
}

// A ball of radius r that rests on both has its middle at rho from the axis: c^2 + rho^2 = (1 + r)^2.
TEST(CloseGaps, NeckBetweenTwoBallsIsThatOfTheBallThatRestsOnBoth) {
    constexpr double c = 1.15, r = 0.25;
    const double neck = std::sqrt((1 + r) * (1 + r) - c * c) - r;
    const MeshDistance closed(closeGaps(makeTwoBalls(c), 2 * r, 0.06));
    for (const double angle : {0.0, 0.7, 2.0, 4.0}) {
        const Vector3 outward(0, std::cos(angle), std::sin(angle));
        EXPECT_NEAR(closed.calcSignedDistance(neck * outward), 0, 0.02) << angle;
        EXPECT_LT(closed.calcSignedDistance(0.8 * neck * outward), 0) << angle;
    }
    // The far sides are as they were, up to what facets and lattice leave.
    EXPECT_NEAR(closed.calcSignedDistance(Vector3(c + 1, 0, 0)), 0, 0.02);
    EXPECT_NEAR(closed.calcSignedDistance(Vector3(-c, 0, 1)), 0, 0.02);
}

TEST(CloseGaps, WiderGapsStayOpen) {
    const MeshDistance closed(closeGaps(makeTwoBalls(1.3), 0.2, 0.05));
    EXPECT_NEAR(closed.calcSignedDistance(Vector3::Zero()), 0.3, 0.02);
    EXPECT_LT(closed.calcSignedDistance(Vector3(1.3, 0, 0)), 0);
}

TEST(CloseGaps, MeshIsClosedAndFacesOutward) {
    const TriangleMesh balls = makeTwoBalls(1.15), mesh = closeGaps(balls, 0.5, 0.1);
    std::map<std::pair<int, int>, int> edges;
    for (const auto& corners : mesh.triangles)
        for (int k = 0; k < 3; ++k) ++edges[{corners[k], corners[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_NEAR(calcVolume(mesh) / calcVolume(balls), 1, 0.02);  // with a small neck
}

TEST(CloseGaps, RefusesLatticesThatDoNotFit) {
    const auto findRefusal = [](double gap, double spacing) -> std::string {
        try {
            closeGaps(testing::makeBallMesh(1), gap, spacing);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(findRefusal(0, 0).find("positive and finite width"), std::string::npos) << findRefusal(0, 0);
    EXPECT_NE(findRefusal(0.1, 0.05).find("no coarser than 0.025"), std::string::npos) << findRefusal(0.1, 0.05);
    EXPECT_NE(findRefusal(0.1, 1e-3).find("choose a wider spacing"), std::string::npos) << findRefusal(0.1, 1e-3);
}

}  // namespace
}  // namespace tautline
