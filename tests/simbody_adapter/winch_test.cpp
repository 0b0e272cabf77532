// SPDX-License-Identifier: Apache-2.0
/** Obstacles and ends that turn far in one step of an integrator. */
#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

constexpr Real kRadius = 0.1, kDistance = 0.8;  // of the drum; from the rope's fixed point to its axis [m]

/** A rope wound clockwise onto a driven drum, or about a post by a driven crank. */
struct DrivenWinch : BareScene {
    DrivenWinch(bool isDrum, Real armLength)
        : arm(armLength), turned(matter.Ground(), Transform(), makeBody(), Transform()) {
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-kDistance, 0, 0), turned, SimTK::Vec3(arm, 0, 0), "rope");
        const MobilizedBody carrier = isDrum ? MobilizedBody(turned) : MobilizedBody(matter.Ground());
        obstacle =
            cable.addObstacle(carrier, Transform(), std::make_shared<Cylinder>(kRadius), SimTK::Vec3(0, kRadius, 0));
        cable.setContactListener([this](const ContactEvent& event) { events.push_back(event); });
    }
    Real calcLength(Real turn) const {
        const Real leaves = std::acos(kRadius / arm), meets = SimTK::Pi - std::acos(kRadius / kDistance);
        return std::sqrt(kDistance * kDistance - kRadius * kRadius) + std::sqrt(arm * arm - kRadius * kRadius) +
               kRadius * (meets - leaves + turn);
    }
    /** Reports every `interval`. */
    void simulate(Real interval, int numReports) {
        SimTK::RungeKuttaMersonIntegrator integrator(system);
        SimTK::TimeStepper stepper(system, integrator);
        stepper.initialize(system.realizeTopology());
        for (int i = 1; i <= numReports; ++i) {
            stepper.stepTo(i * interval);
            const State& state = stepper.getState();
            system.realize(state, Stage::Velocity);
            const Real turn = -turned.getOneQ(state, 0), speed = -turned.getOneU(state, 0);
            ASSERT_EQ(cable.calcStatus(state), PathStatus::Solved) << cable.explainStatus(state);
            EXPECT_NEAR(cable.getLength(state), calcLength(turn), 1e-8) << "at " << state.getTime() << " s";
            EXPECT_NEAR(cable.getLengthRate(state), kRadius * speed, 1e-6);
        }
        EXPECT_TRUE(events.empty());
        EXPECT_EQ(cable.getStatistics().numSlips, 0);
    }
    Real arm;
    MobilizedBody::Pin turned;
    Cable cable;
    CableElementIndex obstacle;
    std::vector<ContactEvent> events;
};

// 2026-11-26: beyond 1.3 rad a step the rope was found unwound, after slips that never were.
TEST(Winch, WindsUpItsRopeAtAnyStep) {
    for (const Real interval : {0.1, 1.0, 3.0}) {
        DrivenWinch winch(true, kRadius);
        SimTK::Motion::Steady(winch.turned, -2);
        winch.simulate(interval, 6);
    }
}

// 2026-11-26: a crank at 2 rad/s lost its turns in one step of 6 s.
TEST(Winch, ACrankWindsUpItsRopeAtAnyStep) {
    for (const Real interval : {0.1, 1.0, 6.0}) {
        DrivenWinch winch(false, 0.35);
        SimTK::Motion::Steady(winch.turned, -2);
        winch.simulate(interval, 4);
    }
}

TEST(Winch, WindsUpItsRopeWhileItIsSpedUp) {
    DrivenWinch winch(true, kRadius);
    SimTK::Force::MobilityConstantForce(winch.forces, winch.turned, -0.3);
    winch.simulate(0.7, 4);
}

}  // namespace
}  // namespace tautline::testing
