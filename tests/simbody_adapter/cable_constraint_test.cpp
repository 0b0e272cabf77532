// SPDX-License-Identifier: Apache-2.0
/** A cable of fixed length as a constraint: its derivatives, closed forms, and what a motion keeps. */
#include "tautline/simbody/cable_constraint.h"

#include <cstdio>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

constexpr Real g = 9.81;

/** Errors and forces come from one matrix G, and the acceleration error is the velocity error's derivative. */
TEST(CableConstraintTest, ErrorsAreEachOthersDerivativesAndForcesTheirTranspose) {
    MechanismScene scene;
    const CableConstraint constraint(scene.matter, scene.cable, 4);
    scene.system.realizeTopology();
    for (int pose = 0; pose < 4; ++pose) {
        State state = scene.makeState(pose);
        scene.system.realize(state, Stage::Velocity);
        ASSERT_EQ(scene.cable.getStatus(state), PathStatus::Solved);
        for (const CableElementIndex e : {scene.sphere, scene.cylinder, scene.ellipsoid})
            ASSERT_TRUE(scene.cable.isTouched(state, e));
        EXPECT_EQ(constraint.getPositionErrorsAsVector(state)[0], scene.cable.getLength(state) - 4);
        EXPECT_NEAR(constraint.getVelocityErrorsAsVector(state)[0], scene.cable.getLengthRate(state), 1e-13);

        SimTK::Matrix G, GTranspose;
        scene.matter.calcG(state, G);
        scene.matter.calcGTranspose(state, GTranspose);
        const int row = G.nrow() - 1;  // before it the quaternions' rows, if Simbody counts them
        EXPECT_LT((G - ~GTranspose).norm(), 1e-13);
        SimTK::Vector unitForces;
        scene.cable.calcUnitMobilityForces(state, unitForces);
        EXPECT_LT((~G[row] + unitForces).norm(), 1e-13);

        SimTK::Vector uDot(state.getNU()), errors;
        for (int i = 0; i < state.getNU(); ++i) uDot[i] = std::sin(3 + 1.1 * i + pose);
        scene.matter.calcConstraintAccelerationErrors(state, uDot, errors);
        // Along q(t), u(t) with these rates at t = 0.
        SimTK::Vector qDot = state.getQDot(), qDotDot;
        scene.matter.calcQDotDot(state, uDot, qDotDot);
        const auto calcRate = [&](Real t) {
            State moved = state;
            moved.updQ() += t * qDot + t * t / 2 * qDotDot;
            moved.updU() += t * uDot;
            scene.system.realize(moved, Stage::Velocity);
            return scene.cable.getLengthRate(moved);
        };
        const auto calcDifference = [&](Real h) { return (calcRate(h) - calcRate(-h)) / (2 * h); };
        const Real h = 1e-3, difference = (4 * calcDifference(h / 2) - calcDifference(h)) / 3;
        EXPECT_NEAR(errors[errors.size() - 1], difference, 1e-8);
        EXPECT_GT(std::abs(scene.cable.getLengthAccelerationBias(state)), 1e-2);
    }
}

/** Two masses on vertical rails, hung over a cylinder by one string. */
TEST(CableConstraintTest, AtwoodsMachineHasItsTensionAndAcceleration) {
    BareScene scene;
    const Real m1 = 2, m2 = 3.5, radius = 0.3;
    const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);  // a slider goes along x
    const auto addMass = [&](Real mass, Real x) {
        return MobilizedBody::Slider(scene.matter.Ground(), Transform(upward, SimTK::Vec3(x, -1, 0)),
                                     SimTK::Body::Rigid(SimTK::MassProperties(mass, SimTK::Vec3(0), SimTK::Inertia(1))),
                                     Transform(upward));
    };
    MobilizedBody left = addMass(m1, -radius), right = addMass(m2, radius);
    SimTK::Force::Gravity(scene.forces, scene.matter, -SimTK::YAxis, g);
    Cable cable(scene.cables, left, SimTK::Vec3(0), right, SimTK::Vec3(0));
    cable.addObstacle(scene.matter.Ground(), Transform(), std::make_shared<Cylinder>(radius),
                      SimTK::Vec3(0, radius, 0));
    const CableConstraint constraint(scene.matter, cable, 2 + SimTK::Pi * radius);
    State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_NEAR(constraint.getPositionErrorsAsVector(state)[0], 0, 1e-12);
    EXPECT_NEAR(constraint.getTension(state), 2 * m1 * m2 * g / (m1 + m2), 1e-9);
    EXPECT_NEAR(left.getOneUDot(state, 0), (m2 - m1) * g / (m1 + m2), 1e-10);
    EXPECT_NEAR(right.getOneUDot(state, 0), (m1 - m2) * g / (m1 + m2), 1e-10);
    constraint.disable(state);
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(constraint.getTension(state), 0);
    EXPECT_NEAR(left.getOneUDot(state, 0), -g, 1e-12);
}

