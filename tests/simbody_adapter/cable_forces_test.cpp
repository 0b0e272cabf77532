// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_forces.h"

#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

/** A straight cable from ground to a slider at x. */
struct StraightCable : BareScene {
    StraightCable() {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(0), slider, SimTK::Vec3(0), "straight");
    }

    State makeState(Real x, Real speed) {
        State state = system.realizeTopology();
        slider.setOneQ(state, 0, x);
        slider.setOneU(state, 0, speed);
        system.realize(state, Stage::Acceleration);
        return state;
    }

    MobilizedBody::Slider slider;
    Cable cable;
};

TEST(ElasticString, TensionEnergyAndDissipation) {
    StraightCable scene;
    const ElasticStringForce force(scene.forces, scene.cable, 100, 1.5, 0.2);
    const State taut = scene.makeState(2, 0.5);
    EXPECT_NEAR(force.getStretch(taut), 0.5, 1e-15);
    EXPECT_NEAR(force.getTension(taut), 100 * 0.5 * (1 + 0.2 * 0.5), 1e-12);
    EXPECT_NEAR(scene.system.calcPotentialEnergy(taut), 0.5 * 100 * 0.25, 1e-12);
    EXPECT_NEAR(force.calcPower(taut), -55 * 0.5, 1e-12);
    EXPECT_NEAR(force.getPowerDissipation(taut), 100 * 0.2 * 0.5 * 0.25, 1e-12);
    EXPECT_NEAR(taut.getUDot()[0], -55, 1e-11);
}

TEST(ElasticString, NeverPushes) {
    StraightCable scene;
    const ElasticStringForce force(scene.forces, scene.cable, 100, 1.5, 0.2);
    const State slack = scene.makeState(1.4, -1);
    EXPECT_EQ(force.getTension(slack), 0);
    EXPECT_EQ(scene.system.calcPotentialEnergy(slack), 0);
    EXPECT_EQ(force.getTension(scene.makeState(2, -6)), 0);  // relaxed faster than 1/c
}

TEST(ElasticString, RefusesBadParameters) {
    StraightCable scene;
    EXPECT_MESSAGE(ElasticStringForce(scene.forces, scene.cable, 100, -1),
                   "cable 'straight': slack length must be finite and not negative, but is -1");
    EXPECT_MESSAGE(ElasticStringForce(scene.forces, scene.cable, SimTK::NaN, 1), "stiffness must be finite");
    EXPECT_MESSAGE(ElasticStringForce(scene.forces, scene.cable, 1, 1, -2), "damping");
    EXPECT_MESSAGE(ElasticStringForce(scene.forces, Cable(), 1, 1), "empty handle");
    EXPECT_EQ(scene.forces.getNumForces(), 0);
}

TEST(ElasticString, PullsNothingWhileDisabled) {
    StraightCable scene;
    const ElasticStringForce force(scene.forces, scene.cable, 100, 1.5);
    State state = scene.makeState(2, 0);
    scene.cable.disable(state);
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(force.getTension(state), 0);
    EXPECT_EQ(state.getUDot()[0], 0);
    EXPECT_EQ(scene.system.calcPotentialEnergy(state), 0);
    scene.cable.enable(state);
    force.disable(state);
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(force.getTension(state), 0);
    EXPECT_EQ(state.getUDot()[0], 0);
}

