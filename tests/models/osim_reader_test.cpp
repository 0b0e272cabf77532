// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/osim_reader.h"

#include <algorithm>
#include <cmath>

#include "model_test_support.h"

namespace tautline::models::testing {
namespace {

const std::string oldJoint =
    "<Joint><CustomJoint name=\"hinge\"><parent_body>ground</parent_body>\n"
    "<location_in_parent>1 2 3</location_in_parent>\n"
    "<orientation_in_parent>0 0 0.5</orientation_in_parent>\n"
    "<location>0 0.1 0</location><orientation>0 0 0</orientation>\n"
    "<CoordinateSet><objects><Coordinate name=\"q\"><motion_type>rotational</motion_type>"
    "<default_value>0.25</default_value><range>-1 1</range><locked>true</locked>"
    "<prescribed_function/></Coordinate></objects><groups/></CoordinateSet>\n"
    "<reverse>false</reverse><SpatialTransform>\n"
    "<TransformAxis name=\"rotation1\"><coordinates>q</coordinates><axis>0 0 1</axis>"
    "<function><LinearFunction><coefficients>2 0</coefficients></LinearFunction></function>"
    "</TransformAxis>\n"
    "<TransformAxis name=\"rotation2\"><coordinates/><axis>0 1 0</axis><function/>"
    "</TransformAxis>\n"
    "<TransformAxis name=\"rotation3\"><coordinates/><axis>1 0 0</axis></TransformAxis>\n"
    "<TransformAxis name=\"translation1\"><coordinates/><axis>1 0 0</axis><function>"
    "<MultiplierFunction><function><Constant><value>3</value></Constant></function>"
    "<scale>0.5</scale></MultiplierFunction></function></TransformAxis>\n"
    "<TransformAxis name=\"translation2\"><axis>0 1 0</axis></TransformAxis>\n"
    "<TransformAxis name=\"translation3\"><coordinates>q</coordinates><axis>0 0 1</axis>"
    "<function><natCubicSpline><x>0 1 2</x><y>0 1 4</y></natCubicSpline></function>"
    "</TransformAxis></SpatialTransform></CustomJoint></Joint>\n";

std::string makeOldModel(const std::string& joint, const std::string& sets = "") {
    return wrapInDocument(
        "<BodySet><objects><Body name=\"ground\"><mass>0</mass><Joint/></Body>\n"
        "<Body name=\"one::a\"><mass>2</mass><mass_center>0 -0.5 0</mass_center>"
        "<inertia_xx>0.3</inertia_xx><inertia_yy>0.1</inertia_yy><inertia_zz>0.3</inertia_zz>"
        "<inertia_xy>0</inertia_xy><inertia_xz>0.01</inertia_xz><inertia_yz>0</inertia_yz>\n" +
            joint + "</Body></objects></BodySet>\n" + sets,
        "20303");
}

std::string makeMuscle(const std::string& points, const std::string& wraps = "", const std::string& more = "") {
    return "<ForceSet><objects><Thelen2003Muscle name=\"m\">\n<GeometryPath><PathPointSet>"
           "<objects>\n" +
           points + "</objects></PathPointSet>\n<PathWrapSet><objects>" + wraps +
           "</objects></PathWrapSet></GeometryPath>\n"
           "<max_isometric_force>100</max_isometric_force>"
           "<optimal_fiber_length>0.1</optimal_fiber_length>"
           "<tendon_slack_length>0.2</tendon_slack_length>" +
           more + "</Thelen2003Muscle></objects></ForceSet>\n";
}

std::string makePoint(const std::string& frame, const std::string& location) {
    return "<PathPoint name=\"p\"><socket_parent_frame>" + frame + "</socket_parent_frame><location>" + location +
           "</location></PathPoint>\n";
}

TEST(OsimReader, OldLayout) {
    const ModelDescription model = readOsimText(makeOldModel(oldJoint), "old.osim");
    EXPECT_EQ(model.documentVersion, 20303);
    ASSERT_EQ(model.bodies.size(), 1u);
    EXPECT_EQ(model.bodies[0].name, "one::a");
    EXPECT_EQ(model.bodies[0].mass, 2.0);
    EXPECT_EQ(model.bodies[0].inertia, (std::array<double, 6>{0.3, 0.1, 0.3, 0, 0.01, 0}));
    ASSERT_EQ(model.joints.size(), 1u);
    const Joint& joint = model.joints[0];
    EXPECT_EQ(joint.type, JointType::Custom);
    EXPECT_EQ(joint.parentBody, "ground");
    EXPECT_EQ(joint.childBody, "one::a");
    EXPECT_EQ(joint.parentOffset.p, Vector3(1, 2, 3));
    EXPECT_DOUBLE_EQ(joint.parentOffset.R(0, 0), std::cos(0.5));
    EXPECT_EQ(joint.childOffset.p, Vector3(0, 0.1, 0));
    ASSERT_EQ(joint.coordinates.size(), 1u);
    EXPECT_EQ(joint.coordinates[0].defaultValue, 0.25);
    EXPECT_TRUE(joint.coordinates[0].locked);
    EXPECT_FALSE(joint.coordinates[0].clamped);
    EXPECT_EQ(joint.axes[0].function.calcValue(1.5), 3.0);
    EXPECT_EQ(joint.axes[1].function.calcValue(1.5), 0.0) << "an empty function";
    EXPECT_EQ(joint.axes[3].function.calcValue(1.5), 1.5);
    EXPECT_NEAR(joint.axes[5].function.calcValue(1.5), 2.25, 1e-14);
    EXPECT_EQ(joint.axes[0].line, 12);
}

TEST(OsimReader, ReversedOldJointSwapsItsFrames) {
    std::string text = makeOldModel(oldJoint);
    text.replace(text.find("<reverse>false"), 14, "<reverse>true");
    const Joint joint = readOsimText(text, "old.osim").joints.at(0);
    EXPECT_EQ(joint.parentBody, "one::a");
    EXPECT_EQ(joint.childBody, "ground");
    EXPECT_EQ(joint.childOffset.p, Vector3(1, 2, 3));
}

TEST(OsimReader, FrameNamesAreLookedUpInTheJointFirst) {
    const auto joint = [](const std::string& name, const std::string& parent, const std::string& child,
                          const std::string& at) {
        return makeJoint("PinJoint", name,
                         makeOffsetFrame("a", parent, at, "0 0 0") + makeOffsetFrame("b", child, "0 0 0", "0 0 0"),
                         makeCoordinates({name.c_str()}));
    };
    const ModelDescription model = readNew(makeBodySet(makeBody("one") + makeBody("two")) +
                                           makeJointSet(joint("j1", "/ground", "/bodyset/one", "1 0 0") +
                                                        joint("j2", "../../../bodyset/one", "/bodyset/two", "2 0 0")));
    EXPECT_EQ(model.joints[0].parentBody, "ground");
    EXPECT_EQ(model.joints[0].parentOffset.p[0], 1.0);
    EXPECT_EQ(model.joints[1].parentBody, "one");
    EXPECT_EQ(model.joints[1].parentOffset.p[0], 2.0);
}

TEST(OsimReader, WhatStandsInOffsetFramesIsMovedToTheBody) {
    const std::string frames = "<components>" + makeOffsetFrame("outer", "..", "1 0 0", "0 0 1.5707963267948966") +
                               makeOffsetFrame("inner", "../outer", "2 0 0", "0 0 0") + "</components>";
    const ModelDescription model = readNew(
        makePinModel(makeMuscle(makePoint("/ground", "0 0 0") + makePoint("/bodyset/one/inner", "0 3 0")), frames));
    const PathPoint& point = model.muscles.at(0).path.points.at(1);
    EXPECT_EQ(point.body, "one");
    // A quarter turn: x of the outer frame is y of the body, its y is -x.
    EXPECT_NEAR(point.location[0], 1.0 - 3.0, 1e-15);
    EXPECT_NEAR(point.location[1], 2.0, 1e-15);
}

TEST(OsimReader, PathPointsOfAllKindsInBothSpellings) {
    const std::string points = makePoint("/ground", "0 0 0") +
                               "<ConditionalPathPoint name=\"c\"><body>one</body><location>1 0 0</location>"
                               "<range>-0.5 0.5</range><coordinate>q</coordinate></ConditionalPathPoint>\n"
                               "<MovingPathPoint name=\"n\"><socket_parent_frame>/bodyset/one</socket_parent_frame>"
                               "<socket_x_coordinate>/jointset/pin/q</socket_x_coordinate>"
                               "<socket_y_coordinate>/jointset/pin/q</socket_y_coordinate>"
                               "<socket_z_coordinate>/jointset/pin/q</socket_z_coordinate>"
                               "<x_location><LinearFunction><coefficients>2 1</coefficients></LinearFunction>"
                               "</x_location></MovingPathPoint>\n"
                               "<MovingPathPoint name=\"o\"><body>one</body><x_coordinate>q</x_coordinate>"
                               "<y_coordinate>q</y_coordinate><z_coordinate>q</z_coordinate>"
                               "<XAttachment><Constant><value>7</value></Constant></XAttachment></MovingPathPoint>\n";
    const MusclePath path = readNew(makePinModel(makeMuscle(points))).muscles.at(0).path;
    ASSERT_EQ(path.points.size(), 4u);
    EXPECT_TRUE(std::holds_alternative<FixedLocation>(path.points[0].kind));
    const auto& conditional = std::get<ConditionalLocation>(path.points[1].kind);
    EXPECT_EQ(conditional.coordinate, "q");
    EXPECT_EQ(conditional.range, (std::array<double, 2>{-0.5, 0.5}));
    const auto& moving = std::get<MovingLocation>(path.points[2].kind);
    EXPECT_EQ(moving.location_F[0].calcValue(3.0), 7.0);
    EXPECT_EQ(moving.location_F[1].calcValue(3.0), 0.0);
    EXPECT_EQ(std::get<MovingLocation>(path.points[3].kind).location_F[0].calcValue(1.0), 7.0);
}

TEST(OsimReader, WrapObjectsOfAllKinds) {
    const std::string wraps =
        "<WrapObjectSet><objects>"
        "<WrapCylinder name=\"c\"><radius>0.1</radius><length>0.5</length>"
        "<translation>1 2 3</translation><quadrant>-y</quadrant></WrapCylinder>"
        "<WrapSphere name=\"s\"><radius>0.2</radius><active>false</active></WrapSphere>"
        "<WrapEllipsoid name=\"e\"><dimensions>1 2 3</dimensions></WrapEllipsoid>"
        "<WrapTorus name=\"t\"><inner_radius>0.1</inner_radius><outer_radius>0.4</outer_radius>"
        "<quadrant>Unassigned</quadrant></WrapTorus></objects></WrapObjectSet>";
    const std::string muscle = makeMuscle(makePoint("/ground", "0 0 0") + makePoint("one", "0 3 0"),
                                          "<PathWrap><wrap_object>t</wrap_object></PathWrap>"
                                          "<PathWrap><wrap_object>c</wrap_object><method>axial</"
                                          "method><range>1 -1</range></PathWrap>");
    const ModelDescription model = readNew(makePinModel(muscle, wraps));
    ASSERT_EQ(model.wrapObjects.size(), 4u);
    EXPECT_EQ(model.wrapObjects[0].quadrant, Quadrant::MinusY);
    EXPECT_EQ(model.wrapObjects[0].X_BW.p, Vector3(1, 2, 3));
    EXPECT_EQ(model.wrapObjects[0].body, "one");
    EXPECT_FALSE(model.wrapObjects[1].active);
    EXPECT_EQ(std::get<EllipsoidShape>(model.wrapObjects[2].shape).semiAxes, Vector3(1, 2, 3));
    EXPECT_EQ(std::get<TorusShape>(model.wrapObjects[3].shape).ringRadius, 0.4);
    const auto& path = model.muscles.at(0).path;
    ASSERT_EQ(path.wraps.size(), 2u);
    EXPECT_EQ(path.wraps[0].wrapObject, 3u);
    EXPECT_EQ(path.wraps[0].method, WrapMethod::Hybrid);
    EXPECT_EQ(path.wraps[1].method, WrapMethod::Axial);
    EXPECT_EQ(path.wraps[1].range, (std::array<int, 2>{1, -1}));
}

TEST(OsimReader, WrapObjectsOfTautlinesOwn) {
    const std::string wraps =
        "<WrapObjectSet><objects><TautlineWrapParaboloid name=\"p\"><a>14</a><b>6</b><quadrant>-z</quadrant>"
        "<tautline_form>parametric</tautline_form><translation>1 2 3</translation></TautlineWrapParaboloid>"
        "<TautlineWrapEllipticTorus name=\"t\"><ring_radius>0.7</ring_radius><radial_semi_axis>0.2</radial_semi_axis>"
        "<axial_semi_axis>0.1</axial_semi_axis></TautlineWrapEllipticTorus>"
        "<WrapSphere name=\"s\"><radius>0.2</radius><tautline_form>implicit</tautline_form></WrapSphere>"
        "</objects></WrapObjectSet>";
    const ModelDescription model = readNew(makePinModel("", wraps));
    ASSERT_EQ(model.wrapObjects.size(), 3u);
    const WrapObject &paraboloid = model.wrapObjects[0], &torus = model.wrapObjects[1];
    EXPECT_EQ(std::get<ParaboloidShape>(paraboloid.shape).a, 14);
    EXPECT_EQ(std::get<ParaboloidShape>(paraboloid.shape).b, 6);
    EXPECT_EQ(paraboloid.form, SurfaceForm::Parametric);
    EXPECT_EQ(paraboloid.quadrant, Quadrant::MinusZ);
    EXPECT_EQ(paraboloid.X_BW.p, Vector3(1, 2, 3));
    EXPECT_EQ(std::get<EllipticTorusShape>(torus.shape).ringRadius, 0.7);
    EXPECT_EQ(std::get<EllipticTorusShape>(torus.shape).radialSemiAxis, 0.2);
    EXPECT_EQ(std::get<EllipticTorusShape>(torus.shape).axialSemiAxis, 0.1);
    EXPECT_EQ(torus.form, SurfaceForm::Implicit);
    EXPECT_EQ(model.wrapObjects[2].form, SurfaceForm::Implicit);
}

TEST(OsimReader, PathSpringsWithHintsAndStarts) {
    const std::string wraps =
        "<WrapObjectSet><objects><WrapSphere name=\"s\"><radius>0.2</radius></WrapSphere></objects></WrapObjectSet>";
    const std::string spring =
        "<ForceSet><objects><PathSpring name=\"spring\"><appliesForce>false</appliesForce><GeometryPath>"
        "<PathPointSet><objects>" +
        makePoint("/ground", "0 0 0") + makePoint("one", "0 3 0") +
        "</objects></PathPointSet><tautline_wraps_in_order>true</tautline_wraps_in_order><PathWrapSet><objects>"
        "<PathWrap><wrap_object>s</wrap_object><tautline_hint>1 2 3</tautline_hint></PathWrap>"
        "<PathWrap><wrap_object>s</wrap_object><tautline_start><point>0 0 0.2</point><direction>0 1 0</direction>"
        "<length>0.3</length></tautline_start></PathWrap></objects></PathWrapSet></GeometryPath>"
        "<resting_length>0.5</resting_length><stiffness>7</stiffness><dissipation>0.1</dissipation>"
        "</PathSpring></objects></ForceSet>";
    const ModelDescription model = readNew(makePinModel(spring, wraps));
    ASSERT_NE(findSpring(model, "spring"), nullptr);
    const PathSpring& read = *findSpring(model, "spring");
    EXPECT_FALSE(read.appliesForce);
    EXPECT_EQ(read.restingLength, 0.5);
    EXPECT_EQ(read.stiffness, 7);
    EXPECT_EQ(read.dissipation, 0.1);
    EXPECT_TRUE(read.path.areWrapsInOrder);
    ASSERT_EQ(read.path.wraps.size(), 2u);
    EXPECT_EQ(read.path.wraps[0].hint, Vector3(1, 2, 3));
    EXPECT_FALSE(read.path.wraps[0].start.has_value());
    ASSERT_TRUE(read.path.wraps[1].start.has_value());
    EXPECT_EQ(read.path.wraps[1].start->point, Vector3(0, 0, 0.2));
    EXPECT_EQ(read.path.wraps[1].start->direction, Vector3(0, 1, 0));
    EXPECT_EQ(read.path.wraps[1].start->length, 0.3);
}

TEST(OsimReader, WhatHasNoEffectIsListed) {
    const ModelDescription model =
        readNew(makePinModel("<credits>someone</credits>\n<MarkerSet><objects><Marker name=\"k\"/></objects>"
                             "</MarkerSet>\n<defaults><Thelen2003Muscle name=\"default\"/></defaults>\n"
                             "<ControllerSet><objects/></ControllerSet>\n",
                             "<attached_geometry><Mesh name=\"a\"/></attached_geometry>"));
    EXPECT_TRUE(model.muscles.empty()) << "defaults are no muscles";
    for (const char* tag : {"credits", "MarkerSet", "defaults", "ControllerSet", "attached_geometry"}) {
        const auto found = std::find_if(model.skipped.begin(), model.skipped.end(),
                                        [&](const auto& entry) { return entry.element == tag; });
        ASSERT_NE(found, model.skipped.end()) << tag;
        EXPECT_EQ(found->count, 1);
        EXPECT_GT(found->firstLine, 1);
        EXPECT_FALSE(found->reason.empty());
    }
}

TEST(OsimReader, BytesThatAreNotUtf8DoNotMatter) {
    const ModelDescription model =
        readNew(makePinModel("<credits>829\x96"
                             "840 \xfc</credits>\n"));
    EXPECT_EQ(model.bodies.size(), 1u);
}

TEST(OsimReader, ANumberMayBeInterruptedByAComment) {
    const ModelDescription model = readOsimText(
        "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><gravity>0 -1 <!-- z --> 2</gravity>"
        "</Model></OpenSimDocument>",
        "c.osim");
    EXPECT_EQ(model.gravity, Vector3(0, -1, 2));
}

TEST(OsimReader, PrescribedMotionOnlyIfEnforced) {
    for (const bool enforced : {false, true}) {
        std::string text = makePinModel();
        const std::string plain = "<Coordinate name=\"q\"/>";
        text.replace(text.find(plain), plain.size(),
                     "<Coordinate name=\"q\"><prescribed_function><LinearFunction><coefficients>"
                     "1 0</coefficients></LinearFunction></prescribed_function><prescribed>" +
                         std::string(enforced ? "true" : "false") + "</prescribed></Coordinate>");
        const ModelDescription model = readNew(text);
        EXPECT_EQ(findCoordinate(model, "q")->prescribedMotion.has_value(), enforced);
    }
}

TEST(OsimReader, ConstraintsOnlyIfEnforced) {
    const std::string coupler =
        "<coupled_coordinates_function><LinearFunction><coefficients>1 0</coefficients>"
        "</LinearFunction></coupled_coordinates_function>"
        "<independent_coordinate_names>q</independent_coordinate_names>"
        "<dependent_coordinate_name>r</dependent_coordinate_name></CoordinateCouplerConstraint>";
    const std::string joints = makeBodySet(makeBody("one")) +
                               makeJointSet(makeJoint("UniversalJoint", "u",
                                                      makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") +
                                                          makeOffsetFrame("b", "/bodyset/one", "0 0 0", "0 0 0"),
                                                      makeCoordinates({"q", "r"})));
    for (const char* state : {"<isEnforced>false</isEnforced>", "<isDisabled>true</isDisabled>"}) {
        const ModelDescription model =
            readNew(joints + "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"k\">" + state + coupler +
                    "</objects></ConstraintSet>");
        EXPECT_TRUE(model.constraints.empty());
        EXPECT_EQ(model.skipped.back().element, "CoordinateCouplerConstraint");
    }
}

}  // namespace
}  // namespace tautline::models::testing
