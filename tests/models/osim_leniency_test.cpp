// SPDX-License-Identifier: Apache-2.0
/** A file for each kind of element, and for what is read though another reader would stumble: those of models/accepted,
each with its answer by hand in its first line; joints against Simbody's own mobilizers; everything unknown in one list.
*/
#include <filesystem>
#include <fstream>

#include "model_test_support.h"
#include "tautline/models/model_system.h"
#include "tautline/models/path_study.h"
#include "tautline/simbody/conversions.h"

namespace tautline::models::testing {
namespace {

/** What a file says of itself in its first line: <!-- expect: QUANTITY value within tolerance; notes N -->, the
quantity "length", of its first path, or "acceleration", of its first mobility, in the default pose; after the notes, if
the path is not solved, "; status NAME". */
struct Expectation {
    std::string quantity, status = "solved";
    double value = 0.0, tolerance = 0.0;
    std::size_t notes = 0;
};

Expectation readExpectation(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    Expectation expected;
    char quantity[16] = "", status[16] = "";
    const std::size_t start = line.find("<!-- expect: ");
    EXPECT_NE(start, std::string::npos);
    const int found = std::sscanf(line.c_str() + start, "<!-- expect: %15s %lf within %lf; notes %zu; status %15s -->",
                                  quantity, &expected.value, &expected.tolerance, &expected.notes, status);
    EXPECT_GE(found, 4);
    expected.quantity = quantity;
    if (found == 5) expected.status = status;
    return expected;
}

double calcLength(const ModelDescription& description, const std::string& status) {
    PathStudy study(description);
    const PoseAnswer answer = study.solve({});
    EXPECT_EQ(answer.constraintFault, "");
    EXPECT_EQ(getName(answer.paths.at(0).status), status);
    return answer.paths.at(0).length;
}

double calcAcceleration(const ModelDescription& description) {
    ModelSystem model(description);
    SimTK::State state = model.makeDefaultState();
    model.getSystem().realize(state, SimTK::Stage::Acceleration);
    return state.getUDot()[0];
}

/** Values by hand: closed forms, chains of transforms, the published laws of forces. */
TEST(OsimLeniency, FilesInAccepted) {
    const auto folder = std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "accepted";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path().filename().string());
        const Expectation expected = readExpectation(entry.path());
        const ModelDescription description = readOsimFile(entry.path());
        EXPECT_EQ(description.notes.size(), expected.notes);
        for (const ReadingNote& note : description.notes) EXPECT_GT(note.line, 1) << note.text;
        ASSERT_TRUE(expected.quantity == "length" || expected.quantity == "acceleration") << expected.quantity;
        const double value =
            expected.quantity == "length" ? calcLength(description, expected.status) : calcAcceleration(description);
        EXPECT_NEAR(value, expected.value, expected.tolerance);
        ++files;
    }
    EXPECT_GE(files, 67);
}

std::string getAcceptedFile(const std::string& name) {
    return (std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "accepted" / (name + ".osim")).string();
}

TEST(OsimLeniency, WhatIsRepairedCanBeSimulated) {
    for (const char* name : {"massless_link", "massless_end", "impossible_inertia", "unused_coordinate",
                             "no_mass_center", "child_at_ground", "axis_of_two_coordinates"}) {
        SCOPED_TRACE(name);
        ModelSystem model(readOsimFile(getAcceptedFile(name)));
        SimTK::State state = model.makeDefaultState();
        model.getSystem().realize(state, SimTK::Stage::Acceleration);
        model.requireRegularPose(state);
        EXPECT_TRUE(std::isfinite(state.getUDot().norm()));
    }
}

TEST(OsimLeniency, ImpossibleInertiasBecomeThoseOfASphereOfTheSameNorm) {
    const ModelDescription model = readOsimFile(getAcceptedFile("impossible_inertia"));
    const double moment = std::sqrt((0.01 * 0.01 + 0.01 * 0.01 + 0.03 * 0.03) / 3);
    EXPECT_NEAR(model.bodies.at(0).inertia[0], moment, 1e-16);
    EXPECT_EQ(model.bodies.at(0).inertia[2], model.bodies.at(0).inertia[0]);
    EXPECT_EQ(model.bodies.at(0).inertia[3], 0.0);
}