TEST(CableSpring, TensionEnergyAndDamping) {
    StraightCable scene;
    const CableSpringForce force(scene.forces, scene.cable, 100, 1.5, 4);
    const State taut = scene.makeState(2, 0.5);
    EXPECT_NEAR(force.getTension(taut), 100 * 0.5 + 4 * 0.5, 1e-12);
    EXPECT_NEAR(scene.system.calcPotentialEnergy(taut), 0.5 * 100 * 0.25, 1e-12);
    EXPECT_NEAR(taut.getUDot()[0], -52, 1e-11);
    // Below the slack length only the damper pulls, and nothing pushes.
    EXPECT_NEAR(force.getTension(scene.makeState(1.4, 0.5)), 2, 1e-12);
    EXPECT_EQ(scene.system.calcPotentialEnergy(scene.makeState(1.4, 0.5)), 0);
    EXPECT_EQ(force.getTension(scene.makeState(1.4, -0.5)), 0);
    EXPECT_EQ(force.getTension(scene.makeState(1.6, -3)), 0);
    EXPECT_EQ(force.getDefaultParameters().slackLength, 1.5);
    EXPECT_EQ(force.getDefaultParameters().stiffness, 100);
    EXPECT_EQ(force.getDefaultParameters().damping, 4);
    EXPECT_MESSAGE(CableSpringForce(scene.forces, scene.cable, 100, -1),
                   "cable spring on cable 'straight': slack length must be finite and not negative, but is -1");
    EXPECT_MESSAGE(CableSpringForce(scene.forces, scene.cable, -2, 1), "stiffness");
    EXPECT_MESSAGE(CableSpringForce(scene.forces, scene.cable, 1, 1, SimTK::NaN), "damping");
}

TEST(CableSpring, OscillatesWithItsFrequency) {
    // Mass 1, k = 9: x = rest + a cos 3t while taut.
    StraightCable scene;
    CableSpringForce(scene.forces, scene.cable, 9, 1.5);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-11);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeState(2, 0));
    stepper.stepTo(0.5);
    EXPECT_NEAR(integrator.getState().getQ()[0], 1.5 + 0.5 * std::cos(1.5), 1e-9);
}

TEST(PrescribedTension, FromTheStateATimeFunctionOrACallback) {
    StraightCable scene;
    const PrescribedTensionForce constant(scene.forces, scene.cable, 3);
    const PrescribedTensionForce ramp(scene.forces, scene.cable,
                                      new SimTK::Function::Linear(SimTK::Vector(SimTK::Vec2(2, 5))));
    const PrescribedTensionForce called(scene.forces, scene.cable,
                                        [](const State& state) { return -1 + state.getQ()[0]; });
    State state = scene.makeState(2, 0);
    state.setTime(1.5);
    constant.setTension(state, 7);
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(constant.getTension(state), 7);
    EXPECT_NEAR(ramp.getTension(state), 2 * 1.5 + 5, 1e-14);
    EXPECT_EQ(called.getTension(state), 1);
    EXPECT_NEAR(state.getUDot()[0], -16, 1e-12);
    scene.slider.setOneQ(state, 0, 0.5);
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(called.getTension(state), 0);  // a string does not push
    EXPECT_MESSAGE(constant.setTension(state, -1), "must be finite and not negative, but is -1");
    EXPECT_MESSAGE(ramp.setTension(state, 1), "given by a function");
}

/** A law of a user's own with a variable of its own: tension z, z' = length rate. */
class IntegratingLaw : public CableForceLaw {
public:
    using CableForceLaw::CableForceLaw;
    Real calcTension(const State& state) const override { return m_forces->getZ(state)[m_z]; }
    void realizeTopology(State& state, const SimTK::Subsystem& forces) override {
        m_forces = &forces;
        m_z = forces.allocateZ(state, SimTK::Vector(1, 2.0));
    }
    void realizeDerivatives(const State& state, const SimTK::Subsystem& forces) const override {
        forces.updZDot(state)[m_z] = getCable().getLengthRate(state);
    }

private:
    const SimTK::Subsystem* m_forces = nullptr;
    SimTK::ZIndex m_z;
};

TEST(CableForceLaws, AUsersLawKeepsItsOwnVariables) {
    StraightCable scene;
    const CableForce force(scene.forces, std::make_unique<IntegratingLaw>(scene.cable));
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-9);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeState(2, 0.5));
    stepper.stepTo(0.5);
    const State& state = integrator.getState();
    scene.system.realize(state, Stage::Velocity);
    EXPECT_NEAR(force.getTension(state), scene.cable.getLength(state), 1e-8);
    EXPECT_NEAR(state.getQ()[0], 2 * std::cos(0.5) + 0.5 * std::sin(0.5), 1e-8);
}

}  // namespace
}  // namespace tautline::testing
