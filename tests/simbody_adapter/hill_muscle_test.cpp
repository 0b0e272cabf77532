// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/hill_muscle.h"

#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

/** A muscle along x from ground to a slider, tendon 0.2 m, fiber 0.1 m, 1000 N. */
struct MuscleScene : BareScene {
    explicit MuscleScene(const HillMuscleParameters& parameters) {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(0), slider, SimTK::Vec3(0));
        muscle = HillMuscle(forces, cable, parameters);
    }

    State makeState(Real length, Real speed, Real activation) {
        State state = system.realizeTopology();
        slider.setOneQ(state, 0, length);
        slider.setOneU(state, 0, speed);
        muscle.setActivation(state, activation);
        system.realize(state, Stage::Velocity);
        return state;
    }

    MobilizedBody::Slider slider;
    Cable cable;
    HillMuscle muscle;
};

TEST(HillMuscleTest, TensionsComputedByHand) {
    MuscleScene scene{HillMuscleParameters()};
    // Optimal length, at rest: a F_0, no passive force.
    EXPECT_NEAR(scene.muscle.getTension(scene.makeState(0.3, 0, 0.5)), 500, 1e-9);
    EXPECT_EQ(scene.muscle.getTension(scene.makeState(0.3, 0, 0)), 0);
    // Stretched by 30 %: exp(-0.09/0.45) = exp(-0.2), passive (e^2 - 1)/(e^4 - 1) = 1/(e^2 + 1).
    EXPECT_NEAR(scene.muscle.getTension(scene.makeState(0.33, 0, 1)), 1000 * (std::exp(-0.2) + 1 / (std::exp(2.0) + 1)),
                1e-9);
    // Shortening at half the maximal velocity, 0.5 m/s: 0.5/(1 + 2) = 1/6.
    EXPECT_NEAR(scene.muscle.getTension(scene.makeState(0.3, -0.5, 1)), 1000 / 6.0, 1e-9);
    EXPECT_EQ(scene.muscle.getTension(scene.makeState(0.3, -1.2, 1)), 0);
    // Lengthening: c = 0.4/5 = 0.08, at v = 0.08 half of the gain: 1.2.
    EXPECT_NEAR(scene.muscle.getTension(scene.makeState(0.3, 0.08, 1)), 1200, 1e-9);
    // Shorter than the tendon.
    EXPECT_EQ(scene.muscle.getTension(scene.makeState(0.19, 0, 1)), 0);
}

TEST(HillMuscleTest, PennationKeepsTheThickness) {
    HillMuscleParameters parameters;
    parameters.pennationAtOptimal = SimTK::Pi / 6;
    MuscleScene scene(parameters);
    const Real projection = 0.1 * std::cos(SimTK::Pi / 6);
    State optimal = scene.makeState(0.2 + projection, 0.4, 1);
    EXPECT_NEAR(scene.muscle.getFiberLength(optimal), 0.1, 1e-15);
    EXPECT_NEAR(scene.muscle.getPennation(optimal), SimTK::Pi / 6, 1e-14);
    EXPECT_NEAR(scene.muscle.getFiberVelocity(optimal), 0.4 * std::cos(SimTK::Pi / 6), 1e-14);
    EXPECT_NEAR(scene.muscle.getTension(scene.makeState(0.2 + projection, 0, 1)), 1000 * std::cos(SimTK::Pi / 6), 1e-9);
    // Projection 0.05: fiber sqrt(0.05^2 + 0.05^2), 45 degrees.
    State shorter = scene.makeState(0.25, 0, 1);
    EXPECT_NEAR(scene.muscle.getFiberLength(shorter), 0.05 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(scene.muscle.getTension(shorter),
                1000 * std::exp(-SimTK::square(std::sqrt(0.5) - 1) / 0.45) * std::sqrt(0.5), 1e-9);
}

TEST(HillMuscleTest, ForceVelocityIsSmoothAtRest) {
    const HillMuscleParameters parameters;
    const Real h = 1e-7;
    const Real below = (1 - calcForceVelocity(parameters, -h)) / h;
    const Real above = (calcForceVelocity(parameters, h) - 1) / h;
    EXPECT_NEAR(below, 5, 1e-5);  // 1 + 1/0.25
    EXPECT_NEAR(above, 5, 1e-5);
    EXPECT_NEAR(calcForceVelocity(parameters, 1e9), 1.4, 1e-8);
    EXPECT_EQ(calcForceVelocity(parameters, -1), 0);
}

TEST(HillMuscleTest, ActivationFollowsItsTimeConstants) {
    HillMuscleParameters parameters;
    parameters.maxIsometricForce = 1e-3;  // so that the slider stays where it is
    MuscleScene scene(parameters);
    State state = scene.makeState(0.3, 0, 0.1);
    scene.muscle.setExcitation(state, 0.8);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(state);
    stepper.stepTo(0.02);
    EXPECT_NEAR(scene.muscle.getActivation(integrator.getState()), 0.8 - 0.7 * std::exp(-0.02 / 0.01), 1e-9);
    scene.muscle.setExcitation(state, 0);
    stepper.initialize(state);
    stepper.stepTo(0.06);
    EXPECT_NEAR(scene.muscle.getActivation(integrator.getState()), 0.1 * std::exp(-0.06 / 0.04), 1e-9);
}

TEST(HillMuscleTest, ExcitationFromAFunctionIsClipped) {
    MuscleScene scene{HillMuscleParameters()};
    scene.muscle.setExcitationFunction([](const State& state) { return state.getTime(); });
    State state = scene.makeState(0.3, 0, 0);
    state.setTime(0.25);
    EXPECT_EQ(scene.muscle.getExcitation(state), 0.25);
    state.setTime(3);
    EXPECT_EQ(scene.muscle.getExcitation(state), 1);
    EXPECT_MESSAGE(scene.muscle.setExcitation(state, 0.5), "given by a function");
}

TEST(HillMuscleTest, RefusesBadParametersByNameAndValue) {
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0), scene.matter.Ground(), SimTK::Vec3(1));
    const auto expectRefused = [&](Real HillMuscleParameters::*member, Real value, const std::string& message) {
        HillMuscleParameters parameters;
        parameters.*member = value;
        EXPECT_MESSAGE(HillMuscle(scene.forces, cable, parameters), message);
        EXPECT_MESSAGE(HillMuscle(scene.forces, cable, parameters), "cable '" + cable.getName() + "': hill muscle: ");
    };
    using P = HillMuscleParameters;
    expectRefused(&P::maxIsometricForce, -5, "maxIsometricForce must be positive and finite, but is -5");
    expectRefused(&P::optimalFiberLength, 0, "optimalFiberLength must be positive and finite, but is 0");
    expectRefused(&P::tendonSlackLength, -1, "tendonSlackLength must be finite and not negative");
    expectRefused(&P::pennationAtOptimal, 1.6, "pennationAtOptimal must be in [0, pi/2), but is 1.6");
    expectRefused(&P::activationTime, SimTK::NaN, "activationTime");
    expectRefused(&P::eccentricForce, 1, "eccentricForce must be finite and above 1, but is 1");
    expectRefused(&P::defaultActivation, 2, "defaultActivation must be in [0, 1], but is 2");
    EXPECT_EQ(scene.forces.getNumForces(), 0);
    const HillMuscle muscle(scene.forces, cable, HillMuscleParameters());
    State state = scene.system.realizeTopology();
    EXPECT_MESSAGE(muscle.setActivation(state, -1),
                   "hill muscle on cable '" + cable.getName() + "': activation must be");
}

}  // namespace
}  // namespace tautline::testing