/** A mass that swings in a plane on a string from a point above a cylinder on which the string winds and unwinds. */
struct SwingingOverCylinder : BareScene {
    SwingingOverCylinder() {
        MobilizedBody::Planar planar(matter.Ground(), Transform(), makeBody(), Transform());
        mass = planar;
        SimTK::Force::Gravity(forces, matter, -SimTK::YAxis, g);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(0, 0.5, 0), mass, SimTK::Vec3(0));
        cable.addObstacle(matter.Ground(), SimTK::Vec3(-0.15, 0, 0), std::make_shared<Cylinder>(0.1),
                          SimTK::Vec3(0.1, 0, 0));
        cable.setContactListener([this](const ContactEvent&) { ++numEvents; });
    }
    State makeStart() {
        State state = system.realizeTopology();
        mass.setOneQ(state, 1, 1.2);
        mass.setOneQ(state, 2, -0.3);
        system.realize(state, Stage::Position);
        return state;
    }
    MobilizedBody mass;
    Cable cable;
    int numEvents = 0;
};

constexpr Real kStartLength = 1.4422205101855958;  // sqrt(1.2^2 + 0.8^2): at first the string is clear of the cylinder

TEST(CableConstraintTest, APendulumOverACylinderKeepsLengthAndEnergyThroughContact) {
    SwingingOverCylinder scene;
    const CableConstraint constraint(scene.matter, scene.cable, kStartLength);
    const State start = scene.makeStart();
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    integrator.setConstraintTolerance(1e-11);
    integrator.setReturnEveryInternalStep(true);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.setReportAllSignificantStates(true);
    stepper.initialize(start);
    scene.system.realize(stepper.getState(), Stage::Velocity);
    const Real energy = scene.system.calcEnergy(stepper.getState());
    Real error = 0, rate = 0, drift = 0, kinetic = 0, leastTension = SimTK::Infinity;
    while (integrator.getTime() < 6) {
        stepper.stepTo(6);
        const State& state = integrator.getState();
        scene.system.realize(state, Stage::Acceleration);
        error = std::max(error, std::abs(scene.cable.getLength(state) - kStartLength));
        rate = std::max(rate, std::abs(scene.cable.getLengthRate(state)));
        drift = std::max(drift, std::abs(scene.system.calcEnergy(state) - energy));
        kinetic = std::max(kinetic, scene.system.calcKineticEnergy(state));
        leastTension = std::min(leastTension, constraint.getTension(state));
    }
    std::printf(
        "[measured] %d contact events, length error %.1e m, rate %.1e m/s, energy %.1e of the kinetic, "
        "least tension %.3f N\n",
        scene.numEvents, error, rate, drift / kinetic, leastTension);
    EXPECT_GE(scene.numEvents, 4);
    EXPECT_LT(error, 1e-10);
    EXPECT_LT(rate, 1e-10);
    EXPECT_LT(drift, 1e-8 * kinetic);
    EXPECT_GT(leastTension, 0);
}

