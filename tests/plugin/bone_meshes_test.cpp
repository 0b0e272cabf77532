// SPDX-License-Identifier: Apache-2.0
/** Bone meshes: where they are looked for, what is read, and how they are thinned. */
#include "bone_meshes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "mesh_thinning.h"
#include "program_support.h"
#include "support/shared_data.h"
#include "tautline/models/osim_reader.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/surface_mesh.h"

namespace tautline::testing {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "x";
}

TEST(BoneMeshes, AreLookedForAsOpenSimDoes) {
    const fs::path folder = makeFolder("meshes"), model = folder / "model/m.osim";
    const fs::path home = folder / "home";
    ::setenv("OPENSIM_HOME", home.c_str(), 1);
    const std::vector<fs::path> given{folder / "first", folder / "last"};
    // From the least of places to the best.
    for (const fs::path& place :
         {home / "Geometry", folder / "first", folder / "last", folder / "model/Geometry", folder / "model"}) {
        touch(place / "a.vtp");
        EXPECT_EQ(findMeshFile("a.vtp", model, given).value_or(""), place / "a.vtp");
    }
    touch(folder / "model/Geometry/sub/b.obj");
    EXPECT_EQ(findMeshFile("sub/b.obj", model, given).value_or(""), folder / "model/Geometry/sub/b.obj");
    EXPECT_EQ(findMeshFile((folder / "first/a.vtp").string(), model, {}).value_or(""), folder / "first/a.vtp");
    EXPECT_FALSE(findMeshFile("/a.vtp", model, given));
    EXPECT_FALSE(findMeshFile("sub", folder / "model/Geometry/m.osim", given));  // a folder
    ::unsetenv("OPENSIM_HOME");
}

/** A model with meshes at the ground. */
models::ModelDescription makeModel(const fs::path& folder, std::initializer_list<const char*> files) {
    models::ModelDescription model;
    model.fileName = (folder / "m.osim").string();
    for (const char* file : files) model.meshes.push_back({file, models::kGroundName, {}, Vector3(1, 1, 2), 0});
    return model;
}

struct Ground {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    models::BuiltModel bodies = models::BuiltModel::ofBodies(matter, {});
};

TEST(BoneMeshes, OfAllThreeKindsAreReadAndScaled) {
    const fs::path folder = makeFolder("mesh_kinds");
    fs::create_directories(folder);
    std::ofstream(folder / "square.obj") << "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n";
    std::ofstream(folder / "triangle.stl") << "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\n"
                                              "vertex 0 1 1\nendloop\nendfacet\nendsolid t\n";
    std::ofstream(folder / "triangle.vtp")
        << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
           "NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 1 1 "
           "0 "
           "1 0 1 1</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 "
           "2</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>"
           "</PolyData></VTKFile>\n";
    Ground ground;
    const Bones bones = loadBones(makeModel(folder, {"square.obj", "triangle.stl", "triangle.vtp"}), ground.bodies, {});
    EXPECT_TRUE(bones.notes.empty());
    ASSERT_EQ(bones.meshes.size(), 3u);
    EXPECT_EQ(bones.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(bones.meshes[1].triangles.size(), 1u);
    for (const ReportPage::Mesh& mesh : bones.meshes)
        for (const Vector3& point : mesh.points_M) EXPECT_EQ(point.z(), 2);
}

TEST(BoneMeshes, MissingAndBrokenOnesAreNamedOnce) {
    const fs::path folder = makeFolder("broken_meshes");
    touch(folder / "broken.vtp");
    touch(folder / "odd.xyz");
    Ground ground;
    const Bones bones =
        loadBones(makeModel(folder, {"broken.vtp", "none.vtp", "odd.xyz", "none.vtp"}), ground.bodies, {});
    EXPECT_TRUE(bones.meshes.empty());
    ASSERT_EQ(bones.notes.size(), 3u);
    EXPECT_EQ(bones.notes[0].rfind("a mesh is not drawn: " + (folder / "broken.vtp").string() + ":1: ", 0), 0u)
        << bones.notes[0];
    EXPECT_EQ(bones.notes[2],
              "1 of 3 bone meshes are not found and not drawn (--geometry FOLDER says where they are): none.vtp");
}

/** Of a sphere of radius 1: the closed surface is a law that thinning has to keep. */
ReportPage::Mesh makeBall() {
    const SurfaceMesh facets = calcSurfaceMesh(Sphere(1), 0.5);
    ReportPage::Mesh mesh{0, {}, facets.points, {}};
    for (const auto& [a, b, c, d] : facets.faces) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    }
    return mesh;
}

double calcVolume(const ReportPage::Mesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += mesh.points_M[static_cast<std::size_t>(a)].dot(
                      mesh.points_M[static_cast<std::size_t>(b)].cross(mesh.points_M[static_cast<std::size_t>(c)])) /
                  6;
    return volume;
}

TEST(MeshThinning, KeepsABallClosedAndItsPointsWithinACell) {
    const ReportPage::Mesh ball = makeBall();
    const double cell = 0.3;
    const ReportPage::Mesh thinned = clusterPoints(ball, cell);
    EXPECT_LT(thinned.points_M.size(), ball.points_M.size() / 2);
    EXPECT_NEAR(calcVolume(thinned), calcVolume(ball), 0.1 * calcVolume(ball));
    for (const Vector3& point : thinned.points_M) EXPECT_NEAR(point.norm(), 1, cell * std::sqrt(3.0));
    // Each edge is met once in either direction.
    std::multiset<std::pair<int, int>> edges;
    for (const auto& corners : thinned.triangles)
        for (std::size_t i = 0; i < 3; ++i) edges.insert({corners[i], corners[(i + 1) % 3]});
    for (const auto& [from, to] : edges) EXPECT_EQ(edges.count({from, to}), edges.count({to, from}));
}

TEST(MeshThinning, StopsAtTheFirstWidthThatIsEnough) {
    std::vector<ReportPage::Mesh> meshes{makeBall(), makeBall()};
    const std::size_t most = meshes[0].points_M.size();
    EXPECT_EQ(thinMeshes(meshes, 2 * most), 0);
    const double cell = thinMeshes(meshes, most);
    EXPECT_GT(cell, 0);
    const std::size_t left = meshes[0].points_M.size() + meshes[1].points_M.size();
    EXPECT_LE(left, most);
    EXPECT_GT(left, most / 3);
}

TEST(DataBoneMeshes, OfArm26StandWhereTheirMusclesAre) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const fs::path data = shared / "data/opensim";
    const models::ModelDescription model = models::readOsimFile(data / "models/arm26.osim");
    EXPECT_EQ(model.meshes.size(), 36u);
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter(system);
    const models::BuiltModel bodies = models::buildMultibody(model, matter);
    const Bones bones = loadBones(model, bodies, {data / "geometry"});
    // The humerus is 0.3 m long, along -y of its body.
    Eigen::AlignedBox3d humerus;
    for (const ReportPage::Mesh& mesh : bones.meshes)
        if (mesh.body == bodies.getBodyIndex("r_humerus"))
            for (const Vector3& point : mesh.points_M) humerus.extend(point);
    EXPECT_NEAR(humerus.min().y(), -0.31, 0.03);
    EXPECT_NEAR(humerus.max().y(), 0.02, 0.03);
    ASSERT_EQ(bones.notes.size(), 1u);  // the reference data have not all of them
    EXPECT_NE(bones.notes[0].find("not found"), std::string::npos);
}

}  // namespace
}  // namespace tautline::testing
