#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

TEST(CableBuilding, ElementsStandInOrderBeforeTheInsertion) {
    MechanismScene scene;
    ASSERT_EQ(scene.cable.getNumElements(), 6);
    EXPECT_EQ(scene.cable.getElementName(CableElementIndex(0)), "origin");
    EXPECT_EQ(scene.cable.getElementName(CableElementIndex(5)), "insertion");
    EXPECT_EQ(scene.cable.getElementName(scene.point), "point2");
    EXPECT_EQ(scene.cable.findElement("obstacle3"), scene.cylinder);
    EXPECT_FALSE(scene.cable.isObstacle(scene.point));
    EXPECT_TRUE(scene.cable.isObstacle(scene.ellipsoid));
    EXPECT_EQ(scene.cables.getNumCables(), 1);
    EXPECT_EQ(scene.cables.getCable(CableIndex(0)).getName(), "mechanism");
}

TEST(CableBuilding, RefusesBadInputByNameAndValue) {
    BareScene scene;
    MobilizedBody ground = scene.matter.Ground();
    const auto sphere = std::make_shared<Sphere>(1.0);
    EXPECT_MESSAGE(Cable(scene.cables, ground, SimTK::Vec3(SimTK::NaN), ground, SimTK::Vec3(0), "a"),
                   "cable 'a': an end is not finite");
    EXPECT_EQ(scene.cables.getNumCables(), 0);
    Cable cable(scene.cables, ground, SimTK::Vec3(0), ground, SimTK::Vec3(1), "b");
    EXPECT_MESSAGE(cable.addObstacle(ground, Transform(), nullptr, std::nullopt, "o"),
                   "cable 'b': obstacle 'o' has no surface");
    EXPECT_MESSAGE(cable.addObstacle(ground, Transform(), sphere, SimTK::Vec3(SimTK::NaN), "o"),
                   "the hint of obstacle 'o' is not finite");
    cable.addObstacle(ground, Transform(), sphere, std::nullopt, "o");
    EXPECT_MESSAGE(cable.addViaPoint(ground, SimTK::Vec3(0), "o"), "an element 'o' already");
    EXPECT_MESSAGE(cable.addViaPoint(ground, SimTK::Vec3(SimTK::Infinity), "p"), "'p' is not finite");
    EXPECT_MESSAGE(cable.setHint(CableElementIndex(0), std::nullopt), "'origin' is a point");
    EXPECT_MESSAGE(cable.findElement("x"), "cable 'b': no element 'x'");
    EXPECT_MESSAGE(scene.cables.getCable(CableIndex(7)), "no cable 7 of 1");
    EXPECT_MESSAGE(Cable().getName(), "empty handle");
    PathSolverOptions options;
    options.maxIterations = 0;
    EXPECT_MESSAGE(cable.setOptions(options), "maxIterations must be at least 1, but is 0");
}

TEST(CableBuilding, RefusesABodyOfAnotherSystem) {
    BareScene scene, other;
    MobilizedBody ground = scene.matter.Ground(), stranger = other.matter.Ground();
    EXPECT_MESSAGE(Cable(scene.cables, ground, SimTK::Vec3(0), stranger, SimTK::Vec3(1), "c"),
                   "does not belong to the cable's system");
}

}  // namespace
}  // namespace tautline::testing