TEST(OsimLeniency, AStartInGimbalLockIsRefusedWithItsCoordinate) {
    ModelSystem model(readOsimFile(getAcceptedFile("singular_start")));
    SimTK::State state = model.makeDefaultState();
    model.getSystem().realize(state, SimTK::Stage::Position);
    try {
        model.requireRegularPose(state);
        FAIL() << "not refused";
    } catch (const ModelError& error) {
        EXPECT_NE(std::string(error.what()).find("coordinate 'rz' is at 0.0"), std::string::npos) << error.what();
    }
    model.getModel().setCoordinate(state, "ry", -1.57);
    model.getSystem().realize(state, SimTK::Stage::Position);
    EXPECT_NO_THROW(model.requireRegularPose(state));
}

TEST(OsimLeniency, ACoordinateThatItsJointDoesNotUseKeepsItsValueAndMovesNothing) {
    BuiltSystem built(readOsimFile(getAcceptedFile("unused_coordinate")));
    EXPECT_EQ(built.model.getCoordinate(built.state, "idle"), 0.7);
    built.system.realize(built.state, SimTK::Stage::Position);
    const SimTK::Transform before = built.model.getBody("arm").getBodyTransform(built.state);
    built.set("idle", -1.3);
    EXPECT_EQ(built.model.getCoordinate(built.state, "idle"), -1.3);
    EXPECT_EQ(before, built.model.getBody("arm").getBodyTransform(built.state));
    built.system.realize(built.state, SimTK::Stage::Acceleration);
    const auto& slot = built.model.getCoordinateSlot("idle");
    EXPECT_EQ(built.model.getMatter().getMobilizedBody(slot.body).getOneUDot(built.state, 0), 0.0) << "gravity";
}

// ---- joints

std::string makeModel(const std::string& joint) {
    return makeBodySet(makeBody("one")) + makeJointSet(joint);
}

const char* const frames[] = {"0.1 0.2 0.3", "0.3 -0.2 0.5", "-0.05 0.1 0.02", "0.1 0.4 -0.3"};

std::string makeTestFrames() {
    return makeOffsetFrame("a", "/ground", frames[0], frames[1]) +
           makeOffsetFrame("b", "/bodyset/one", frames[2], frames[3]);
}

SimTK::Transform toFrame(const SimTK::Vec3& p, const SimTK::Vec3& angles) {
    SimTK::Rotation R;
    R.setRotationToBodyFixedXYZ(angles);
    return {R, p};
}

const SimTK::Transform parentFrame = toFrame({0.1, 0.2, 0.3}, {0.3, -0.2, 0.5});
const SimTK::Transform childFrame = toFrame({-0.05, 0.1, 0.02}, {0.1, 0.4, -0.3});

void expectNear(const SimTK::Transform& a, const SimTK::Transform& b) {
    EXPECT_LT((a.p() - b.p()).norm(), 1e-14);
    EXPECT_LT((a.R().asMat33() - b.R().asMat33()).norm(), 1e-14);
}

/** Simbody's own ellipsoid mobilizer, with x-y-z angles. */
struct SimbodyChain {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    const SimTK::Body::Rigid body{SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1))};
};

TEST(OsimJoints, AnEllipsoidJointIsSimbodysEllipsoid) {
    BuiltSystem built(
        readNew(makeModel(makeJoint("EllipsoidJoint", "j", makeTestFrames(),
                                    "<radii_x_y_z>0.07 0.11 0.05</radii_x_y_z>" + makeCoordinates({"x", "y", "z"})))));
    SimbodyChain chain;
    SimTK::MobilizedBody::Ellipsoid ellipsoid(chain.matter.updGround(), parentFrame, chain.body, childFrame,
                                              SimTK::Vec3(0.07, 0.11, 0.05));
    SimTK::State state = chain.system.realizeTopology();
    chain.matter.setUseEulerAngles(state, true);
    chain.system.realizeModel(state);
    for (const SimTK::Vec3& q : {SimTK::Vec3(0), SimTK::Vec3(0.4, -0.7, 1.1), SimTK::Vec3(-1.2, 0.3, 2.0)}) {
        for (int i = 0; i < 3; ++i) ellipsoid.setOneQ(state, i, q[i]);
        built.set("x", q[0]);
        built.set("y", q[1]);
        built.set("z", q[2]);
        chain.system.realize(state, SimTK::Stage::Position);
        expectNear(built.model.getBody("one").getBodyTransform(built.state), ellipsoid.getBodyTransform(state));
    }
}

