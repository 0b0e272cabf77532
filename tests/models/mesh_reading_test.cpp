// SPDX-License-Identifier: Apache-2.0
/** Meshes that bodies look like, in all the layouts of documents. */
#include "model_test_support.h"

namespace tautline::models::testing {
namespace {

const std::string kVersion = "40000";

ModelDescription readBodyWith(const std::string& inside, const std::string& version = kVersion) {
    const std::string joint = makeJoint(
        "PinJoint", "pin",
        makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") + makeOffsetFrame("b", "/bodyset/bone", "0 0 0", "0 0 0"),
        makeCoordinates({"q"}));
    return readOsimText(wrapInDocument(makeBodySet(makeBody("bone", inside)) + makeJointSet(joint), version),
                        "meshes.osim");
}

void expectNear(const Vector3& found, const Vector3& expected) {
    EXPECT_LT((found - expected).norm(), 1e-12) << found.transpose() << " is not " << expected.transpose();
}

TEST(MeshReading, MeshOfABodyHasItsScale) {
    const ModelDescription model = readBodyWith(
        "<attached_geometry><Mesh name='m'><socket_frame>..</socket_frame><scale_factors>1 2 3</scale_factors>"
        "<mesh_file>femur.vtp</mesh_file></Mesh><Sphere name='ball'><radius>1</radius></Sphere></attached_geometry>");
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].file, "femur.vtp");
    EXPECT_EQ(model.meshes[0].body, "bone");
    EXPECT_EQ(model.meshes[0].line, 4);
    expectNear(model.meshes[0].scale, {1, 2, 3});
    expectNear(model.meshes[0].X_BM.p, Vector3::Zero());
    EXPECT_TRUE(model.notes.empty());
}

TEST(MeshReading, MeshOfAnOffsetFrameStandsInIt) {
    const ModelDescription model = readBodyWith(
        "<components><PhysicalOffsetFrame name='f'><socket_parent>..</socket_parent><translation>1 0 0</translation>"
        "<orientation>0 0 1.5707963267948966</orientation><attached_geometry><Mesh "
        "name='m'><socket_frame>..</socket_frame>"
        "<mesh_file>talus.obj</mesh_file></Mesh></attached_geometry></PhysicalOffsetFrame></components>");
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].body, "bone");
    expectNear(model.meshes[0].X_BM * Vector3(1, 0, 0), {1, 1, 0});
}

TEST(MeshReading, MeshMayNameAnotherFrame) {
    const ModelDescription model = readBodyWith(
        "<attached_geometry><Mesh name='m'><socket_frame>/ground</socket_frame><mesh_file>room.stl</mesh_file></Mesh>"
        "</attached_geometry>");
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].body, kGroundName);
}

TEST(MeshReading, OldDocumentsPlaceAndScaleTwice) {
    const ModelDescription model = readBodyWith(
        "<VisibleObject><GeometrySet><objects><DisplayGeometry><geometry_file>a.vtp</geometry_file>"
        "<transform>0 0 0 1 0 0</transform><scale_factors>2 1 1</scale_factors></DisplayGeometry></objects><groups/>"
        "</GeometrySet><scale_factors>3 1 1</scale_factors><transform>0 0 1.5707963267948966 0 0 5</transform>"
        "</VisibleObject>",
        "30000");
    ASSERT_EQ(model.meshes.size(), 1u);
    expectNear(model.meshes[0].scale, {6, 1, 1});
    expectNear(model.meshes[0].X_BM.p, {0, 1, 5});  // the part's shift, turned by the whole's transform
}

TEST(MeshReading, OldestDocumentsListFiles) {
    const ModelDescription model = readBodyWith(
        "<VisibleObject><geometry_files>a.vtp b.vtp</geometry_files><scale_factors>2 2 "
        "2</scale_factors></VisibleObject>",
        "20001");
    ASSERT_EQ(model.meshes.size(), 2u);
    EXPECT_EQ(model.meshes[1].file, "b.vtp");
    expectNear(model.meshes[1].scale, {2, 2, 2});
}

TEST(MeshReading, HiddenAndUnnamedMeshesAreNotDrawn) {
    const ModelDescription model = readBodyWith(
        "<attached_geometry><Mesh name='m'><Appearance><visible>false</visible></Appearance>"
        "<mesh_file>hidden.vtp</mesh_file></Mesh><Mesh name='n'><mesh_file/></Mesh></attached_geometry>");
    EXPECT_TRUE(model.meshes.empty());
}

TEST(MeshReading, WhatIsOnlyDrawnNeverKeepsAModelFromBeingRead) {
    for (const char* mesh :
         {"<Mesh name='m'><scale_factors>1 2</scale_factors><mesh_file>a.vtp</mesh_file></Mesh>", "<Mesh name='m'/>",
          "<Mesh name='m'><socket_frame>/no/where</socket_frame><mesh_file>a.vtp</mesh_file></Mesh>"}) {
        SCOPED_TRACE(mesh);
        const ModelDescription model = readBodyWith("<attached_geometry>" + std::string(mesh) + "</attached_geometry>");
        EXPECT_TRUE(model.meshes.empty());
        ASSERT_EQ(model.notes.size(), 1u);
        EXPECT_NE(model.notes[0].text.find("meshes of Body 'bone' are not drawn"), std::string::npos);
    }
}

}  // namespace
}  // namespace tautline::models::testing
