// SPDX-License-Identifier: Apache-2.0
/** Measures of cables, the reporter, and the books of what damping takes. */
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/simbody/cable_measures.h"
#include "tautline/simbody/cable_reporter.h"

namespace tautline::testing {
namespace {

/** A mass on a damped string over a sphere, which it leaves and meets again. */
struct HangingMass : BareScene {
    HangingMass() : mass(matter.Ground(), Transform(), makeBody(), Transform()) {
        gravity = SimTK::Force::Gravity(forces, matter, -SimTK::YAxis, 9.81);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1, 0, 0), mass, SimTK::Vec3(0), "string");
        cable.addObstacle(matter.Ground(), SimTK::Vec3(0, -0.05, 0), std::make_shared<Cylinder>(0.1),
                          SimTK::Vec3(0, 0.1, 0), "post");
        string = ElasticStringForce(forces, cable, 200, 1.9, 0.05);
    }
    State makeStart() {
        State state = system.realizeTopology();
        mass.setOneQ(state, 1, 1);
        mass.setOneQ(state, 2, -0.8);
        return state;
    }
    MobilizedBody::Planar mass;
    SimTK::Force::Gravity gravity;
    Cable cable;
    ElasticStringForce string;
};

TEST(CableMeasures, AreTheQueriesOfTheirCable) {
    HangingMass scene;
    const CableLengthMeasure length(scene.cables, scene.cable);
    const CableRateMeasure rate(scene.cables, scene.cable);
    const CableTensionMeasure tension(scene.forces, scene.string);
    const SimTK::Measure::Integrate integral(scene.cables, rate, SimTK::Measure::Constant(scene.cables, 0));
    const State start = scene.makeStart();
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-9);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(start);
    const Real first = scene.cable.getLength(integrator.getState());
    stepper.stepTo(1);
    const State& state = stepper.getState();
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(length.getValue(state), scene.cable.getLength(state));
    EXPECT_EQ(length.getValue(state, 1), scene.cable.getLengthRate(state));
    EXPECT_EQ(rate.getValue(state), scene.cable.getLengthRate(state));
    EXPECT_EQ(tension.getValue(state), scene.string.getTension(state));
    EXPECT_NEAR(integral.getValue(state), scene.cable.getLength(state) - first, 1e-7);
    EXPECT_MESSAGE(CableLengthMeasure(scene.cables, Cable()), "empty handle");
}

/** Energy is what it was, but for what the damper has booked. */
TEST(CableSprings, BookWhatDampingTakes) {
    HangingMass scene;
    const State start = scene.makeStart();
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-9);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(start);
    const auto calcTotal = [&](const State& state) {
        scene.system.realize(state, Stage::Dynamics);
        return scene.system.calcEnergy(state) + scene.string.getDissipatedEnergy(state);
    };
    const Real before = calcTotal(integrator.getState());
    Real worst = 0;
    for (int i = 1; i <= 40; ++i) {
        stepper.stepTo(0.1 * i);
        worst = std::max(worst, std::abs(calcTotal(stepper.getState()) - before));
    }
    const Real taken = scene.string.getDissipatedEnergy(stepper.getState());
    std::printf("[measured] energy and dissipation in balance to %.1e J of %.3g J taken, %ld contact events\n", worst,
                taken, scene.cable.getStatistics().numContactEvents);
    EXPECT_GT(taken, 0.5);
    EXPECT_LT(worst, 1e-6);
    EXPECT_GT(scene.cable.getStatistics().numContactEvents, 1);
}

TEST(CableSprings, ParametersAreAVariableOfTheState) {
    HangingMass scene;
    State state = scene.makeStart();
    scene.system.realize(state, Stage::Acceleration);
    const Real before = scene.string.getTension(state);
    CableSpringParameters parameters = scene.string.getParameters(state);
    parameters.stiffness *= 2;
    scene.string.setParameters(state, parameters);
    EXPECT_EQ(state.getSystemStage(), Stage::Velocity);
    EXPECT_NEAR(scene.string.getTension(state), 2 * before, 1e-12);
    EXPECT_EQ(scene.string.getDefaultParameters().stiffness, 200);
    scene.string.setDissipatedEnergy(state, 3);
    EXPECT_EQ(scene.string.getDissipatedEnergy(state), 3);
    parameters.slackLength = -1;
    EXPECT_MESSAGE(scene.string.setParameters(state, parameters), "slack length must be finite and not negative");
    const CableSpringForce undamped(scene.forces, scene.cable, 1, 1);
    State other = scene.makeStart();
    EXPECT_MESSAGE(undamped.setParameters(other, {1, 1, 0.5}), "made without damping");
    EXPECT_EQ(undamped.getDissipatedEnergy(other), 0);
}

TEST(CableReporter, WritesWhatTheCablesDid) {
    HangingMass scene;
    auto* reporter = new CableReporter(scene.cables, 0.25);
    reporter->addForce(scene.string);
    scene.system.addEventReporter(reporter);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    stepper.stepTo(1);
    ASSERT_EQ(reporter->getNumRows(), 5);
    const std::vector<std::string> labels{"time", "string|length", "string|rate", "string|contact.post",
                                          "string|tension"};
    EXPECT_EQ(reporter->getLabels(), labels);
    const State& last = stepper.getState();
    scene.system.realize(last, Stage::Velocity);
    EXPECT_NEAR(reporter->getRow(4)[1], scene.cable.getLength(last), 1e-12);
    EXPECT_NEAR(reporter->getRow(4)[4], scene.string.getTension(last), 1e-9);
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "tautline_cable_reporter_test.sto";
    reporter->writeStorage(file.string());
    std::ifstream in(file);
    std::string line, text;
    for (int i = 0; i < 6; ++i) std::getline(in, line), text += line + "\n";
    EXPECT_EQ(text, "cables\nversion=1\nnRows=5\nnColumns=5\ninDegrees=no\nendheader\n");
    std::getline(in, line);
    EXPECT_EQ(line, "time\tstring|length\tstring|rate\tstring|contact.post\tstring|tension");
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 5; ++column) {
            Real value = 0;
            in >> value;
            EXPECT_EQ(value, reporter->getRow(row)[column]);
        }
    std::filesystem::remove(file);
    EXPECT_MESSAGE(reporter->writeStorage("/nonexistent/x.sto"), "cannot write '/nonexistent/x.sto'");
    EXPECT_MESSAGE(CableReporter(scene.cables, 0), "must be positive and finite, but is 0");
}

}  // namespace
}  // namespace tautline::testing
