// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/muscle.h"

#include "adapter_scenes.h"
#include "muscle_cases.h"

namespace tautline::testing {
namespace {

/** A muscle along x from ground to a slider that moves as told. */
struct MuscleScene : BareScene {
    explicit MuscleScene(std::shared_ptr<const MuscleModel> model, Real middle = 0.3, Real amplitude = 0) {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        if (amplitude > 0) SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, amplitude, 20, SimTK::Pi / 2);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-middle, 0, 0), slider, SimTK::Vec3(0));
        muscle = Muscle(forces, cable, std::move(model));
    }

    /** @param stretch   of the path beyond the middle */
    State makeState(Real stretch, Real speed, Real activation) {
        State state = system.realizeTopology();
        slider.setOneQ(state, 0, stretch);
        slider.setOneU(state, 0, speed);
        if (!muscle.getParameters().ignoresActivationDynamics) muscle.setActivation(state, activation);
        system.realize(state, Stage::Velocity);
        return state;
    }

    MobilizedBody::Slider slider;
    Cable cable;
    Muscle muscle;
};

State integrate(MuscleScene& scene, const State& from, Real duration, Real accuracy) {
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(accuracy);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(from);
    stepper.stepTo(from.getTime() + duration);
    State state = integrator.getState();
    scene.system.realize(state, Stage::Velocity);
    return state;
}

TEST(MuscleTest, EveryModelPullsWithWhatItSays) {
    for (const MuscleCase& each : makeMuscleCases()) {
        SCOPED_TRACE(each.name);
        MuscleScene scene(each.model);
        State state = scene.makeState(0.01, -0.2, 0.6);
        scene.muscle.equilibrate(state);
        scene.system.realize(state, Stage::Dynamics);
        const MuscleDynamics d = scene.muscle.calcDynamics(state);
        EXPECT_EQ(scene.muscle.getTension(state), d.tendonForce);
        EXPECT_EQ(scene.muscle.getTendonForce(state), d.tendonForce);
        EXPECT_EQ(scene.muscle.getActiveFiberForce(state), d.activeFiberForce);
        EXPECT_EQ(scene.muscle.getPassiveFiberForce(state), d.passiveFiberForce);
        EXPECT_EQ(scene.muscle.getFiberVelocity(state), d.fiberVelocity);
        EXPECT_EQ(scene.muscle.getFiberLength(state), d.lengths.fiberLength);
        EXPECT_EQ(scene.muscle.getTendonLength(state), d.lengths.tendonLength);
        EXPECT_EQ(scene.muscle.getPennation(state), d.lengths.calcPennation());
        EXPECT_EQ(scene.muscle.getFiberActivePower(state), d.fiberActivePower);
        EXPECT_EQ(scene.muscle.getFiberPassivePower(state), d.fiberPassivePower);
        EXPECT_EQ(scene.muscle.getTendonPower(state), d.tendonPower);
        EXPECT_NEAR(scene.muscle.getMusclePower(state), scene.muscle.calcPower(state), 1e-12 * (1 + d.tendonForce));
        EXPECT_NEAR(scene.muscle.calcPower(state), -d.tendonForce * scene.cable.getLengthRate(state), 1e-12);
        const SimTK::Vector_<SimTK::SpatialVec>& F_G = scene.system.getRigidBodyForces(state, Stage::Dynamics);
        EXPECT_NEAR(F_G[scene.slider.getMobilizedBodyIndex()][1][0], -d.tendonForce, 1e-12 * (1 + d.tendonForce));
        const MuscleEnergy energy = scene.muscle.calcEnergy(state);
        EXPECT_NEAR(scene.system.calcPotentialEnergy(state), energy.fiber + energy.tendon, 1e-12);
    }
}

