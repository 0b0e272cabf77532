// SPDX-License-Identifier: Apache-2.0
/** Energy of simulated models: what the drivers put in and the damping takes out is what changes. */
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tautline/models/model_system.h"
#include "tautline/models/osim_reader.h"

namespace tautline {
namespace {

using models::ModelSystem;

/** Integrates, along with the motion, the power of the system's Motions as Simbody counts it (from their reactions and
the bodies' speeds), and what the string's damping loses. */
class EnergyBooks : public SimTK::Force::Custom::Implementation {
public:
    EnergyBooks(const ModelSystem& model, const SimTK::GeneralForceSubsystem& forces)
        : m_model(model), m_forces(forces) {}

    SimTK::Real getWork(const SimTK::State& state) const { return m_forces.getZ(state)[m_first]; }
    SimTK::Real getLoss(const SimTK::State& state) const { return m_forces.getZ(state)[m_first + 1]; }
    void calcForce(const SimTK::State&, SimTK::Vector_<SimTK::SpatialVec>&, SimTK::Vector_<SimTK::Vec3>&,
                   SimTK::Vector&) const override {}
    SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }
    void realizeTopology(SimTK::State& state) const override {
        m_first = m_forces.allocateZ(state, SimTK::Vector(2, SimTK::Real(0)));
    }
    void realizeAcceleration(const SimTK::State& state) const override {
        SimTK::Vector& rates = m_forces.updZDot(state);
        rates[m_first] = m_model.getModel().getMatter().calcMotionPower(state);
        rates[m_first + 1] = m_model.getSprings().at(0).spring.getPowerDissipation(state);
    }

private:
    const ModelSystem& m_model;
    const SimTK::GeneralForceSubsystem& m_forces;
    mutable SimTK::ZIndex m_first;
};

/** A simulated model with its energy books: how far they are from balancing, against the largest kinetic energy. */
struct Balance {
    double largestKinetic = 0, worst = 0, work = 0, loss = 0;
    int events = 0;
};

Balance keepBooks(const std::string& name, double duration, double accuracy) {
    ModelSystem model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/" + name + ".osim"));
    SimTK::GeneralForceSubsystem forces(model.updSystem());
    auto* books = new EnergyBooks(model, forces);
    SimTK::Force::Custom(forces, books);
    Balance balance;
    Cable(model.getSprings().at(0).cable).setContactListener([&balance](const ContactEvent&) { ++balance.events; });
    const SimTK::MultibodySystem& system = model.getSystem();
    SimTK::RungeKuttaMersonIntegrator integrator(system);
    integrator.setAccuracy(accuracy);
    SimTK::TimeStepper stepper(system, integrator);
    stepper.initialize(model.makeDefaultState());
    system.realize(stepper.getState(), SimTK::Stage::Dynamics);
    const double initial = system.calcEnergy(stepper.getState());
    const int samples = static_cast<int>(std::lround(duration / 0.02));
    for (int i = 1; i <= samples; ++i) {
        stepper.stepTo(duration * i / samples);
        const SimTK::State& state = stepper.getState();
        system.realize(state, SimTK::Stage::Dynamics);
        balance.largestKinetic = std::max(balance.largestKinetic, system.calcKineticEnergy(state));
        balance.work = books->getWork(state), balance.loss = books->getLoss(state);
        const double excess = system.calcEnergy(state) - initial - balance.work + balance.loss;
        balance.worst = std::max(balance.worst, std::abs(excess));
    }
    std::cout << name << ": over " << duration << " s and " << balance.events << " events off by " << balance.worst
              << " J of " << balance.largestKinetic << " J; drivers' work " << balance.work << " J, damping "
              << balance.loss << " J; " << integrator.getNumStepsTaken() << " steps\n";
    return balance;
}

TEST(EnergyBooks, OfDrivenSurfacesBalance) {
    const Balance balance = keepBooks("four_surfaces_implicit", 1.5, 1e-10);
    EXPECT_EQ(balance.events, 1);
    EXPECT_GT(std::abs(balance.work), 0.1);
    EXPECT_GT(balance.loss, 0.01);
    EXPECT_LT(balance.worst, 1e-8);
}

TEST(LongEnergyBooks, OfDrivenSurfacesBalanceOverTenSeconds) {
    for (const char* name : {"four_surfaces_implicit", "four_surfaces_parametric"}) {
        const Balance balance = keepBooks(name, 10, 1e-12);
        EXPECT_EQ(balance.events, 6);
        EXPECT_LT(balance.worst, 1e-8);
    }
}

TEST(EnergyBooks, OverFixedSurfacesTheEnergyStays) {
    const Balance balance = keepBooks("pegs", 5, 1e-12);
    EXPECT_GE(balance.events, 8);
    EXPECT_EQ(balance.work, 0);
    EXPECT_EQ(balance.loss, 0);
    EXPECT_LT(balance.worst, 1e-9 * balance.largestKinetic);
}

TEST(LongEnergyBooks, OverFixedSurfacesTheEnergyStaysForAMinute) {
    const Balance balance = keepBooks("pegs", 60, 1e-12);
    EXPECT_GE(balance.events, 50);
    EXPECT_LT(balance.worst, 1e-9 * balance.largestKinetic);
}

}  // namespace
}  // namespace tautline
