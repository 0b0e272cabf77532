// SPDX-License-Identifier: Apache-2.0
/** Forces that models carry, each against its published law written out here, or against the slope of its energy. */
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "model_test_support.h"
#include "tautline/models/external_loads.h"
#include "tautline/models/model_system.h"

namespace tautline::models::testing {
namespace {

/** ground - `one` by a slider along x with coordinate q, and forces. */
std::string makeSlider(const std::string& forces, const std::string& sets = "") {
    return makeBodySet(makeBody("one")) +
           makeJointSet(makeJoint("SliderJoint", "slide",
                                  makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") +
                                      makeOffsetFrame("b", "/bodyset/one", "0 0 0", "0 0 0"),
                                  makeCoordinates({"q"}))) +
           sets + "<ForceSet><objects>" + forces + "</objects></ForceSet>";
}

/** From (-1, 0, 0) on ground to the body: 1 + q long. */
const std::string straightPath =
    "<GeometryPath><PathPointSet><objects>"
    "<PathPoint name=\"a\"><socket_parent_frame>/ground</socket_parent_frame><location>-1 0 0</location></PathPoint>"
    "<PathPoint name=\"b\"><socket_parent_frame>/bodyset/one</socket_parent_frame><location>0 0 "
    "0</location></PathPoint>"
    "</objects></PathPointSet></GeometryPath>";

/** A model whose only coordinate is q, with the generalized force of all its forces but gravity. */
struct ForcedModel {
    explicit ForcedModel(const std::string& content)
        : model(readOsimText(wrapInDocument(content, "40500"), "f.osim")), state(model.makeDefaultState()) {}

    /** The whole force on q: mass times acceleration, the mass being 1, or the inertia about z. */
    double calcForce(double q, double u, double inertia = 1.0, double time = 0.0) {
        realize(q, u, time, SimTK::Stage::Acceleration);
        return state.getUDot()[0] * inertia;
    }
    double calcEnergy(double q) {
        realize(q, 0.0, 0.0, SimTK::Stage::Dynamics);
        return model.getSystem().calcPotentialEnergy(state);
    }
    void realize(double q, double u, double time, SimTK::Stage stage) {
        state.setTime(time);
        model.getModel().setCoordinate(state, "q", q);
        model.getModel().setCoordinateSpeed(state, "q", u);
        model.getSystem().realize(state, stage);
    }
    /** -dE/dq by central differences. */
    double calcSlope(double q) {
        const double h = 1e-5;
        return -(calcEnergy(q + h) - calcEnergy(q - h)) / (2 * h);
    }