/** Seth et al. (2019): ellipsoid with frames turned by a quarter about z, then a pin about the winging axis. */
TEST(OsimJoints, AScapulothoracicJointIsAnEllipsoidAndAPin) {
    BuiltSystem built(
        readNew(makeModel(makeJoint("ScapulothoracicJoint", "j", makeTestFrames(),
                                    "<thoracic_ellipsoid_radii_x_y_z>0.07 0.15 0.08</thoracic_ellipsoid_radii_x_y_z>"
                                    "<scapula_winging_axis_origin>-0.02 0.015</scapula_winging_axis_origin>"
                                    "<scapula_winging_axis_direction>0.48</scapula_winging_axis_direction>" +
                                        makeCoordinates({"abduction", "elevation", "rotation", "winging"})))));
    SimbodyChain chain;
    const SimTK::Transform quarter = toFrame(SimTK::Vec3(0), {0, 0, SimTK::Pi / 2});
    SimTK::MobilizedBody::Ellipsoid gliding(chain.matter.updGround(), parentFrame * quarter, chain.body, quarter,
                                            SimTK::Vec3(0.15, 0.07, 0.08));
    const SimTK::UnitVec3 axis(-std::sin(0.48), std::cos(0.48), 0);
    const SimTK::Transform winging(SimTK::Rotation(axis, SimTK::ZAxis), SimTK::Vec3(-0.02, 0.015, 0));
    SimTK::MobilizedBody::Pin pin(gliding, winging, chain.body, childFrame * winging);
    SimTK::State state = chain.system.realizeTopology();
    chain.matter.setUseEulerAngles(state, true);
    chain.system.realizeModel(state);
    const double q[4] = {0.4, -0.3, 0.7, 0.25};
    const char* names[4] = {"abduction", "elevation", "rotation", "winging"};
    for (int i = 0; i < 3; ++i) gliding.setOneQ(state, i, q[i]);
    pin.setOneQ(state, 0, q[3]);
    for (int i = 0; i < 4; ++i) built.set(names[i], q[i]);
    chain.system.realize(state, SimTK::Stage::Position);
    expectNear(built.model.getBody("one").getBodyTransform(built.state), pin.getBodyTransform(state));
    built.system.realize(built.state, SimTK::Stage::Acceleration);
    EXPECT_TRUE(std::isfinite(built.state.getUDot().norm()));
}

// ---- constraints

/** Two free bodies `one` and `two`, a constraint between them. */
std::string makeConstrained(const std::string& constraint) {
    const auto joint = [](const std::string& name, const std::string& body, const std::string& prefix) {
        return "<FreeJoint name=\"" + name +
               "\"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>" + body +
               "</socket_child_frame><coordinates>" + "<Coordinate name=\"" + prefix + "rx\"/><Coordinate name=\"" +
               prefix + "ry\"/><Coordinate name=\"" + prefix + "rz\"/><Coordinate name=\"" + prefix +
               "x\"/><Coordinate name=\"" + prefix + "y\"/><Coordinate name=\"" + prefix +
               "z\"/></coordinates></FreeJoint>";
    };
    return makeBodySet(makeBody("one") + makeBody("two")) +
           makeJointSet(joint("j1", "/bodyset/one", "a") + joint("j2", "/bodyset/two", "b")) +
           "<ConstraintSet><objects>" + constraint + "</objects></ConstraintSet>";
}

