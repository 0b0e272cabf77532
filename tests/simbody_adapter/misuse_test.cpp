// SPDX-License-Identifier: Apache-2.0
/** What used to be wrong in silence: each misuse is an error, and what is no number is seen. */
#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

TEST(Misuse, ANegativeTensionDoesNotPush) {
    MechanismScene scene;
    const State state = scene.makeState(0);
    scene.system.realize(state, Stage::Velocity);
    SimTK::Vector_<SimTK::SpatialVec> F_G(scene.matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0)));
    SimTK::Vector f(state.getNU(), Real(0));
    const std::string message = "cable 'mechanism': a string cannot push, but the tension is -2";
    EXPECT_MESSAGE(scene.cable.applyBodyForces(state, -2, F_G), message);
    EXPECT_MESSAGE(scene.cable.applyMobilityForces(state, -2, f), message);
    EXPECT_MESSAGE(scene.cable.calcPower(state, -2), message);
    EXPECT_NO_THROW(scene.cable.applyBodyForces(state, 2, F_G));
}

TEST(Misuse, ARotationThatIsNoneIsRefused) {
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-1, 0, 0), scene.matter.Ground(), SimTK::Vec3(1, 0, 0),
                "c");
    const auto sphere = std::make_shared<Sphere>(0.1);
    const SimTK::Rotation scaled(SimTK::Mat33(1.001), true), mirrored(SimTK::Mat33(1, 0, 0, 0, 1, 0, 0, 0, -1), true);
    for (const SimTK::Rotation& R : {scaled, mirrored})
        EXPECT_MESSAGE(cable.addObstacle(scene.matter.Ground(), Transform(R), sphere, std::nullopt, "o"),
                       "cable 'c': the orientation of 'o' is no rotation");
    EXPECT_EQ(cable.getNumObstacles(), 0);
}

TEST(Misuse, NamesOfCablesAreTheirOwn) {
    BareScene scene;
    const auto add = [&](const std::string& name) {
        return Cable(scene.cables, SimTK::GroundIndex, SimTK::Vec3(0), SimTK::GroundIndex, SimTK::Vec3(1), name);
    };
    const Cable first = add("string");
    EXPECT_MESSAGE(add("string"), "there is a cable 'string' already");
    EXPECT_EQ(scene.cables.getNumCables(), 1);
    EXPECT_EQ(scene.cables.getCable("string").getCableIndex(), first.getCableIndex());
    EXPECT_MESSAGE(scene.cables.getCable("rope"), "no cable 'rope'");
}

TEST(Misuse, ALengthThatIsNoNumberIsSeen) {
    BareScene scene;
    MobilizedBody::Slider slider(scene.matter.Ground(), Transform(), makeBody(), Transform());
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0), slider, SimTK::Vec3(0));
    const ElasticStringForce string(scene.forces, cable, 100, 0.5);
    const CableSpringForce spring(scene.forces, cable, 100, 0.5, 1);
    State state = scene.system.realizeTopology();
    slider.setOneQ(state, 0, SimTK::NaN);
    scene.system.realize(state, Stage::Velocity);
    EXPECT_TRUE(SimTK::isNaN(cable.getLength(state)));
    EXPECT_TRUE(SimTK::isNaN(string.getStretch(state)));
    EXPECT_TRUE(SimTK::isNaN(string.getTension(state)));
    EXPECT_TRUE(SimTK::isNaN(spring.getTension(state)));
}

TEST(Misuse, AStateFromBeforeAnElementWasAddedIsRefused) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    EXPECT_NO_THROW(scene.cable.getLength(state));
    scene.cable.addViaPoint(scene.matter.Ground(), SimTK::Vec3(1));
    const std::string message = "the System was changed after this State was made";
    EXPECT_MESSAGE(scene.cable.getLength(state), message);
    EXPECT_MESSAGE(scene.cable.isDisabled(state), message);
    scene.system.realizeTopology();
    EXPECT_MESSAGE(scene.cable.getLength(state), message);
    EXPECT_NO_THROW(scene.system.realize(scene.makeState(0), Stage::Position));
}

TEST(Misuse, AnArcThatIsNotThereHasNoLength) {
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-1, 0, 0), scene.matter.Ground(),
                SimTK::Vec3(1, 0, 0));
    const CableElementIndex lifted =
        cable.addObstacle(scene.matter.Ground(), SimTK::Vec3(0, -1, 0), std::make_shared<Sphere>(0.5));
    State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    EXPECT_TRUE(SimTK::isNaN(cable.getArcLength(state, lifted)));
    SimTK::UnitVec3 atP, atQ;
    EXPECT_FALSE(cable.getContactTangents(state, lifted, atP, atQ));
    EXPECT_MESSAGE(cable.calcResampledArc(state, lifted, 5), "'obstacle1' is not touched");
}

/** Simbody's springs take stiffness, length and dissipation in this order; so do ours, and say so by their energy. */
TEST(Misuse, ParametersStandInTheOrderOfSimbodysSprings) {
    BareScene scene;
    MobilizedBody::Slider slider(scene.matter.Ground(), Transform(), makeBody(), Transform());
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0), slider, SimTK::Vec3(0));
    const ElasticStringForce string(scene.forces, cable, 100, 1.5, 0.2);
    SimTK::Force::TwoPointLinearSpring(scene.forces, scene.matter.Ground(), SimTK::Vec3(0), slider, SimTK::Vec3(0), 100,
                                       1.5);
    State state = scene.system.realizeTopology();
    slider.setOneQ(state, 0, 2);
    scene.system.realize(state, Stage::Dynamics);
    EXPECT_NEAR(scene.system.calcPotentialEnergy(state), 2 * 100 * 0.25 / 2, 1e-12);
    EXPECT_EQ(string.getDefaultParameters().damping, 0.2);
}

}  // namespace
}  // namespace tautline::testing
