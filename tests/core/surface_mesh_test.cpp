// SPDX-License-Identifier: Apache-2.0
/** The numbered properties of calcSurfaceMesh(), on every surface of the project. */
#include "tautline/surfaces/surface_mesh.h"

#include <gtest/gtest.h>

#include <map>

#include "support/surface_cases.h"

namespace tautline::testing {
namespace {

Vector3 calcMiddle(const SurfaceMesh& mesh, const std::array<int, 4>& face) {
    Vector3 sum = Vector3::Zero();
    for (const int i : face) sum += mesh.points[i];
    return sum / 4;
}

/** Half the cross product of the diagonals: the facet's area along its normal. */
Vector3 calcAreaVector(const SurfaceMesh& mesh, const std::array<int, 4>& face) {
    const auto& p = mesh.points;
    return 0.5 * (p[face[2]] - p[face[0]]).cross(p[face[3]] - p[face[1]]);
}

double calcArea(const SurfaceMesh& mesh) {
    double area = 0;
    for (const auto& face : mesh.faces) area += calcAreaVector(mesh, face).norm();
    return area;
}

/** How often each edge is passed from its first to its second point. */
std::map<std::pair<int, int>, int> countEdges(const SurfaceMesh& mesh) {
    std::map<std::pair<int, int>, int> counts;
    for (const auto& face : mesh.faces)
        for (int i = 0; i < 4; ++i) ++counts[{face[i], face[(i + 1) % 4]}];
    return counts;
}

/** Points at which a facet ends without a neighbor. */
std::vector<int> findRim(const SurfaceMesh& mesh) {
    std::vector<int> rim;
    const auto counts = countEdges(mesh);
    for (const auto& [edge, count] : counts)
        if (counts.count({edge.second, edge.first}) == 0) rim.push_back(edge.first);
    return rim;
}

/** From a point to the nearest of 5 x 5 points of each facet. */
double calcDistance(const SurfaceMesh& mesh, const Vector3& p) {
    double least = kInfinity;
    for (const auto& face : mesh.faces)
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; j <= 4; ++j) {
                const double a = 0.25 * i, b = 0.25 * j;
                const Vector3 low = (1 - a) * mesh.points[face[0]] + a * mesh.points[face[1]];
                const Vector3 high = (1 - a) * mesh.points[face[3]] + a * mesh.points[face[2]];
                least = std::min(least, ((1 - b) * low + b * high - p).norm());
            }
    return least;
}

bool endsSomewhere(const std::string& name) {
    for (const char* part : {"Cylinder", "Paraboloid", "HalfSpace", "Cone", "Patch", "Sheet", "Shell"})
        if (name.find(part) != std::string::npos) return true;
    return false;
}

class SurfaceMeshTest : public ::testing::TestWithParam<SurfaceCase> {
protected:
    double getSize() const { return GetParam().surface->getSize(); }
    SurfaceMesh calcMesh() const { return calcSurfaceMesh(*GetParam().surface, 3 * getSize()); }
};

TEST_P(SurfaceMeshTest, PointsLieOnTheSurfaceAndInItsDomain) {
    const Surface& surface = *GetParam().surface;
    const SurfaceMesh mesh = calcMesh();
    EXPECT_GT(mesh.faces.size(), 50u);
    for (const Vector3& p : mesh.points) {
        EXPECT_LT(std::abs(surface.calcHeight(p)), 1e-10 * surface.getSize());
        EXPECT_TRUE(surface.isInDomain(surface.findSurfacePoint(p))) << p.transpose();
    }
}

TEST_P(SurfaceMeshTest, SurfacesWithoutAnEndAreClosed) {
    const SurfaceMesh mesh = calcMesh();
    const auto edges = countEdges(mesh);
    for (const auto& [edge, count] : edges) {
        // Where a crest grazes a face of the lattice so that all four of its edges are cut, the facets on both sides of
        // the crest meet in one edge: passed twice, and twice the other way.
        const auto back = edges.find({edge.second, edge.first});
        const bool isCrest = count == 2 && back != edges.end() && back->second == 2;
        EXPECT_TRUE(count == 1 || isCrest) << edge.first << " " << edge.second << ": " << count;
    }
    EXPECT_EQ(findRim(mesh).empty(), !endsSomewhere(GetParam().name));
}

TEST_P(SurfaceMeshTest, FacetsFaceOutward) {
    const SurfaceMesh mesh = calcMesh();
    for (const auto& face : mesh.faces) {
        const Surface& surface = *GetParam().surface;
        // Not the ascent of the height: a middle may be just beside the domain, where that leads aside.
        const Vector3 N = surface.calcFrame(surface.findSurfacePoint(calcMiddle(mesh, face)), Vector3::UnitX()).N;
        EXPECT_GT(calcAreaVector(mesh, face).normalized().dot(N), 0.3) << calcMiddle(mesh, face).transpose();
    }
}

TEST_P(SurfaceMeshTest, FacetsCoverTheSurface) {
    const Surface& surface = *GetParam().surface;
    const SurfaceMesh mesh = calcMesh();
    double width = 0;
    for (const auto& face : mesh.faces) width = std::max(width, std::sqrt(calcAreaVector(mesh, face).norm()));
    const auto samples = makeSamples(surface, GetParam().extent, GetParam().center, 1, {}, 30, 20260411u);
    int numCovered = 0;
    for (const SurfaceLawSample& sample : samples) {
        const SurfacePoint point = surface.findSurfacePoint(sample.p_S);
        if (!surface.isInDomain(point) || !mesh.box.contains(point.p)) continue;
        ++numCovered;
        EXPECT_LT(calcDistance(mesh, point.p), 0.3 * width) << point.p.transpose();
    }
    EXPECT_GT(numCovered, 3);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceMeshTest, ::testing::ValuesIn(makeSurfaceCases()),
                         [](const auto& one) { return one.param.name; });

/** Chords lose h^2/6r^2 of the area at most: h = r/6. */
TEST(SurfaceMesh, AreaAndGenusOfClosedShapes) {
    const auto countEuler = [](const SurfaceMesh& mesh) {
        return static_cast<int>(mesh.points.size()) - static_cast<int>(countEdges(mesh).size()) / 2 +
               static_cast<int>(mesh.faces.size());
    };
    const SurfaceMesh sphere = calcSurfaceMesh(Sphere(0.4), 1), torus = calcSurfaceMesh(Torus(3, 1), 1);
    EXPECT_FALSE(sphere.isCut || torus.isCut);
    EXPECT_EQ(countEuler(sphere), 2);
    EXPECT_EQ(countEuler(torus), 0);
    EXPECT_NEAR(calcArea(sphere) / (4 * kPi * 0.16), 1, 0.02);
    EXPECT_NEAR(calcArea(torus) / (4 * kPi * kPi * 3), 1, 0.02);
}

TEST(SurfaceMesh, SurfacesWithoutEndReachAsFarAsAsked) {
    const SurfaceMesh plane = calcSurfaceMesh(HalfSpace(0.2), 1.2);
    EXPECT_TRUE(plane.isCut);
    EXPECT_NEAR(calcArea(plane), 2.8 * 2.8, 1e-12);  // 1.2 beyond what is met from points 0.2 from the origin
    const SurfaceMesh longer = calcSurfaceMesh(HalfSpace(0.2), 1.2, {Vector3(5, 0, 0.3)});
    EXPECT_NEAR(calcArea(longer), (1.4 + 6.2) * 2.8, 0.1);
    EXPECT_TRUE(longer.box.contains(Vector3(5, 0, 0.3)));
    for (const auto& shape : {std::shared_ptr<const Surface>(std::make_shared<EllipticCylinder>(0.3, 0.1)),
                              std::shared_ptr<const Surface>(std::make_shared<Paraboloid>(14, 6))}) {
        const double size = shape->getSize();
        Eigen::AlignedBox3d drawn;
        const SurfaceMesh mesh = calcSurfaceMesh(*shape, 5 * size);
        EXPECT_TRUE(mesh.isCut);
        for (const Vector3& p : mesh.points) drawn.extend(p);
        EXPECT_GE(drawn.max().z(), 5 * size) << shape->getDescription();
        EXPECT_NEAR(drawn.max().z(), mesh.box.max().z(), 0.2 * size) << shape->getDescription();
        EXPECT_NEAR(drawn.min().x(), -drawn.max().x(), 0.2 * size) << shape->getDescription();
    }
}

/** The rim of a patch is its domain's edge, and its area the integral of |xu x xv|. */
TEST(SurfaceMesh, PatchesEndAtTheirEdges) {
    for (const BSplinePatch& patch : {makeBumpPatch(11), makeShellPatch()}) {
        const SurfaceMesh mesh = calcSurfaceMesh(patch, 1);
        EXPECT_FALSE(mesh.isCut);
        for (const int i : findRim(mesh))
            EXPECT_NEAR(patch.calcDomainMargin(patch.findSurfacePoint(mesh.points[i])), 0, 1e-9);
        double area = 0;
        const ParameterDomain domain = patch.getDomain();
        const Vector2 width = domain.max - domain.min;
        for (int i = 0; i < 100; ++i)
            for (int j = 0; j < 100; ++j) {
                const Vector2 uv = domain.min + Vector2(0.01 * i + 0.005, 0.01 * j + 0.005).cwiseProduct(width);
                const ParametricValue s = patch.calcParametric(uv, 0);
                area += 1e-4 * width[0] * width[1] * s.xu.cross(s.xv).norm();
            }
        EXPECT_NEAR(calcArea(mesh) / area, 1, 0.03);
    }
}

/** Spheres away from the origin of S; the second is met only from a point beside it. */
TEST(SurfaceMesh, SurfacesAwayFromTheOriginAreFound) {
    const ImplicitFunctionSurface spheres = makeImplicitSurface("two spheres", 0.5, [](auto x, auto y, auto z) {
        const auto a = (x - 5) * (x - 5) + y * y + z * z, b = (x - 9) * (x - 9) + y * y + z * z;
        return (a - 0.25) * (b - 0.25) / 16;
    });
    const double area = 4 * kPi * 0.25;
    EXPECT_NEAR(calcArea(calcSurfaceMesh(spheres, 1)) / area, 1, 0.02);
    EXPECT_NEAR(calcArea(calcSurfaceMesh(spheres, 1, {Vector3(9.4, 0.2, 0)})) / area, 2, 0.04);
}

/** Patches in places of a body's frame far from its origin, where only their continuations are near it. */
TEST(SurfaceMesh, PatchesAwayFromTheOriginAreFound) {
    for (const Vector2& corner : {Vector2(10, 12), Vector2(-40, 0.5), Vector2(0.2, -7)}) {
        const int n = 7;
        Eigen::MatrixXd heights(n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) heights(i, j) = 3 + calcBumps(-1 + 2.0 * i / (n - 1), -1 + 2.0 * j / (n - 1));
        const BSplinePatch patch = BSplinePatch::interpolateHeights({corner, corner + Vector2::Constant(2)}, heights);
        const SurfaceMesh mesh = calcSurfaceMesh(patch, 1);
        EXPECT_NEAR(calcArea(mesh) / calcArea(calcSurfaceMesh(makeBumpPatch(n), 1)), 1, 0.01) << corner.transpose();
    }
}

TEST(SurfaceMesh, FacetsAreWiderWhereThereWouldBeTooMany) {
    const SurfaceMesh disc = calcSurfaceMesh(ParametricEllipsoid(Vector3(1, 1, 0.05)), 0.1);
    EXPECT_LT(disc.faces.size(), 25000u);
    EXPECT_TRUE(findRim(disc).empty());
    EXPECT_NEAR(calcArea(disc) / (2 * kPi), 1, 0.05);
    EXPECT_FALSE(disc.isCut);
}

}  // namespace
}  // namespace tautline::testing