/** Projects a pose that breaks the constraint onto it. */
struct Assembled : BuiltSystem {
    explicit Assembled(const std::string& constraint) : BuiltSystem(readNew(makeConstrained(constraint))) {
        const char* names[] = {"arx", "ary", "arz", "ax", "ay", "az", "brx", "bry", "brz", "bx", "by", "bz"};
        const double values[] = {0.1, 0.2, -0.1, 0, 0.1, 0.05, -0.2, 0.1, 0.3, 0.4, 0.1, -0.1};
        for (int i = 0; i < 12; ++i) model.setCoordinate(state, names[i], values[i]);
        system.realize(state, SimTK::Stage::Position);
        EXPECT_GT(state.getQErr().normInf(), 1e-3) << "the pose should break the constraint";
        system.project(state, 1e-12);
        system.realize(state, SimTK::Stage::Position);
    }
    SimTK::Vec3 find(const char* body, const SimTK::Vec3& station) const {
        return model.calcStationLocation(state, body, station);
    }
};

TEST(OsimConstraints, AWeldHoldsTwoFramesTogether) {
    Assembled weld(
        "<WeldConstraint name=\"w\"><socket_frame1>f</socket_frame1><socket_frame2>/bodyset/two</socket_frame2>"
        "<frames>" +
        makeOffsetFrame("f", "/bodyset/one", "0.1 0 0", "0 0 0.5") + "</frames></WeldConstraint>");
    const SimTK::Transform X_1F = toFrame({0.1, 0, 0}, {0, 0, 0.5});
    const SimTK::Transform held = weld.model.getBody("one").getBodyTransform(weld.state) * X_1F;
    const SimTK::Transform other = weld.model.getBody("two").getBodyTransform(weld.state);
    EXPECT_LT((held.p() - other.p()).norm(), 1e-11);
    EXPECT_LT((held.R().asMat33() - other.R().asMat33()).norm(), 1e-11);
}

TEST(OsimConstraints, APointStaysOnALine) {
    Assembled line(
        "<PointOnLineConstraint name=\"p\"><socket_line_body>/bodyset/one</socket_line_body>"
        "<line_direction_vec>0 2 0</line_direction_vec><point_on_line>0.1 0 0</point_on_line>"
        "<socket_follower_body>/bodyset/two</socket_follower_body><point_on_follower>0 0 0.2</point_on_follower>"
        "</PointOnLineConstraint>");
    const SimTK::Vec3 point =
        line.model.getBody("one").findStationAtGroundPoint(line.state, line.find("two", {0, 0, 0.2}));
    EXPECT_NEAR(point[0], 0.1, 1e-11);
    EXPECT_NEAR(point[2], 0.0, 1e-11);
}

TEST(OsimConstraints, TwoPointsStayAtADistance) {
    Assembled rod(
        "<ConstantDistanceConstraint name=\"d\"><socket_body_1>/bodyset/one</socket_body_1>"
        "<location_body_1>0.1 0 0</location_body_1><socket_body_2>/bodyset/two</socket_body_2>"
        "<location_body_2>0 0.1 0</location_body_2><constant_distance>0.25</constant_distance>"
        "</ConstantDistanceConstraint>");
    EXPECT_NEAR((rod.find("one", {0.1, 0, 0}) - rod.find("two", {0, 0.1, 0})).norm(), 0.25, 1e-11);
}

TEST(OsimConstraints, ACouplerOfTwoCoordinatesFollowsBoth) {
    BuiltSystem built(readNew(
        makeBodySet(makeBody("one")) +
        makeJointSet(makeJoint("BallJoint", "j", makeTestFrames(), makeCoordinates({"q", "r", "s"}))) +
        "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"k\"><independent_coordinate_names>q r"
        "</independent_coordinate_names><dependent_coordinate_name>s</dependent_coordinate_name><scale_factor>2"
        "</scale_factor><coupled_coordinates_function><MultivariatePolynomialFunction><dimension>2</dimension><order>2"
        "</order><coefficients>0.1 0.2 0.3 0.4 0.5 0.6</coefficients></MultivariatePolynomialFunction>"
        "</coupled_coordinates_function></CoordinateCouplerConstraint></objects></ConstraintSet>"));
    const double q = 0.3, r = -0.2;
    built.model.setCoordinate(built.state, "q", q);
    built.model.setCoordinate(built.state, "r", r);
    built.model.setCoordinateSpeed(built.state, "q", 0.7);
    built.model.setCoordinateSpeed(built.state, "r", 1.1);
    built.model.applyCouplers(built.state);
    // The exponents in order: 1, r, r^2, q, q r, q^2.
    const double s = 2 * (0.1 + 0.2 * r + 0.3 * r * r + 0.4 * q + 0.5 * q * r + 0.6 * q * q);
    const double speed = 2 * ((0.4 + 0.5 * r + 1.2 * q) * 0.7 + (0.2 + 0.6 * r + 0.5 * q) * 1.1);
    EXPECT_NEAR(built.model.getCoordinate(built.state, "s"), s, 1e-15);
    EXPECT_NEAR(built.model.getCoordinateSpeed(built.state, "s"), speed, 1e-15);
    built.system.realize(built.state, SimTK::Stage::Velocity);
    EXPECT_LT(built.state.getQErr().normInf(), 1e-14);
    EXPECT_LT(built.state.getUErr().normInf(), 1e-14);
}

