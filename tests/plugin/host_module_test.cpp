// SPDX-License-Identifier: Apache-2.0
/** libtautline_plugin.so as a host sees it: what it attaches, what it refuses, and that it goes when it is unloaded. */
#include <Simbody.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "support/run_program.h"
#include "tautline/muscles/millard_2012.h"
#include "tautline/muscles/thelen_2003.h"
#include "tautline/plugin.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/muscle.h"
#include "tautline/surfaces/cylinder.h"

namespace {

using namespace SimTK;

/** The module, loaded as a host loads it. */
class HostModule : public ::testing::Test {
protected:
    HostModule() : m_module(dlopen(TAUTLINE_MODULE, RTLD_NOW)) {
        EXPECT_NE(m_module, nullptr) << dlerror();
        m_open = reinterpret_cast<tautline_plugin_open_function>(dlsym(m_module, TAUTLINE_PLUGIN_OPEN));
        const tautline_host host = TAUTLINE_HOST;
        EXPECT_EQ(m_open(&host, &tautline, &error), TAUTLINE_OK) << error.message;
    }
    ~HostModule() override { dlclose(m_module); }

    tautline_error error{};
    const tautline_plugin* tautline = nullptr;
    tautline_plugin_open_function m_open = nullptr;

private:
    void* m_module;
};

/** A pendulum and the ground. */
struct Pendulum {
    MultibodySystem system;
    SimbodyMatterSubsystem matter{system};
    GeneralForceSubsystem forces{system};
    MobilizedBody::Pin bob{matter.Ground(), Vec3(0), SimTK::Body::Rigid(MassProperties(2, Vec3(0), UnitInertia(0.01))),
                           Vec3(0, 0.5, 0)};
};

/** A force between the ground and a body, over a ball that hangs on the ground. */
std::string describe(const std::string& type, const std::string& body, const std::string& parameters) {
    return "<TautlineForces>\n<Ground><WrapObjectSet><objects><WrapSphere name='ball'><radius>0.1</radius>"
           "<translation>0 0.1 0</translation></WrapSphere></objects></WrapObjectSet></Ground>\n"
           "<ForceSet><objects>\n<" +
           type +
           " name='string'><GeometryPath><PathPointSet><objects>\n"
           "<PathPoint name='a'><socket_parent_frame>ground</socket_parent_frame><location>0.02 0.4 "
           "0.01</location></PathPoint>\n"
           "<PathPoint name='b'><socket_parent_frame>" +
           body +
           "</socket_parent_frame><location>0.03 0.2 0</location></PathPoint>\n"
           "</objects></PathPointSet><PathWrapSet><objects><PathWrap name='w'><wrap_object>ball</wrap_object>"
           "</PathWrap></objects></PathWrapSet></GeometryPath>" +
           parameters + "</" + type + ">\n</objects></ForceSet></TautlineForces>\n";
}

std::string describeTension(const std::string& body = "1") {
    return describe("TautlinePrescribedTension", body, "<tension>5</tension>");
}

/** printf into a string. */
void append(std::string& text, const char* format, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text += line;
}

/** plugin/examples/host.cpp, built through Tautline::simbody. */
std::string simulateTwin() {
    Pendulum pendulum;
    Force::Gravity(pendulum.forces, pendulum.matter, -YAxis, 9.81);
    tautline::CablePathSubsystem cables(pendulum.system);
    const MobilizedBody& ground = pendulum.matter.Ground();
    tautline::Cable front(cables, ground, Vec3(0.02, 0.25, 0), pendulum.bob, Vec3(0.02, 0.3, 0), "front");
    front.addObstacle(ground, SimTK::Transform(), std::make_shared<tautline::Cylinder>(0.04),
                      tautline::PassOnSide{tautline::Vector3(1, 0, 0)}, "drum");
    const auto setSizes = [](auto parameters) {
        parameters.maxIsometricForce = 300;
        parameters.optimalFiberLength = 0.15;
        parameters.tendonSlackLength = 0.3;
        return parameters;
    };
    using namespace tautline;
    tautline::Muscle frontMuscle(pendulum.forces, front,
                                 std::make_shared<Millard2012>(setSizes(Millard2012Parameters())));
    Cable back(cables, ground, SimTK::Vec3(-0.1, 0.25, 0), pendulum.bob, SimTK::Vec3(-0.02, 0.3, 0), "back");
    tautline::Muscle backMuscle(pendulum.forces, back, std::make_shared<Thelen2003>(setSizes(Thelen2003Parameters())));
    frontMuscle.setExcitationFunction([](const State& state) { return state.getTime() < 0.5 ? 0.4 : 0.1; });

    State state = pendulum.system.realizeTopology();
    backMuscle.setExcitation(state, 0.2);
    pendulum.system.realize(state, Stage::Position);
    frontMuscle.equilibrate(state);
    backMuscle.equilibrate(state);
    RungeKuttaMersonIntegrator integrator(pendulum.system);
    integrator.setAccuracy(1e-6);
    TimeStepper stepper(pendulum.system, integrator);
    stepper.initialize(state);
    std::string told;
    for (int i = 1; i <= 4; ++i) {
        stepper.stepTo(0.25 * i);
        const State& now = stepper.getState();
        pendulum.system.realize(now, Stage::Velocity);
        append(told, "t = %.2f s: angle %.17g rad\n", now.getTime(), pendulum.bob.getAngle(now));
        for (const tautline::Muscle* muscle : {&frontMuscle, &backMuscle})
            append(told, "    %s: length %.17g m, rate %.17g m/s, tension %.17g N, moment arm %.17g m\n",
                   muscle == &frontMuscle ? "front" : "back", muscle->getCable().getLength(now),
                   muscle->getCable().getLengthRate(now), muscle->getTension(now),
                   muscle->getCable().calcMomentArm(now, pendulum.bob, MobilizerUIndex(0)));
    }
    return told;
}

TEST_F(HostModule, ExampleAgreesWithTheSameSceneInTheAdapterBitForBit) {
    std::string output;
    ASSERT_EQ(tautline::testing::runProgram(TAUTLINE_HOST_EXAMPLE " " TAUTLINE_MODULE, output), 0) << output;
    EXPECT_EQ(output, simulateTwin());
}

TEST_F(HostModule, IsLoadedBySimbodysPluginClass) {
    Plugin plugin;
    ASSERT_TRUE(plugin.load(TAUTLINE_MODULE)) << plugin.getLastErrorMessage();
    std::string message;
    const auto open = reinterpret_cast<tautline_plugin_open_function>(
        Plugin::getSymbolAddress(dlopen(TAUTLINE_MODULE, RTLD_NOW | RTLD_NOLOAD), TAUTLINE_PLUGIN_OPEN, message));
    ASSERT_NE(open, nullptr) << message;
    const tautline_host host = TAUTLINE_HOST;
    const tautline_plugin* table = nullptr;
    EXPECT_EQ(open(&host, &table, &error), TAUTLINE_OK);
    dlclose(dlopen(TAUTLINE_MODULE, RTLD_NOW | RTLD_NOLOAD));
    dlclose(dlopen(TAUTLINE_MODULE, RTLD_NOW | RTLD_NOLOAD));
}

TEST_F(HostModule, RefusesAHostOfAnotherNumber) {
    tautline_host host = TAUTLINE_HOST;
    host.abi = 7;
    const tautline_plugin* table = nullptr;
    EXPECT_EQ(m_open(&host, &table, &error), TAUTLINE_WRONG_ABI);
    EXPECT_STREQ(error.message, "the host was built for number 7 of tautline/plugin.h, the module for 1");
    EXPECT_EQ(table, nullptr);
}

TEST_F(HostModule, RefusesAnotherSimbodyAndAnotherLayoutOfIt) {
    tautline_host host = TAUTLINE_HOST;
    const tautline_plugin* table = nullptr;
    host.simbody_version[0] = 3;
    host.simbody_version[1] = 9;
    EXPECT_EQ(m_open(&host, &table, &error), TAUTLINE_WRONG_SIMBODY);
    EXPECT_EQ(std::string(error.message),
              std::string("the host's is Simbody 3.9, but the module was built for ") + tautline->simbody_version);
    host = TAUTLINE_HOST;
    host.keeps_asserts = 1 - host.keeps_asserts;
    EXPECT_EQ(m_open(&host, &table, &error), TAUTLINE_WRONG_SIMBODY);
    EXPECT_NE(std::string(error.message).find("NDEBUG"), std::string::npos) << error.message;
    EXPECT_EQ(m_open(nullptr, &table, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(m_open(nullptr, nullptr, nullptr), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(table, nullptr);
}

/** A text that is refused, with the line and a part of the message. */
struct RefusedText {
    const char* what;
    std::string text;
    int line;
    const char* message;
};

TEST_F(HostModule, RefusesADescriptionByItsLineAndLeavesTheSystemAlone) {
    const RefusedText cases[] = {
        {"not XML", "<TautlineForces>\n<ForceSet>\n", 2, "host.xml:2: not well-formed XML"},
        {"another document", "<OpenSimDocument/>", 1, "the document is <OpenSimDocument>, not <TautlineForces>"},
        {"unknown body", describeTension("femur"), 6,
         "there is no body or frame 'femur', the socket_parent_frame of PathPoint 'b'"},
        {"body out of range", describeTension("2"), 6, "there is no body or frame '2'"},
        {"wrap objects of an unknown body",
         "<TautlineForces>\n<BodySet><objects>\n<Body name='tibia'/></objects></BodySet></TautlineForces>", 3,
         "the host has no body 'tibia'"},
        {"negative tension", describe("TautlinePrescribedTension", "1", "<tension>-3</tension>"), 7,
         "negative tension of TautlinePrescribedTension 'string': -3"},
        {"no number", describe("PathSpring", "1", "<resting_length>long</resting_length>"), 7,
         "'long' is not a number in resting_length of PathSpring 'string'"},
        {"unknown force", "<TautlineForces>\n<ForceSet><objects><Rope name='r'/></objects></ForceSet></TautlineForces>",
         2, "unknown force Rope 'r' in ForceSet"},
        {"unknown element", describe("TautlinePrescribedTension", "1", "<colour>red</colour>"), 7,
         "unknown element colour in TautlinePrescribedTension 'string'"},
        {"force without a path",
         "<TautlineForces>\n<ForceSet><objects>\n<PointToPointSpring name='s'><socket_body1>0</socket_body1>"
         "<socket_body2>1</socket_body2><point1>0 0 0</point1><point2>0 0 0</point2><stiffness>1</stiffness>"
         "<rest_length>1</rest_length></PointToPointSpring></objects></ForceSet></TautlineForces>",
         3, "force 's' has no path: the host adds such forces itself"}};
    for (const RefusedText& refused : cases) {
        SCOPED_TRACE(refused.what);
        Pendulum pendulum;
        const int numSubsystems = pendulum.system.getNumSubsystems();
        State state = pendulum.system.realizeTopology();
        tautline_attachment* attachment = nullptr;
        error = {};
        EXPECT_EQ(tautline->attach(&pendulum.system, refused.text.c_str(), "host.xml", nullptr, 0, &attachment, &error),
                  TAUTLINE_BAD_DESCRIPTION);
        EXPECT_EQ(error.line, refused.line);
        EXPECT_NE(std::string(error.message).find(refused.message), std::string::npos) << error.message;
        EXPECT_EQ(attachment, nullptr);
        EXPECT_EQ(pendulum.system.getNumSubsystems(), numSubsystems);
        EXPECT_EQ(pendulum.forces.getNumForces(), 0);
        EXPECT_TRUE(pendulum.system.systemTopologyHasBeenRealized());
        pendulum.system.realize(state, Stage::Acceleration);
    }
}

TEST_F(HostModule, RefusesAForceThatCannotBeMadeBeforeItAddsAnything) {
    Pendulum pendulum;
    const int numSubsystems = pendulum.system.getNumSubsystems();
    tautline_attachment* attachment = nullptr;
    const std::string text = describe("Thelen2003Muscle", "1", "<max_isometric_force>-4</max_isometric_force>");
    EXPECT_NE(tautline->attach(&pendulum.system, text.c_str(), nullptr, nullptr, 0, &attachment, &error), TAUTLINE_OK);
    EXPECT_NE(std::string(error.message).find("-4"), std::string::npos) << error.message;
    EXPECT_EQ(pendulum.system.getNumSubsystems(), numSubsystems);
    EXPECT_EQ(pendulum.forces.getNumForces(), 0);
}

TEST_F(HostModule, RefusesSystemsAndNamesThatDoNotFit) {
    tautline_attachment* attachment = nullptr;
    const std::string text = describeTension();
    MultibodySystem empty;
    EXPECT_EQ(tautline->attach(&empty, text.c_str(), nullptr, nullptr, 0, &attachment, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "the host's system has no SimbodyMatterSubsystem");
    MultibodySystem forceless;
    SimbodyMatterSubsystem matter(forceless);
    MobilizedBody::Free(matter.Ground(), SimTK::Body::Rigid(MassProperties(1, Vec3(0), UnitInertia(1))));
    EXPECT_EQ(tautline->attach(&forceless, text.c_str(), nullptr, nullptr, 0, &attachment, &error),
              TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "the host's system has no GeneralForceSubsystem");
    Pendulum pendulum;
    const tautline_body far[] = {{"moon", 4}};
    EXPECT_EQ(tautline->attach(&pendulum.system, text.c_str(), nullptr, far, 1, &attachment, &error),
              TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "body 'moon' is the mobilized body 4, but the system has only 0 to 1");
    const tautline_body taken[] = {{"ground", 1}};
    EXPECT_EQ(tautline->attach(&pendulum.system, text.c_str(), nullptr, taken, 1, &attachment, &error),
              TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "a body cannot be given the name 'ground', which is taken");
    EXPECT_EQ(tautline->attach(nullptr, text.c_str(), nullptr, nullptr, 0, &attachment, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "system is NULL");
    EXPECT_EQ(attachment, nullptr);
}

/** An attachment of a prescribed tension to a pendulum. */
class AttachedTension : public HostModule {
protected:
    AttachedTension() {
        EXPECT_EQ(
            tautline->attach(&pendulum.system, describeTension("bob").c_str(), nullptr, kNames, 1, &attachment, &error),
            TAUTLINE_OK)
            << error.message;
    }
    ~AttachedTension() override { tautline->release(attachment); }

    double ask(tautline_result (*query)(const tautline_attachment*, const void*, const char*, double*, tautline_error*),
               const State& state) {
        double number = NaN;
        EXPECT_EQ(query(attachment, &state, "string", &number, &error), TAUTLINE_OK) << error.message;
        return number;
    }

    static constexpr tautline_body kNames[] = {{"bob", 1}};
    Pendulum pendulum;
    tautline_attachment* attachment = nullptr;
};

TEST_F(AttachedTension, TellsPathContactsAndPoints) {
    ASSERT_EQ(tautline->get_num_forces(attachment), 1u);
    EXPECT_STREQ(tautline->get_force_name(attachment, 0), "string");
    EXPECT_EQ(tautline->get_force_name(attachment, 1), nullptr);
    tautline_kind kind;
    EXPECT_EQ(tautline->get_force_kind(attachment, "string", &kind, &error), TAUTLINE_OK);
    EXPECT_EQ(kind, TAUTLINE_PRESCRIBED_TENSION);
    EXPECT_EQ(tautline->get_num_notes(attachment), 0u);

    State state = pendulum.system.realizeTopology();
    pendulum.bob.setAngle(state, 0.3);
    pendulum.bob.setRate(state, -0.7);
    pendulum.system.realize(state, Stage::Velocity);
    const double length = ask(tautline->get_length, state), rate = ask(tautline->get_rate, state);
    EXPECT_EQ(ask(tautline->get_tension, state), 5);
    tautline_status status;
    EXPECT_EQ(tautline->calc_status(attachment, &state, "string", &status, &error), TAUTLINE_OK);
    EXPECT_EQ(status, TAUTLINE_PATH_SOLVED);
    char text[8];
    std::size_t size = 0;
    EXPECT_EQ(tautline->explain_status(attachment, &state, "string", text, sizeof text, &size, &error), TAUTLINE_OK);
    EXPECT_STREQ(text, "a local");
    EXPECT_EQ(size, std::string("a local minimum").size());

    // The path by hand: a sphere's geodesic lies in the plane through its center and both ends.
    std::size_t numObstacles = 0;
    EXPECT_EQ(tautline->get_num_obstacles(attachment, "string", &numObstacles, &error), TAUTLINE_OK);
    ASSERT_EQ(numObstacles, 1u);
    tautline_contact contact;
    ASSERT_EQ(tautline->get_contact(attachment, &state, "string", 0, &contact, &error), TAUTLINE_OK);
    EXPECT_STREQ(contact.name, "ball");
    EXPECT_EQ(contact.mobilized_body, 0);
    ASSERT_TRUE(contact.is_touched);
    EXPECT_TRUE(std::isnan(contact.clearance));
    const Vec3 center(0, 0.1, 0), A(0.02, 0.4, 0.01);
    const Vec3 B = pendulum.bob.findStationLocationInGround(state, Vec3(0.03, 0.2, 0));
    const double r = 0.1, a = (A - center).norm(), b = (B - center).norm();
    const double turn = std::acos(~(A - center) * (B - center) / (a * b)) - std::acos(r / a) - std::acos(r / b);
    EXPECT_NEAR(contact.arc_length, r * turn, 1e-12);
    EXPECT_NEAR(length, std::sqrt(a * a - r * r) + std::sqrt(b * b - r * r) + r * turn, 1e-12);
    EXPECT_NEAR((Vec3::getAs(contact.P) - A).norm(), std::sqrt(a * a - r * r), 1e-12);
    EXPECT_NEAR((Vec3::getAs(contact.Q) - B).norm(), std::sqrt(b * b - r * r), 1e-12);

    // The pin's only speed carries all of the rate: dl/dt = -arm u.
    double arm = NaN, arms = NaN;
    EXPECT_EQ(tautline->calc_moment_arm(attachment, &state, "string", 1, 0, &arm, &error), TAUTLINE_OK);
    EXPECT_EQ(tautline->calc_moment_arms(attachment, &state, "string", &arms, 1, &error), TAUTLINE_OK);
    EXPECT_NEAR(rate, 0.7 * arm, 1e-14);
    EXPECT_EQ(arm, arms);

    std::size_t numPoints = 0;
    EXPECT_EQ(tautline->calc_points(attachment, &state, "string", 0.1, nullptr, 0, &numPoints, &error), TAUTLINE_OK);
    std::vector<double> points(3 * numPoints);
    EXPECT_EQ(tautline->calc_points(attachment, &state, "string", 0.1, points.data(), numPoints, &numPoints, &error),
              TAUTLINE_OK);
    double polyline = 0;
    for (std::size_t i = 1; i < numPoints; ++i)
        polyline += (Vec3::getAs(&points[3 * i]) - Vec3::getAs(&points[3 * i - 3])).norm();
    EXPECT_NEAR(polyline, length, 1e-3 * length);
    EXPECT_LE(polyline, length);

    tautline_statistics statistics;
    EXPECT_EQ(tautline->get_statistics(attachment, "string", &statistics, &error), TAUTLINE_OK);
    EXPECT_GE(statistics.num_solves, 1);
    EXPECT_EQ(statistics.num_failures, 0);
}

TEST_F(AttachedTension, IsSetInTheStateAndPullsWithIt) {
    State state = pendulum.system.realizeTopology();
    EXPECT_EQ(tautline->set_tension(attachment, &state, "string", 12, &error), TAUTLINE_OK);
    pendulum.system.realize(state, Stage::Dynamics);
    EXPECT_EQ(ask(tautline->get_tension, state), 12);
    double arm = NaN;
    tautline->calc_moment_arm(attachment, &state, "string", 1, 0, &arm, &error);
    const SpatialVec& force = pendulum.system.getRigidBodyForces(state, Stage::Dynamics)[1];
    // About the pin: the moment about the bob's origin and that of the force, which is below the pin.
    const Vec3 origin = pendulum.bob.getBodyOriginLocation(state);
    EXPECT_NEAR((force[0] + origin % force[1])[2], 12 * arm, 1e-12);
    EXPECT_EQ(tautline->set_tension(attachment, &state, "string", -1, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_NE(std::string(error.message).find("-1"), std::string::npos) << error.message;
    EXPECT_EQ(tautline->set_tension(attachment, &state, "string", NaN, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(ask(tautline->get_tension, state), 12);
}

TEST_F(AttachedTension, IsAFunctionOfTheHost) {
    const auto calcTension = [](const void* state, double time, void* data) {
        EXPECT_EQ(static_cast<const State*>(state)->getTime(), time);
        return 3 * time + *static_cast<double*>(data);
    };
    double offset = 2;
    EXPECT_EQ(tautline->set_tension_function(attachment, "string", calcTension, &offset, &error), TAUTLINE_OK);
    State state = pendulum.system.realizeTopology();
    state.setTime(4);
    pendulum.system.realize(state, Stage::Velocity);
    EXPECT_EQ(ask(tautline->get_tension, state), 14);
    EXPECT_EQ(tautline->set_tension(attachment, &state, "string", 1, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(tautline->set_tension_function(attachment, "string", calcTension, &offset, &error), TAUTLINE_WRONG_STAGE);
    EXPECT_STREQ(error.message, "the topology of the system is realized already");
}

TEST_F(AttachedTension, RefusesWrongNamesKindsAndStages) {
    State state = pendulum.system.realizeTopology();
    double number = -1;
    EXPECT_EQ(tautline->get_length(attachment, &state, "string", &number, &error), TAUTLINE_WRONG_STAGE);
    pendulum.system.realize(state, Stage::Position);
    EXPECT_EQ(tautline->get_rate(attachment, &state, "string", &number, &error), TAUTLINE_WRONG_STAGE);
    EXPECT_EQ(tautline->get_tension(attachment, &state, "string", &number, &error), TAUTLINE_WRONG_STAGE);
    EXPECT_EQ(tautline->get_length(attachment, &state, "rope", &number, &error), TAUTLINE_UNKNOWN_NAME);
    EXPECT_STREQ(error.message, "there is no force 'rope'");
    EXPECT_EQ(tautline->get_length(attachment, nullptr, "string", &number, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(tautline->get_length(attachment, &state, nullptr, &number, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(tautline->get_length(nullptr, &state, "string", &number, nullptr), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(tautline->get_length(attachment, &state, "string", nullptr, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(tautline->set_excitation(attachment, &state, "string", 0.5, &error), TAUTLINE_BAD_ARGUMENT);
    EXPECT_STREQ(error.message, "force 'string' is not a muscle");
    tautline_contact contact;
    EXPECT_EQ(tautline->get_contact(attachment, &state, "string", 1, &contact, &error), TAUTLINE_UNKNOWN_NAME);
    EXPECT_STREQ(error.message, "the path of 'string' has no obstacle 1, but 1 of them");
    EXPECT_EQ(tautline->calc_moment_arm(attachment, &state, "string", 5, 0, &number, &error), TAUTLINE_UNKNOWN_NAME);
    EXPECT_EQ(tautline->calc_moment_arm(attachment, &state, "string", 1, 1, &number, &error), TAUTLINE_UNKNOWN_NAME);
    EXPECT_STREQ(error.message, "mobilized body 1 has no mobility 1, but 1 of them");
    EXPECT_EQ(tautline->calc_moment_arms(attachment, &state, "string", &number, 2, &error), TAUTLINE_BAD_ARGUMENT);
    std::size_t numPoints;
    EXPECT_EQ(tautline->calc_points(attachment, &state, "string", 0, nullptr, 0, &numPoints, &error),
              TAUTLINE_BAD_ARGUMENT);
    EXPECT_EQ(number, -1);
}

TEST_F(HostModule, TellsWhatItReadsOver) {
    Pendulum pendulum;
    tautline_attachment* attachment = nullptr;
    const std::string text = describe("TautlinePrescribedTension", "1", "");
    const std::string noted = text.substr(0, text.find("<GeometryPath>") + 14) + "<Appearance/>" +
                              text.substr(text.find("<GeometryPath>") + 14);
    ASSERT_EQ(tautline->attach(&pendulum.system, noted.c_str(), "host.xml", nullptr, 0, &attachment, &error),
              TAUTLINE_OK)
        << error.message;
    ASSERT_EQ(tautline->get_num_notes(attachment), 1u);
    EXPECT_STREQ(tautline->get_note(attachment, 0),
                 "host.xml:4: Appearance in GeometryPath is passed over: only drawn");
    EXPECT_EQ(tautline->get_note(attachment, 1), nullptr);
    tautline->release(attachment);
}

TEST_F(HostModule, HandleOutlivesTheSystem) {
    auto pendulum = std::make_unique<Pendulum>();
    tautline_attachment* attachment = nullptr;
    ASSERT_EQ(tautline->attach(&pendulum->system, describeTension().c_str(), nullptr, nullptr, 0, &attachment, &error),
              TAUTLINE_OK);
    const State state = pendulum->system.realizeTopology();
    pendulum.reset();
    double length = -1;
    EXPECT_EQ(tautline->get_length(attachment, &state, "string", &length, &error), TAUTLINE_SYSTEM_GONE);
    EXPECT_EQ(length, -1);
    tautline->release(attachment);
    tautline->release(nullptr);
}

/** A program that loads and unloads the module a hundred times, in several orders. */
TEST_F(HostModule, IsUnloadedAHundredTimes) {
    std::string output;
    EXPECT_EQ(tautline::testing::runProgram(TAUTLINE_RELOAD_PROGRAM " " TAUTLINE_MODULE " 100", output), 0) << output;
}

}  // namespace
