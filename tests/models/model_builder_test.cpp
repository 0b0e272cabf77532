// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_builder.h"

#include <cmath>

#include "model_test_support.h"
#include "tautline/models/path_points.h"

namespace tautline::models::testing {
namespace {

const std::string atOrigins =
    makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") + makeOffsetFrame("b", "/bodyset/one", "0 0 0", "0 0 0");

/** Two bodies on pins about z: ground - q - one - (1,0,0) - r - two. */
std::string makeChain(const std::string& sets = "", const std::string& first = "", const std::string& second = "") {
    const auto coordinates = [](const std::string& name, const std::string& inside) {
        return "<coordinates><Coordinate name=\"" + name + "\">" + inside + "</Coordinate></coordinates>\n";
    };
    return makeBodySet(makeBody("two") + makeBody("one")) +
           makeJointSet(makeJoint("PinJoint", "second",
                                  makeOffsetFrame("a", "/bodyset/one", "1 0 0", "0 0 0") +
                                      makeOffsetFrame("b", "/bodyset/two", "0 0 0", "0 0 0"),
                                  coordinates("r", second)) +
                        makeJoint("PinJoint", "first", atOrigins, coordinates("q", first))) +
           sets;
}

std::string makeCoupler(const std::string& function, const std::string& scale) {
    return "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"k\">"
           "<coupled_coordinates_function>" +
           function +
           "</coupled_coordinates_function>"
           "<independent_coordinate_names>q</independent_coordinate_names>"
           "<dependent_coordinate_name>r</dependent_coordinate_name><scale_factor>" +
           scale + "</scale_factor></CoordinateCouplerConstraint></objects></ConstraintSet>\n";
}

TEST(BuildMultibody, OrdersTheJointsFromTheGround) {
    BuiltSystem built(readNew(makeChain()));
    EXPECT_EQ(built.matter.getNumBodies(), 3);
    EXPECT_EQ(built.model.getCoordinateNames(), (std::vector<std::string>{"r", "q"}));
    EXPECT_EQ(built.model.getBodyIndex("ground"), SimTK::MobilizedBodyIndex(0));
    EXPECT_EQ(built.model.getBodyIndex("one"), SimTK::MobilizedBodyIndex(1));
    built.set("q", SimTK::Pi / 2);
    built.set("r", SimTK::Pi / 2);
    // Up by one, then the second body points back along -x.
    const SimTK::Vec3 tip = built.model.calcStationLocation(built.state, "two", {0.5, 0, 0});
    EXPECT_LT((tip - SimTK::Vec3(-0.5, 1, 0)).norm(), 1e-15);
    EXPECT_EQ(built.model.getCoordinate(built.state, "q"), SimTK::Pi / 2);
}

TEST(BuildMultibody, DefaultsAndRangesAreKept) {
    BuiltSystem built(readNew(makeChain("",
                                        "<default_value>0.3</default_value>"
                                        "<default_speed_value>2</default_speed_value>"
                                        "<range>-1 2</range><clamped>true</clamped>")));
    EXPECT_EQ(built.model.getCoordinate(built.state, "q"), 0.3);
    EXPECT_EQ(built.model.getCoordinateSpeed(built.state, "q"), 2.0);
    const auto& slot = built.model.getCoordinateSlot("q");
    EXPECT_TRUE(slot.clamped);
    EXPECT_EQ(slot.range, (std::array<double, 2>{-1.0, 2.0}));
    built.set("q", 5.0);
    EXPECT_EQ(built.model.getCoordinate(built.state, "q"), 5.0) << "setting does not clip";
    built.model.setDefaultPose(built.state);
    EXPECT_EQ(built.model.getCoordinate(built.state, "q"), 0.3);
}

TEST(BuildMultibody, UnknownNamesAreRefused) {
    BuiltSystem built(readNew(makeChain()));
    EXPECT_THROW(built.model.getBodyIndex("three"), ModelError);
    EXPECT_THROW(built.model.getCoordinate(built.state, "s"), ModelError);
    EXPECT_THROW(built.model.setCoordinate(built.state, "s", 0.0), ModelError);
}

TEST(BuildMultibody, GravityAndMassGiveThePendulumsAcceleration) {
    std::string text = makePinModel();
    const std::string center = "<mass_center>0 0 0<";
    text.replace(text.find(center), center.size(), "<mass_center>0 -0.5 0<");
    BuiltSystem pendulum(readNew(text));
    pendulum.set("q", 0.4);
    pendulum.system.realize(pendulum.state, SimTK::Stage::Acceleration);
    // Inertia 1 about the mass center, mass 1 at half a metre: -m g l sin q / (I + m l^2).
    EXPECT_NEAR(pendulum.state.getUDot()[0], -9.81 * 0.5 * std::sin(0.4) / 1.25, 1e-14);
}

TEST(BuildMultibody, ALockedCoordinateStaysWhereItIsSet) {
    BuiltSystem built(readNew(makeChain("", "",
                                        "<locked>true</locked>"
                                        "<default_value>0.7</default_value>")));
    EXPECT_EQ(built.model.getCoordinate(built.state, "r"), 0.7);
    for (double held : {0.7, -0.2}) {
        built.set("r", held);
        built.model.setCoordinateSpeed(built.state, "q", 1.0);
        built.system.realize(built.state, SimTK::Stage::Acceleration);
        EXPECT_LT(built.state.getQErr().normInf(), 1e-15);
        EXPECT_LT(std::abs(built.state.getUDot()[1]), 1e-13) << "u of r";
    }
}

TEST(BuildMultibody, ACouplerHoldsItsCoordinates) {
    BuiltSystem built(readNew(
        makeChain(makeCoupler("<PolynomialFunction><coefficients>1 0 0.5</coefficients></PolynomialFunction>", "2"))));
    built.model.setCoordinate(built.state, "q", 0.3);
    built.model.setCoordinateSpeed(built.state, "q", 1.5);
    built.model.applyCouplers(built.state);
    EXPECT_DOUBLE_EQ(built.model.getCoordinate(built.state, "r"), 2 * (0.09 + 0.5));
    EXPECT_DOUBLE_EQ(built.model.getCoordinateSpeed(built.state, "r"), 2 * 0.6 * 1.5);
    built.system.realize(built.state, SimTK::Stage::Acceleration);
    EXPECT_LT(built.state.getQErr().normInf(), 1e-15);
    EXPECT_LT(built.state.getUErr().normInf(), 1e-15);
    // r = 2 q^2 + 1, so r'' = 4 q q'' + 4 q'^2. The order of u is that of the tree: q, r.
    const SimTK::Vector& accelerations = built.state.getUDot();
    EXPECT_NEAR(accelerations[1], 4 * 0.3 * accelerations[0] + 4 * 1.5 * 1.5, 1e-12);
}

TEST(BuildMultibody, APrescribedMotionFollowsTime) {
    BuiltSystem built(
        readNew(makeChain("",
                          "<prescribed>true</prescribed><prescribed_function><PolynomialFunction><coefficients>"
                          "3 2 1</coefficients></PolynomialFunction></prescribed_function>")));
    built.state.setTime(0.5);
    built.model.setCoordinate(built.state, "q", 3 * 0.25 + 2 * 0.5 + 1);
    built.model.setCoordinateSpeed(built.state, "q", 6 * 0.5 + 2);
    built.system.realize(built.state, SimTK::Stage::Acceleration);
    EXPECT_LT(built.state.getQErr().normInf(), 1e-15);
    EXPECT_LT(built.state.getUErr().normInf(), 1e-15);
    EXPECT_NEAR(built.state.getUDot()[0], 6.0, 1e-12);
}

std::string makeDriven(const std::string& name, double omega) {
    return "<Coordinate name=\"" + name + "\"><prescribed>true</prescribed><prescribed_function><Sine><omega>" +
           std::to_string(omega) + "</omega></Sine></prescribed_function></Coordinate>";
}

/** ground - `one` by a planar joint with the coordinates turn, x, y; the last is driven only if asked for. */
std::string makePlanarModel(bool isAllDriven) {
    return makeBodySet(makeBody("one")) +
           makeJointSet(makeJoint("PlanarJoint", "planar",
                                  makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") +
                                      makeOffsetFrame("b", "/bodyset/one", "0 0 0", "0 0 0"),
                                  "<coordinates>" + makeDriven("turn", 1) + makeDriven("x", 2) +
                                      (isAllDriven ? makeDriven("y", 3) : "<Coordinate name=\"y\"/>") +
                                      "</coordinates>"));
}

/** Largest difference between the driven coordinates and their functions over a simulated second. */
double calcDrivingError(bool isAllDriven) {
    BuiltSystem built(readNew(makePlanarModel(isAllDriven)));
    EXPECT_EQ(built.matter.getNumConstraints(), isAllDriven ? 0 : 2);
    SimTK::RungeKuttaMersonIntegrator integrator(built.system);
    integrator.setAccuracy(1e-6);
    SimTK::TimeStepper stepper(built.system, integrator);
    stepper.initialize(built.state);
    double error = 0;
    for (int step = 1; step <= 20; ++step) {
        stepper.stepTo(0.05 * step);
        const SimTK::State& state = integrator.getState();
        const double t = state.getTime();
        error = std::max({error, std::abs(built.model.getCoordinate(state, "turn") - std::sin(t)),
                          std::abs(built.model.getCoordinate(state, "x") - std::sin(2 * t)),
                          std::abs(built.model.getCoordinateSpeed(state, "x") - 2 * std::cos(2 * t))});
        const double fall = -0.5 * 9.81 * t * t;
        EXPECT_NEAR(built.model.getCoordinate(state, "y"), isAllDriven ? std::sin(3 * t) : fall, 1e-5);
    }
    return error;
}

TEST(BuildMultibody, AJointWhoseCoordinatesAreAllPrescribedIsDrivenExactly) {
    EXPECT_LT(calcDrivingError(true), 1e-15);
}

TEST(BuildMultibody, PrescribedCoordinatesAmongFreeOnesAreDrivenToTheIntegratorsAccuracy) {
    EXPECT_LT(calcDrivingError(false), 1e-5);
}

TEST(BuildMultibody, TheDefaultPoseOfADrivenCoordinateIsThatOfTheTime) {
    BuiltSystem built(readNew(makePlanarModel(true)));
    built.state.setTime(0.4);
    built.model.setDefaultPose(built.state);
    EXPECT_EQ(built.model.getCoordinate(built.state, "y"), std::sin(3 * 0.4));
    EXPECT_EQ(built.model.getCoordinateSpeed(built.state, "y"), 3 * std::cos(3 * 0.4));
}

TEST(BuildMultibody, APointConstraintTiesTwoBodies) {
    BuiltSystem built(
        readNew(makeChain("<ConstraintSet><objects><PointConstraint name=\"k\"><socket_body_1>/ground</socket_body_1>"
                          "<socket_body_2>/bodyset/two</socket_body_2><location_body_1>1 1 0</location_body_1>"
                          "<location_body_2>1 0 0</location_body_2></PointConstraint></objects></ConstraintSet>")));
    built.set("r", SimTK::Pi / 2);
    EXPECT_LT(built.state.getQErr().normInf(), 1e-15);
    built.set("r", 0.0);
    EXPECT_GT(built.state.getQErr().normInf(), 0.5);
}

TEST(PathPoints, ConditionalPointsCountWithinTheirRange) {
    const std::string muscle =
        "<ForceSet><objects><Thelen2003Muscle name=\"m\"><GeometryPath><PathPointSet><objects>"
        "<PathPoint><body>ground</body><location>0 1 0</location></PathPoint>"
        "<ConditionalPathPoint><body>ground</body><location>1 1 0</location>"
        "<coordinate>q</coordinate><range>0 1</range></ConditionalPathPoint>"
        "<PathPoint><body>ground</body><location>1 0 0</location></PathPoint>"
        "</objects></PathPointSet></GeometryPath><max_isometric_force>1</max_isometric_force>"
        "<optimal_fiber_length>1</optimal_fiber_length><tendon_slack_length>1"
        "</tendon_slack_length></Thelen2003Muscle></objects></ForceSet>";
    BuiltSystem built(readNew(makePinModel(muscle)));
    const MusclePath& path = built.description.muscles[0].path;
    const auto lengthAt = [&](double q) {
        built.set("q", q);
        return calcPolygonLength(path, built.model, built.state);
    };
    EXPECT_DOUBLE_EQ(lengthAt(0.5), 2.0);
    EXPECT_DOUBLE_EQ(lengthAt(-0.9e-5), 2.0) << "a little room at the ends";
    EXPECT_DOUBLE_EQ(lengthAt(1 + 0.9e-5), 2.0);
    EXPECT_DOUBLE_EQ(lengthAt(-1.1e-5), std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(lengthAt(2.0), std::sqrt(2.0));
}

TEST(PathPoints, MovingPointsStopAtTheRangeOfTheirCoordinate) {
    std::string text = makePinModel(
        "<ForceSet><objects><Thelen2003Muscle name=\"m\"><GeometryPath><PathPointSet><objects>"
        "<PathPoint><body>ground</body><location>0 0 0</location></PathPoint>"
        "<MovingPathPoint><body>ground</body><x_coordinate>q</x_coordinate>"
        "<y_coordinate>q</y_coordinate><z_coordinate>q</z_coordinate><x_location><LinearFunction>"
        "<coefficients>2 1</coefficients></LinearFunction></x_location></MovingPathPoint>"
        "</objects></PathPointSet></GeometryPath><max_isometric_force>1</max_isometric_force>"
        "<optimal_fiber_length>1</optimal_fiber_length><tendon_slack_length>1"
        "</tendon_slack_length></Thelen2003Muscle></objects></ForceSet>");
    const std::string plain = "<Coordinate name=\"q\"/>";
    text.replace(text.find(plain), plain.size(), "<Coordinate name=\"q\"><range>0 1</range></Coordinate>");
    BuiltSystem built(readNew(text));
    const PlacedPoint point(built.description.muscles[0].path.points[1], built.model);
    const double expected[][2] = {{0.5, 2.0}, {-3.0, 1.0}, {4.0, 3.0}};
    for (const auto& [q, x] : expected) {
        built.set("q", q);
        EXPECT_EQ(point.calcStation(built.state), SimTK::Vec3(x, 0, 0));
    }
}

}  // namespace
}  // namespace tautline::models::testing
