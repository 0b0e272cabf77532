// SPDX-License-Identifier: Apache-2.0
/** Forces along paths on bodies that a host has built, and the tension that a file prescribes. */
#include "tautline/models/hosted_forces.h"

#include <gtest/gtest.h>

#include "tautline/models/model_system.h"
#include "tautline/models/osim_reader.h"

namespace {

using namespace tautline::models;
using SimTK::Stage;
using SimTK::State;
using SimTK::Vec3;

/** An arm of two hinges. */
struct Arm {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    SimTK::Body::Rigid bone{SimTK::MassProperties(1, Vec3(0), SimTK::UnitInertia(0.1))};
    SimTK::MobilizedBody::Pin upper{matter.Ground(), Vec3(0), bone, Vec3(0, 0.3, 0)};
    SimTK::MobilizedBody::Pin lower{upper, Vec3(0, -0.3, 0), bone, Vec3(0, 0.3, 0)};
};

std::string describePoint(const std::string& body, const std::string& location) {
    return "<PathPoint><socket_parent_frame>" + body + "</socket_parent_frame><location>" + location +
           "</location></PathPoint>";
}

std::string describeTension(const std::string& points, const std::string& tension) {
    return "<ForceSet><objects><TautlinePrescribedTension name='pull'><GeometryPath><PathPointSet><objects>" + points +
           "</objects></PathPointSet></GeometryPath>" + tension + "</TautlinePrescribedTension></objects></ForceSet>";
}

TEST(HostedForces, BodiesGoByIndexAndByGivenName) {
    Arm arm;
    const std::string text = "<TautlineForces>" +
                             describeTension(describePoint("ground", "0.1 0 0") + describePoint("humerus", "0.05 0 0") +
                                                 describePoint("2", "0 0.2 0"),
                                             "<tension>7</tension>") +
                             "</TautlineForces>";
    HostedForces hosted(arm.system, text, "arm.xml", {{"humerus", arm.upper}});
    State state = arm.system.realizeTopology();
    arm.lower.setAngle(state, 0.4);
    arm.system.realize(state, Stage::Velocity);
    const auto& slot = hosted.getPaths().getPathForces().at(0);
    const Vec3 A(0.1, 0, 0), B = arm.upper.findStationLocationInGround(state, Vec3(0.05, 0, 0)),
                             C = arm.lower.findStationLocationInGround(state, Vec3(0, 0.2, 0));
    EXPECT_NEAR(slot.cable.getLength(state), (A - B).norm() + (B - C).norm(), 1e-14);
    EXPECT_EQ(slot.force.getTension(state), 7);
    EXPECT_EQ(hosted.getDescription().bodies.size(), 4u);  // 0, 1, 2 and the name
}

TEST(HostedForces, FramesAndWrapObjectsStandOnTheHostsBodies) {
    Arm arm;
    const std::string text =
        "<TautlineForces><BodySet><objects><Body name='1'><components><PhysicalOffsetFrame name='elbow'>"
        "<socket_parent>..</socket_parent><translation>0 -0.3 0</translation><WrapObjectSet><objects>"
        "<WrapCylinder name='roll'><radius>0.03</radius><length>0.1</length><quadrant>+x</quadrant></WrapCylinder>"
        "</objects></WrapObjectSet></PhysicalOffsetFrame></components></Body></objects></BodySet>"
        "<ForceSet><objects><PathSpring name='band'><GeometryPath><PathPointSet><objects>" +
        describePoint("1", "0.01 0 0") + describePoint("2", "0.01 0.1 0") +
        "</objects></PathPointSet><PathWrapSet><objects><PathWrap><wrap_object>roll</wrap_object></PathWrap></objects>"
        "</PathWrapSet></GeometryPath><resting_length>0.3</resting_length><stiffness>10</stiffness>"
        "<dissipation>0</dissipation></PathSpring></objects></ForceSet></TautlineForces>";
    HostedForces hosted(arm.system, text, "arm.xml");
    State state = arm.system.realizeTopology();
    arm.upper.setAngle(state, -0.3);
    arm.lower.setAngle(state, -0.5);
    arm.system.realize(state, Stage::Position);
    const auto& slot = hosted.getPaths().getSprings().at(0);
    Vec3 P, Q;
    ASSERT_TRUE(slot.cable.getContactPoints(state, slot.cable.findElement("roll"), P, Q));
    const Vec3 elbow = arm.lower.findStationLocationInGround(state, Vec3(0, 0.3, 0));
    EXPECT_NEAR((P - elbow).norm(), 0.03, 1e-12);
    EXPECT_NEAR((Q - elbow).norm(), 0.03, 1e-12);
}

TEST(HostedForces, AControllerOfTheDocumentExcitesItsMuscle) {
    Arm arm;
    const std::string text =
        "<TautlineForces><ForceSet><objects><Millard2012EquilibriumMuscle "
        "name='m'><GeometryPath><PathPointSet><objects>" +
        describePoint("0", "0.1 0 0") + describePoint("1", "0 0.1 0") +
        "</objects></PathPointSet></GeometryPath><max_isometric_force>100</max_isometric_force>"
        "<optimal_fiber_length>0.1</optimal_fiber_length><tendon_slack_length>0.1</tendon_slack_length>"
        "</Millard2012EquilibriumMuscle></objects></ForceSet><ControllerSet><objects><PrescribedController name='c'>"
        "<actuator_list>m</actuator_list><ControlFunctions><objects><LinearFunction name='m'><coefficients>0.2 0.1"
        "</coefficients></LinearFunction></objects></ControlFunctions></PrescribedController></objects></ControllerSet>"
        "</TautlineForces>";
    HostedForces hosted(arm.system, text, "arm.xml");
    State state = arm.system.realizeTopology();
    state.setTime(2);
    arm.system.realize(state, Stage::Position);
    // A LinearFunction's first coefficient is its slope.
    EXPECT_NEAR(hosted.getPaths().getMuscles().at(0).muscle.getExcitation(state), 0.2 * 2 + 0.1, 1e-15);
}

TEST(HostedForces, WhatNeedsCoordinatesIsRefusedByLine) {
    Arm arm;
    const std::string text =
        "<TautlineForces>\n<ForceSet><objects><TautlinePrescribedTension "
        "name='pull'><GeometryPath><PathPointSet><objects>" +
        describePoint("0", "0 0 0") +
        "\n<ConditionalPathPoint name='via'><socket_parent_frame>1</socket_parent_frame><location>0 0 0</location>"
        "<socket_coordinate>elbow</socket_coordinate><range>0 1</range></ConditionalPathPoint>" +
        describePoint("1", "0.1 0 0") +
        "</objects></PathPointSet></GeometryPath></TautlinePrescribedTension></objects></ForceSet></TautlineForces>";
    try {
        HostedForces hosted(arm.system, text, "arm.xml");
        FAIL();
    } catch (const ModelError& error) {
        EXPECT_EQ(error.getLine(), 3);
        EXPECT_NE(std::string(error.what()).find("there is no coordinate 'elbow'"), std::string::npos) << error.what();
    }
}

TEST(PrescribedTension, OfAModelFilePullsAndCanBeSet) {
    const std::string text = "<OpenSimDocument Version='40000'><Model name='m'>" +
                             describeTension(describePoint("/ground", "0 0 0") + describePoint("/ground", "3 4 0"),
                                             "<tension>2.5</tension>") +
                             "</Model></OpenSimDocument>";
    ModelSystem model(readOsimText(text, "tension.osim"));
    State state = model.makeDefaultState();
    model.getSystem().realize(state, Stage::Velocity);
    const auto path = model.getPaths().at(0);
    EXPECT_EQ(path.cable.getLength(state), 5);
    EXPECT_EQ(path.force.getTension(state), 2.5);
}

}  // namespace