/** The power of a muscle's active and damping part, integrated by the integrator beside the motion. */
class PowerIntegral : public SimTK::Force::Custom::Implementation {
public:
    PowerIntegral(const SimTK::GeneralForceSubsystem& forces, const Muscle& muscle)
        : m_forces(forces), m_muscle(muscle) {}
    void calcForce(const State&, SimTK::Vector_<SimTK::SpatialVec>&, SimTK::Vector_<SimTK::Vec3>&,
                   SimTK::Vector&) const override {}
    Real calcPotentialEnergy(const State&) const override { return 0; }
    bool dependsOnlyOnPositions() const override { return false; }
    void realizeTopology(State& state) const override { m_z = m_forces.allocateZ(state, SimTK::Vector(1, Real(0))); }
    void realizeAcceleration(const State& state) const override {
        const MuscleDynamics d = m_muscle.calcDynamics(state);
        m_forces.updZDot(state)[m_z] = d.fiberActivePower + d.fiberDampingPower;
    }
    Real getWork(const State& state) const { return m_forces.getZ(state)[m_z]; }

private:
    const SimTK::GeneralForceSubsystem& m_forces;
    Muscle m_muscle;
    mutable SimTK::ZIndex m_z;
};

/** By the energy of the whole system: kinetic, and stored in fiber and tendon. */
TEST(MuscleTest, AMassOnAMuscleKeepsItsBooks) {
    for (const MuscleCase& each : makeMuscleCases()) {
        if (each.model->hasRigidTendon()) continue;
        SCOPED_TRACE(each.name);
        const MuscleParameters& p = each.model->getParameters();
        MuscleScene scene(each.model, p.tendonSlackLength * 1.01 + p.optimalFiberLength);
        auto* power = new PowerIntegral(scene.forces, scene.muscle);
        SimTK::Force::Custom(scene.forces, power);
        State state = scene.makeState(0, 0.05, 0.3);
        scene.muscle.setExcitation(state, 0.6);
        scene.muscle.equilibrate(state);
        scene.system.realize(state, Stage::Velocity);
        const Real before = scene.system.calcEnergy(state);
        const State after = integrate(scene, state, 0.1, 1e-10);
        const Real work = power->getWork(after);
        EXPECT_GT(std::abs(work), 0.01);
        EXPECT_NEAR(scene.system.calcEnergy(after) - before, work, 1e-6 * std::abs(work) + 1e-7);
    }
}

TEST(MuscleTest, ActivationRisesAndFallsAsTheEquationSays) {
    auto p = makeTypical<Thelen2003Parameters>();
    p.maxIsometricForce = 1e-3;  // so that the slider stays where it is
    MuscleScene scene(std::make_shared<Thelen2003>(p));
    State state = scene.makeState(0, 0, 0.1);
    scene.muscle.setExcitation(state, 0.8);
    scene.muscle.equilibrate(state);
    scene.system.realize(state, Stage::Velocity);
    const Real t = 0.02;
    const Real activation = scene.muscle.getActivation(integrate(scene, state, t, 1e-11));
    // tau (0.5 + 1.5 a) da = (u - a) dt: (0.5 + 1.5 u) ln((u - a_0)/(u - a)) - 1.5 (a - a_0) = t/tau.
    const Real elapsed = (0.5 + 1.5 * 0.8) * std::log(0.7 / (0.8 - activation)) - 1.5 * (activation - 0.1);
    EXPECT_NEAR(elapsed, t / 0.015, 1e-8);
}

TEST(MuscleTest, ExcitationAndActivationStayAboveTheirMinimum) {
    MuscleScene scene(std::make_shared<Thelen2003>(Thelen2003Parameters()));
    scene.muscle.setExcitationFunction([](const State& state) { return state.getTime(); });
    State state = scene.makeState(0, 0, 0.002);
    EXPECT_EQ(scene.muscle.getActivation(state), 0.01);
    EXPECT_EQ(scene.muscle.getExcitation(state), 0.01);
    state.setTime(0.25);
    EXPECT_EQ(scene.muscle.getExcitation(state), 0.25);
    state.setTime(3);
    EXPECT_EQ(scene.muscle.getExcitation(state), 1);
    EXPECT_MESSAGE(scene.muscle.setExcitation(state, 0.5), "given by a function");
}