    ModelSystem model;
    SimTK::State state;
};

/** 10 x^3 - 15 x^4 + 6 x^5 between 0 and 1. */
double calcStep(double x) {
    x = std::min(std::max(x, 0.0), 1.0);
    return x * x * x * (10 - 15 * x + 6 * x * x);
}

TEST(ModelForces, ALimitForceSetsInBeyondItsLimits) {
    ForcedModel limited(
        makeSlider("<CoordinateLimitForce name=\"f\"><coordinate>q</coordinate><upper_limit>0.2</upper_limit>"
                   "<upper_stiffness>50</upper_stiffness><lower_limit>-0.1</lower_limit>"
                   "<lower_stiffness>30</lower_stiffness><damping>0.4</damping><transition>0.05</transition>"
                   "</CoordinateLimitForce>"));
    for (const double q : {-0.3, -0.13, -0.05, 0.0, 0.19, 0.22, 0.24, 0.4}) {
        const double above = calcStep((q - 0.2) / 0.05), below = calcStep((-0.1 - q) / 0.05), u = 0.7;
        const double force = -50 * above * (q - 0.2) + 30 * below * (-0.1 - q) - 0.4 * (above + below) * u;
        EXPECT_NEAR(limited.calcForce(q, u), force, 1e-12) << q;
        EXPECT_NEAR(limited.calcForce(q, 0), limited.calcSlope(q), 1e-7) << q;
    }
}

TEST(ModelForces, ALimitOfAnAngleIsGivenInDegrees) {
    ForcedModel limited(
        makePinModel("<ForceSet><objects><CoordinateLimitForce name=\"f\"><coordinate>q</coordinate>"
                     "<upper_limit>30</upper_limit><upper_stiffness>2</upper_stiffness><lower_limit>-200"
                     "</lower_limit><lower_stiffness>1</lower_stiffness><damping>0.1</damping>"
                     "<transition>1</transition></CoordinateLimitForce></objects></ForceSet>"));
    const double degree = SimTK::Pi / 180, u = 0.3;
    EXPECT_NEAR(limited.calcForce(40 * degree, u), -2 * 10 - 0.1 / degree * u, 1e-11);
}

TEST(ModelForces, ASpringOnACoordinate) {
    ForcedModel spring(
        makeSlider("<SpringGeneralizedForce name=\"f\"><coordinate>q</coordinate><stiffness>7</stiffness>"
                   "<rest_length>0.3</rest_length><viscosity>0.5</viscosity></SpringGeneralizedForce>"));
    EXPECT_NEAR(spring.calcForce(0.5, 2.0), -7 * 0.2 - 0.5 * 2.0, 1e-13);
    EXPECT_NEAR(spring.calcForce(0.5, 0.0), spring.calcSlope(0.5), 1e-8);
}

TEST(ModelForces, ABushingPullsFramesTogether) {
    ForcedModel bushing(makeSlider(
        "<BushingForce name=\"f\"><socket_frame1>/ground</socket_frame1><socket_frame2>g</socket_frame2><frames>" +
        makeOffsetFrame("g", "/bodyset/one", "0.1 0 0", "0 0 0") +
        "</frames><rotational_stiffness>1 2 3</rotational_stiffness><translational_stiffness>40 50 60"
        "</translational_stiffness><rotational_damping>0 0 0</rotational_damping><translational_damping>2 0 0"
        "</translational_damping></BushingForce>"));
    EXPECT_NEAR(bushing.calcForce(0.2, 0.5), -40 * 0.3 - 2 * 0.5, 1e-12);
}

TEST(ModelForces, APointToPointSpring) {
    ForcedModel spring(
        makeSlider("<PointToPointSpring name=\"f\"><socket_body1>/ground</socket_body1><socket_body2>"
                   "/bodyset/one</socket_body2><point1>0 0.3 0</point1><point2>0 0 0</point2><stiffness>20"
                   "</stiffness><rest_length>0.1</rest_length></PointToPointSpring>"));
    const double q = 0.4, length = std::hypot(q, 0.3);
    EXPECT_NEAR(spring.calcForce(q, 0.0), -20 * (length - 0.1) * q / length, 1e-12);
}

TEST(ModelForces, AnActuatorFollowsItsController) {
    const std::string controller =
        "<ControllerSet><objects><PrescribedController name=\"c\"><actuator_list>/forceset/motor</actuator_list>"
        "<ControlFunctions><objects><LinearFunction><coefficients>2 0.1</coefficients></LinearFunction></objects>"
        "</ControlFunctions></PrescribedController></objects></ControllerSet>";
    ForcedModel motor(
        makeSlider("<CoordinateActuator name=\"motor\"><coordinate>q</coordinate><optimal_force>5"
                   "</optimal_force><min_control>-1</min_control><max_control>1</max_control>"
                   "</CoordinateActuator>",
                   controller));
    EXPECT_NEAR(motor.calcForce(0, 0, 1.0, 0.2), 5 * 0.5, 1e-14);
    EXPECT_NEAR(motor.calcForce(0, 0, 1.0, 3.0), 5 * 1.0, 1e-14) << "clipped to max_control";
}

TEST(ModelForces, AnActivationFollowsItsControlExponentially) {
    const std::string controller =
        "<ControllerSet><objects><PrescribedController name=\"c\"><actuator_list>motor</actuator_list>"
        "<ControlFunctions><objects><Constant><value>0.9</value></Constant></objects></ControlFunctions>"
        "</PrescribedController></objects></ControllerSet>";
    ForcedModel motor(
        makeSlider("<ActivationCoordinateActuator name=\"motor\"><coordinate>q</coordinate>"
                   "<optimal_force>0.01</optimal_force><activation_time_constant>0.05"
                   "</activation_time_constant><default_activation>0.2</default_activation>"
                   "</ActivationCoordinateActuator>",
                   controller));
    SimTK::RungeKuttaMersonIntegrator integrator(motor.model.getSystem());
    integrator.setAccuracy(1e-9);
    SimTK::TimeStepper stepper(motor.model.getSystem(), integrator);
    stepper.initialize(motor.state);
    stepper.stepTo(0.1);
    const double activation = 0.9 + (0.2 - 0.9) * std::exp(-0.1 / 0.05);
    motor.model.getSystem().realize(stepper.getState(), SimTK::Stage::Acceleration);
    EXPECT_NEAR(stepper.getState().getUDot()[0], 0.01 * activation, 1e-9);
}

TEST(ModelForces, ALigamentPullsByItsCurve) {
    ForcedModel ligament(
        makeSlider("<Ligament name=\"l\">" + straightPath +
                   "<resting_length>0.9</resting_length><pcsa_force>10</pcsa_force><force_length_curve>"
                   "<PiecewiseLinearFunction><x>0.5 1 1.5</x><y>0 0 2</y></PiecewiseLinearFunction>"
                   "</force_length_curve></Ligament>"));
    const double q = 0.05, curve = 4 * ((1 + q) / 0.9 - 1);
    EXPECT_NEAR(ligament.calcForce(q, 0.0), -10 * curve, 1e-12);
    EXPECT_EQ(ligament.calcForce(-0.2, 0.0), 0.0) << "shorter than at rest";
}

TEST(ModelForces, ABlankevoortLigamentHasAToeAndALine) {
    ForcedModel ligament(
        makeSlider("<Blankevoort1991Ligament name=\"l\">" + straightPath +
                   "<linear_stiffness>300</linear_stiffness><transition_strain>0.06</transition_strain>"
                   "<damping_coefficient>0.2</damping_coefficient><slack_length>0.8</slack_length>"
                   "</Blankevoort1991Ligament>"));
    for (const double strain : {-0.1, 0.004, 0.03, 0.059, 0.1}) {
        const double q = 0.8 * (1 + strain) - 1, u = 0.5;
        double force = 0.0;
        if (strain > 0) force = strain < 0.06 ? 300 * strain * strain / 0.12 : 300 * (strain - 0.03);
        const double damped = strain > 0 ? force + 0.2 * u / 0.8 * calcStep(strain / 0.01) : 0.0;
        EXPECT_NEAR(ligament.calcForce(q, 0.0), -force, 1e-11) << strain;
        EXPECT_NEAR(ligament.calcForce(q, u), -damped, 1e-11) << strain;
        EXPECT_NEAR(ligament.calcForce(q, -u), -force, 1e-11) << "not damped while it shortens";
        EXPECT_NEAR(ligament.calcForce(q, 0.0), ligament.calcSlope(q), 1e-6) << strain;
    }
}

TEST(ModelForces, APathActuatorPullsByItsControl) {
    const std::string controller =
        "<ControllerSet><objects><PrescribedController name=\"c\"><actuator_list>rope</actuator_list><ControlFunctions>"
        "<objects><Constant><value>0.25</value></Constant></objects></ControlFunctions></PrescribedController></"
        "objects>"
        "</ControllerSet>";
    ForcedModel rope(makeSlider(
        "<PathActuator name=\"rope\">" + straightPath + "<optimal_force>8</optimal_force></PathActuator>", controller));
    EXPECT_NEAR(rope.calcForce(0.1, 0.0), -2.0, 1e-14);
}

TEST(ModelForces, AMuscleOfATypeWithoutAModelHasALengthAndNoForce) {
    ForcedModel muscle(makeSlider("<Millard2012AccelerationMuscle name=\"m\">" + straightPath +
                                  "<damping>0.05</damping></Millard2012AccelerationMuscle>"));
    EXPECT_EQ(muscle.calcForce(0.1, 0.0), 0.0);
    EXPECT_NEAR(muscle.model.getPathForces().at(0).cable.getLength(muscle.state), 1.1, 1e-15);
}

// ---- contact

const std::string contactGeometry =
    "<ContactGeometrySet><objects><ContactHalfSpace name=\"wall\"><socket_frame>/ground</socket_frame><location>0 0 0"
    "</location><orientation>0 3.14159265358979312 0</orientation></ContactHalfSpace><ContactSphere name=\"ball\">"
    "<socket_frame>/bodyset/one</socket_frame><location>0 0 0</location><radius>0.1</radius></ContactSphere></objects>"
    "</ContactGeometrySet>";

/** Hunt and Crossley between two surfaces of one stiffness k and dissipation c: with k/2 and c for the pair,
(4/3) k_pair sqrt(R k_pair) x^(3/2) (1 + 3/2 c v), where Simbody takes the stiffness to the power 2/3. The half space is
x < 0, so that a sphere at q meets it where q < R. */
TEST(ModelForces, ASphereBouncesOffAHalfSpaceByHuntAndCrossley) {
    ForcedModel ball(
        makeSlider("<HuntCrossleyForce name=\"contact\"><HuntCrossleyForce::ContactParametersSet><objects>"
                   "<HuntCrossleyForce::ContactParameters><geometry>wall ball</geometry><stiffness>1e5"
                   "</stiffness><dissipation>0.5</dissipation></HuntCrossleyForce::ContactParameters>"
                   "</objects></HuntCrossleyForce::ContactParametersSet></HuntCrossleyForce>",
                   contactGeometry));
    const double x = 0.01, v = 0.2, k = 0.5 * std::pow(1e5, 2.0 / 3.0);
    const double force = 4.0 / 3.0 * k * x * std::sqrt(0.1 * k * x) * (1 + 1.5 * 0.5 * v);
    EXPECT_NEAR(ball.calcForce(0.1 - x, -v), force, 1e-9 * force);
    EXPECT_EQ(ball.calcForce(0.11, 0.0), 0.0);
}

TEST(ModelForces, ASmoothedSphereComesNearTheSharpOne) {
    ForcedModel ball(
        makeSlider("<SmoothSphereHalfSpaceForce name=\"contact\"><socket_sphere>ball</socket_sphere>"
                   "<socket_half_space>wall</socket_half_space><stiffness>1e5</stiffness><dissipation>0.5"
                   "</dissipation></SmoothSphereHalfSpaceForce>",
                   contactGeometry));
    const double x = 0.01, k = 0.5 * std::pow(1e5, 2.0 / 3.0);
    // The published smoothing of Hertz's force, without speed.
    const double hertz = 4.0 / 3.0 * k * std::sqrt(0.1 * k) * std::pow(x * x + 1e-5, 0.75);
    const double v = 0.0, damping = (1 + 1.5 * 0.5 * v);
    const double smooth = hertz * (0.5 + 0.5 * std::tanh(300 * x)) * damping;
    const double faded = smooth * (0.5 + 0.5 * std::tanh(50 * (v + 2 / (3 * 0.5))));
    EXPECT_NEAR(ball.calcForce(0.1 - x, 0.0), faded, 1e-6 * faded);
    EXPECT_LT(std::abs(ball.calcForce(0.3, 0.0)), 1e-9);
}

// ---- external loads

/** A file in the folder of temporary files, removed at the end. */
struct TemporaryFile {
    explicit TemporaryFile(const std::string& text)
        : path(std::filesystem::temp_directory_path() / ("tautline_loads_" + std::to_string(getpid()) + ".xml")) {
        std::ofstream(path) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    std::filesystem::path path;
};

const std::string groundReaction =
    "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"loads\"><objects>\n<ExternalForce name=\"push\">"
    "<applied_to_body>one</applied_to_body><force_expressed_in_body>ground</force_expressed_in_body>"
    "<point_expressed_in_body>ground</point_expressed_in_body><force_identifier>plate_v</force_identifier>"
    "<point_identifier>plate_p</point_identifier><torque_identifier>plate_m</torque_identifier></ExternalForce>"
    "</objects><datafile>plate.mot</datafile></ExternalLoads></OpenSimDocument>";

/** One revolute body of unit inertia: its acceleration is the moment about z over the inertia about the pin. */
TEST(ModelForces, AnExternalLoadActsAtItsPointInGround) {
    const TemporaryFile file(groundReaction);
    const ModelDescription description = readNew(makePinModel());
    const ExternalLoads loads = readExternalLoads(file.path, description);
    EXPECT_EQ(loads.dataFile, "plate.mot");
    ASSERT_EQ(loads.forces.size(), 1u);
    ModelSystem model(description);
    const TimeSeries data{{"time", "plate_vx", "plate_vy", "plate_vz", "plate_px", "plate_py", "plate_pz", "plate_mx",
                           "plate_my", "plate_mz"},
                          {{0, 1, 2, 0, 0.1, 0.2, 0, 0, 0, 0.5}, {1, 3, 2, 0, 0.3, 0.2, 0, 0, 0, 0.5}}};
    addExternalLoads(loads, data, model.getModel(), model.updForces());
    SimTK::State state = model.makeDefaultState();
    for (const double time : {-1.0, 0.0, 0.25, 1.0, 7.0}) {
        state.setTime(time);
        model.getModel().setCoordinate(state, "q", 0.4);
        model.getSystem().realize(state, SimTK::Stage::Acceleration);
        const double share = std::min(std::max(time, 0.0), 1.0);
        const double fx = 1 + 2 * share, fy = 2, px = 0.1 + 0.2 * share, py = 0.2;
        EXPECT_NEAR(state.getUDot()[0], px * fy - py * fx + 0.5, 1e-13) << time;
    }
}

TEST(ModelForces, AnExternalLoadWithoutItsColumnsIsRefused) {
    const TemporaryFile file(groundReaction);
    const ModelDescription description = readNew(makePinModel());
    ModelSystem model(description);
    const TimeSeries data{{"time", "plate_vx", "plate_vy"}, {{0, 1, 2}}};
    try {
        addExternalLoads(readExternalLoads(file.path, description), data, model.getModel(), model.updForces());
        FAIL() << "not refused";
    } catch (const ModelError& error) {
        EXPECT_NE(
            std::string(error.what()).find(":2: ExternalForce 'push': 2 columns begin with 'plate_v' instead of 3"),
            std::string::npos)
            << error.what();
    }
}

// ---- paths by functions

TEST(ModelForces, APathByFunctionsIsEvaluatedAndDoesNotPull) {
    ForcedModel fitted(makeSlider(
        "<PathSpring name=\"s\"><FunctionBasedPath name=\"path\"><coordinate_paths>/jointset/slide/q</coordinate_paths>"
        "<length_function><PolynomialFunction><coefficients>3 2 1</coefficients></PolynomialFunction></length_function>"
        "</FunctionBasedPath><resting_length>0.1</resting_length><stiffness>10</stiffness><dissipation>0</dissipation>"
        "</PathSpring>"));
    const double q = 0.3, u = 1.7;
    EXPECT_EQ(fitted.calcForce(q, u), 0.0);
    const FunctionBasedPath& path = fitted.model.getFunctionPaths().at(0).function;
    EXPECT_NEAR(path.calcLength(fitted.state), 3 * q * q + 2 * q + 1, 1e-15);
    EXPECT_NEAR(path.calcMomentArms(fitted.state).at(0), -(6 * q + 2), 1e-14);
    EXPECT_NEAR(path.calcLengthRate(fitted.state), (6 * q + 2) * u, 1e-14);
}

}  // namespace
}  // namespace tautline::models::testing
