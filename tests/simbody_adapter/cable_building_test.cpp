// SPDX-License-Identifier: Apache-2.0
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
                   "the hint of obstacle 'o' must be finite, but is (nan nan nan)");
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

TEST(CableBuilding, StartsBySideWindingAndHole) {
    BareScene scene;
    MobilizedBody ground = scene.matter.Ground();
    const auto addCable = [&](const SimTK::Vec3& A, const SimTK::Vec3& B, std::shared_ptr<const Surface> surface,
                              const StartHint& hint) {
        Cable cable(scene.cables, ground, A, ground, B);
        cable.addObstacle(ground, Transform(), std::move(surface), hint);
        return cable;
    };
    const auto cylinder = std::make_shared<Cylinder>(0.5);
    const SimTK::Vec3 A(-2, 0.1, 0), B(2, 0.1, 0);
    const Cable above = addCable(A, B, cylinder, PassOnSide{Vec3(0, 1, 0)});
    const Cable below = addCable(A, B, cylinder, PassOnSide{Vec3(0, -1, 0)});
    const Cable wound = addCable(A, B, cylinder, WindAround{1.5});
    const auto torus = std::make_shared<Torus>(1, 0.3);
    const SimTK::Vec3 C(1.5, 0, -2), D(1.5, 0, 2);
    const Cable beside = addCable(C, D, torus, ThreadHole{0});
    const Cable threaded = addCable(C, D, torus, ThreadHole{1});
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    // Tangents and arc over a circle of radius 0.5 between points at the distance a on either side.
    const Real a = std::hypot(2, 0.1), tangents = 2 * std::sqrt(a * a - 0.25), off = 2 * std::acos(0.5 / a);
    const Real angle = SimTK::Pi - 2 * std::atan(0.05);
    EXPECT_NEAR(above.getLength(state), tangents + 0.5 * (angle - off), 1e-12);
    EXPECT_NEAR(below.getLength(state), tangents + 0.5 * (2 * SimTK::Pi - angle - off), 1e-12);
    // Counterclockwise, from x < 0 to x > 0, past the bottom and once round more.
    EXPECT_NEAR(wound.getLength(state), tangents + 0.5 * (4 * SimTK::Pi - angle - off), 1e-12);
    EXPECT_NEAR(beside.getLength(state), 4, 1e-12);
    // Inside the tube's circle at x = 1 from a point 0.5 outside of it.
    const Real c = std::hypot(0.5, 2);
    EXPECT_NEAR(threaded.getLength(state),
                2 * std::sqrt(c * c - 0.09) + 0.3 * (2 * (SimTK::Pi - std::atan(4)) - 2 * std::acos(0.3 / c)), 1e-10);
    EXPECT_MESSAGE(addCable(A, B, cylinder, ThreadHole{1}), "has no hole to thread");
    EXPECT_MESSAGE(addCable(A, B, cylinder, PassOnSide{Vec3::Zero()}), "needs a finite direction that is not zero");
}

TEST(CableBuilding, RefusesABodyOfAnotherSystem) {
    BareScene scene, other;
    MobilizedBody ground = scene.matter.Ground(), stranger = other.matter.Ground();
    EXPECT_MESSAGE(Cable(scene.cables, ground, SimTK::Vec3(0), stranger, SimTK::Vec3(1), "c"),
                   "does not belong to the cable's system");
}

}  // namespace
}  // namespace tautline::testing