TEST(MuscleTest, WithoutDynamicsTheActivationIsTheExcitation) {
    Millard2012Parameters p;
    p.ignoresActivationDynamics = true, p.ignoresTendonCompliance = true;
    MuscleScene scene(std::make_shared<Millard2012>(p));
    State state = scene.makeState(0, 0, 0);
    EXPECT_EQ(state.getNZ(), 0);
    scene.muscle.setExcitation(state, 0.7);
    EXPECT_EQ(scene.muscle.getActivation(state), 0.7);
    EXPECT_MESSAGE(scene.muscle.setActivation(state, 0.5), "without activation dynamics");
    EXPECT_MESSAGE(scene.muscle.setFiberLength(state, 0.1), "with a rigid tendon");
}

TEST(MuscleTest, StartsFromEquilibriumAndStaysThere) {
    for (const MuscleCase& each : makeMuscleCases()) {
        SCOPED_TRACE(each.name);
        const MuscleParameters& p = each.model->getParameters();
        MuscleScene scene(each.model, p.tendonSlackLength * 1.01 + p.optimalFiberLength, 1e-12);
        State state = scene.makeState(0, 0, 0.4);
        scene.muscle.setExcitation(state, 0.4);
        const MuscleEquilibrium found = scene.muscle.equilibrate(state);
        EXPECT_EQ(found.status, EquilibriumStatus::Found);
        scene.system.realize(state, Stage::Velocity);
        EXPECT_EQ(scene.muscle.getTension(state), found.tendonForce);
        EXPECT_EQ(scene.muscle.calcIsometricForce(state, 0.4), found.tendonForce);
        EXPECT_GT(scene.muscle.calcIsometricForce(state, 0.5), found.tendonForce);
        const State after = integrate(scene, state, 0.1, 1e-8);
        EXPECT_NEAR(scene.muscle.getTension(after), found.tendonForce,
                    1e-5 * p.maxIsometricForce);
    }
}

TEST(MuscleTest, RefusesBadParametersByNameAndValue) {
    const auto expectRefused = [&](double Thelen2003Parameters::*member, double value, const std::string& message) {
        Thelen2003Parameters parameters;
        parameters.*member = value;
        EXPECT_MESSAGE(Thelen2003{parameters}, message);
    };
    using P = Thelen2003Parameters;
    expectRefused(static_cast<double P::*>(&P::maxIsometricForce), -5,
                  "maxIsometricForce must be positive and finite, but is -5");
    expectRefused(static_cast<double P::*>(&P::optimalFiberLength), 0,
                  "optimalFiberLength must be positive and finite");
    expectRefused(static_cast<double P::*>(&P::tendonSlackLength), -1,
                  "tendonSlackLength must be finite and not negative, but is -1");
    expectRefused(static_cast<double P::*>(&P::pennationAtOptimal), 1.6,
                  "pennationAtOptimal must be in [0, pi/2), but is 1.6");
    expectRefused(static_cast<double P::*>(&P::activationTime), SimTK::NaN, "activationTime");
    expectRefused(static_cast<double P::*>(&P::minimumActivation), 1, "minimumActivation must be in [0, 1), but is 1");
    expectRefused(static_cast<double P::*>(&P::defaultActivation), 2, "defaultActivation must be in [0, 1], but is 2");
    expectRefused(&P::lengtheningForce, 1, "lengtheningForce must be finite and above 1, but is 1");
    expectRefused(&P::linearThreshold, 0.7, "linearThreshold must be above 1/lengtheningForce and below 1");
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0), scene.matter.Ground(), SimTK::Vec3(1));
    EXPECT_MESSAGE(Muscle(scene.forces, cable, nullptr),
                   "muscle on cable '" + cable.getName() + "': the model is null");
    const Muscle muscle(scene.forces, cable, std::make_shared<Thelen2003>(P()));
    State state = scene.system.realizeTopology();
    EXPECT_MESSAGE(muscle.setActivation(state, -1), "muscle on cable '" + cable.getName() + "': activation must be");
    EXPECT_MESSAGE(muscle.setFiberLength(state, 0), "the fiber length must be positive and finite, but is 0");
}

}  // namespace
}  // namespace tautline::testing