/** With stiffness k the string stretches by T/k: motion and tension differ from the constraint's by that order. */
TEST(CableConstraintTest, TheMultiplierIsTheTensionOfAStiffString) {
    SwingingOverCylinder rigid, stiff;
    const CableConstraint constraint(rigid.matter, rigid.cable, kStartLength);
    State state = rigid.makeStart();
    rigid.system.realize(state, Stage::Acceleration);
    const Real k = 1e6, firstTension = constraint.getTension(state);
    EXPECT_GT(firstTension, 1);
    // From the stretch that balances it; what touchdown and the swing excite along the string dies out in a few ms.
    const ElasticStringForce string(stiff.forces, stiff.cable, k, kStartLength - firstTension / k, 100);
    const auto run = [](SwingingOverCylinder& scene, Real time) {
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setAccuracy(1e-8);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.initialize(scene.makeStart());
        stepper.stepTo(time);
        State result = stepper.getState();
        scene.system.realize(result, Stage::Acceleration);
        return result;
    };
    for (const Real time : {0.2, 0.9}) {  // before and while the string is on the cylinder
        const State a = run(rigid, time), b = run(stiff, time);
        std::printf("[measured] t = %.1f: multiplier %.5f N, tension of a string of 1e6 N/m %.5f N\n", time,
                    constraint.getTension(a), string.getTension(b));
        EXPECT_EQ(rigid.cable.isTouched(a, CableElementIndex(1)), time > 0.5);
        EXPECT_NEAR(constraint.getTension(a), string.getTension(b), 1e-3 * firstTension);
        EXPECT_LT((a.getQ() - b.getQ()).norm(), 1e-4);
    }
}

/** What an integrator does first: to a State that is off the constraint. */
TEST(CableConstraintTest, AStateOffTheConstraintIsBroughtOntoIt) {
    SwingingOverCylinder scene;
    const CableConstraint constraint(scene.matter, scene.cable, kStartLength + 0.05);
    State state = scene.makeStart();
    scene.mass.setOneU(state, 1, 0.3);
    scene.system.realize(state, Stage::Velocity);
    scene.system.project(state, 1e-12);
    EXPECT_NEAR(scene.cable.getLength(state), kStartLength + 0.05, 1e-11);
    EXPECT_NEAR(scene.cable.getLengthRate(state), 0, 1e-11);
}

TEST(CableConstraintTest, ADisabledCableUnderItIsNamed) {
    SwingingOverCylinder scene;
    const CableConstraint constraint(scene.matter, scene.cable, kStartLength);
    State state = scene.makeStart();
    scene.cable.disable(state);
    const std::string name = "the constraint on cable '" + scene.cable.getName() + "' is enabled, but the cable is";
    EXPECT_MESSAGE(scene.system.realize(state, Stage::Velocity), name);
    constraint.disable(state);
    EXPECT_NO_THROW(scene.system.realize(state, Stage::Velocity));
}

TEST(CableConstraintTest, UnsuitableInputIsRefused) {
    SwingingOverCylinder scene, other;
    EXPECT_MESSAGE(CableConstraint(scene.matter, Cable(), 1), "empty handle");
    EXPECT_MESSAGE(CableConstraint(scene.matter, scene.cable, 0), "must be positive and finite, but is 0");
    EXPECT_MESSAGE(CableConstraint(scene.matter, scene.cable, SimTK::NaN), "positive and finite");
    EXPECT_MESSAGE(CableConstraint(other.matter, scene.cable, 1), "another matter subsystem");
    Cable conditional(other.cables, other.matter.Ground(), SimTK::Vec3(0), other.mass, SimTK::Vec3(0));
    conditional.addConditionalPoint(other.matter.Ground(), SimTK::Vec3(1), [](const State&) { return true; });
    EXPECT_MESSAGE(CableConstraint(other.matter, conditional, 1), "moving and conditional points");
    const State state = other.makeStart();
    other.system.realize(state, Stage::Velocity);
    EXPECT_MESSAGE(conditional.getLengthAccelerationBias(state), "moving or conditional points");
    const CableConstraint constraint(scene.matter, scene.cable, 1);
    EXPECT_EQ(constraint.getLength(), 1);
    EXPECT_EQ(constraint.getCable().getName(), scene.cable.getName());
    scene.cable.addViaPoint(scene.matter.Ground(), SimTK::Vec3(1));
    EXPECT_MESSAGE(scene.system.realizeTopology(), "1 elements were added after it");
}

}  // namespace
}  // namespace tautline::testing