// ---- what is not known

const char* const unknownSets =
    "<ForceSet><objects>\n<WindForce name=\"breeze\"/>\n<TurboMuscle "
    "name=\"big\"><GeometryPath/></TurboMuscle></objects>"
    "</ForceSet>\n<ConstraintSet><objects><GlueConstraint name=\"glue\"/></objects></ConstraintSet>\n"
    "<ControllerSet><objects><Brain name=\"brain\"/></objects></ControllerSet>\n<WeatherSet/>\n";

TEST(OsimUnknown, EverythingIsListedAtOnce) {
    try {
        readNew(makePinModel(unknownSets));
        FAIL() << "read";
    } catch (const UnknownElementsError& error) {
        std::map<std::string, Effect> effects;
        for (const UnknownElement& element : error.getElements()) {
            effects[element.type] = element.effect;
            EXPECT_GT(element.line, 1);
            EXPECT_NE(std::string(error.what()).find(":" + std::to_string(element.line) + ": unknown " + element.kind),
                      std::string::npos);
        }
        const std::map<std::string, Effect> expected{{"WindForce", Effect::Forces},
                                                     {"TurboMuscle", Effect::Motion},
                                                     {"GlueConstraint", Effect::Motion},
                                                     {"Brain", Effect::Forces},
                                                     {"WeatherSet", Effect::Motion}};
        EXPECT_EQ(effects, expected);
        const std::string what = error.what();
        EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 4) << what;
    }
}

TEST(OsimUnknown, WhatIsIgnoredByNameOrTypeIsLeftOutAndListed) {
    ReadingOptions options;
    options.ignored = {"breeze", "TurboMuscle", "glue", "brain", "WeatherSet"};
    const ModelDescription model = readOsimText(wrapInDocument(makePinModel(unknownSets), "40000"), "m.osim", options);
    int forces = 0, motions = 0;
    for (const SkippedElements& skipped : model.skipped) {
        if (skipped.reason != "ignored as asked") continue;
        forces += skipped.effect == Effect::Forces;
        motions += skipped.effect == Effect::Motion;
    }
    EXPECT_EQ(forces, 2);
    EXPECT_EQ(motions, 3);
}

TEST(OsimUnknown, ForLengthsForcesWithoutAPathAreNotInTheWay) {
    ReadingOptions options;
    options.lengthsOnly = true;
    try {
        readOsimText(wrapInDocument(makePinModel(unknownSets), "40000"), "m.osim", options);
        FAIL() << "read";
    } catch (const UnknownElementsError& error) {
        for (const UnknownElement& element : error.getElements()) EXPECT_EQ(element.effect, Effect::Motion);
        EXPECT_EQ(error.getElements().size(), 3u);
    }
}

TEST(OsimUnknown, AJointCannotBeIgnored) {
    ReadingOptions options;
    options.ignored = {"j", "HingeJoint"};
    const std::string joint = makeJoint("HingeJoint", "j", makeTestFrames(), makeCoordinates({"q"}));
    EXPECT_THROW(readOsimText(wrapInDocument(makeModel(joint), "40000"), "m.osim", options), UnknownElementsError);
}

}  // namespace
}  // namespace tautline::models::testing
