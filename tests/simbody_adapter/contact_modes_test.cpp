// SPDX-License-Identifier: Apache-2.0
/** How contacts are decided from pose to pose, and what is solved for it. */
#include <cstdio>

#include "adapter_scenes.h"
#include "support/allocation_counter.h"
#include "support/planar_chain.h"

namespace tautline::testing {
namespace {

/** A mass that swings on a string about a fixed cylinder, between two springs: the string touches and lifts. */
struct SwingScene : BareScene {
    static constexpr Real kRadius = 0.3;

    explicit SwingScene(int numCables = 1) : mass(matter.Ground(), Transform(), makeBody(), Transform()) {
        SimTK::Force::MobilityLinearSpring(forces, mass, SimTK::MobilizerUIndex(1), 4, 1.5);
        SimTK::Force::MobilityLinearSpring(forces, mass, SimTK::MobilizerUIndex(2), 9, 0.25);
        for (int i = 0; i < numCables; ++i) {
            cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1.5, 0.3, 0), mass, SimTK::Vec3(0));
            obstacle = cable.addObstacle(matter.Ground(), Transform(), std::make_shared<Cylinder>(kRadius),
                                         SimTK::Vec3(0, kRadius, 0));
        }
    }
    State makeStart() {
        State state = system.realizeTopology();
        mass.setOneQ(state, 1, 1.4);
        mass.setOneQ(state, 2, -0.5);
        return state;
    }
    /** In the plane: two tangents and an arc, or the straight line. */
    Real calcLength(const State& state) const {
        const SimTK::Vec3 p = mass.getBodyOriginLocation(state);
        const Vector2 A(-1.5, 0.3), B(p[0], p[1]);
        const Vector2 along = (B - A).normalized();
        if (A.x() * along.y() - A.y() * along.x() < -kRadius) return (B - A).norm();  // passes above
        return calcPlanarLength({{A}, {Vector2(0, 0), kRadius, -1}, {B}}, false);
    }

    MobilizedBody::Planar mass;
    Cable cable;
    CableElementIndex obstacle;
};

struct SwingResult {
    Real worst = 0;  ///< of the length at reports [m]
    int touched = 0, lifted = 0, events = 0;
    SimTK::Vector finalQ;
};

SwingResult swing(ContactMode mode, Real accuracy) {
    SwingScene scene;
    SwingResult result;
    scene.cable.setContactListener([&](const ContactEvent&) { ++result.events; });
    scene.cables.setDefaultContactMode(mode);
    const State start = scene.makeStart();
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(accuracy);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(start);
    for (int i = 1; i <= 200; ++i) {
        stepper.stepTo(0.05 * i);
        const State& state = stepper.getState();
        scene.system.realize(state, Stage::Position);
        EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::Solved) << scene.cable.explainStatus(state);
        EXPECT_EQ(scene.cable.areContactsFixed(state), mode == ContactMode::Events);
        EXPECT_EQ(scene.cable.getContactMode(state), mode);
        result.worst = std::max(result.worst, std::abs(scene.cable.getLength(state) - scene.calcLength(state)));
        ++(scene.cable.isTouched(state, scene.obstacle) ? result.touched : result.lifted);
    }
    result.finalQ = stepper.getState().getQ();
    return result;
}

TEST(ContactModes, EachFollowsTheClosedFormThroughContacts) {
    const SwingResult events = swing(ContactMode::Events, 1e-8);
    EXPECT_GT(events.events, 5);
    for (const ContactMode mode : {ContactMode::Events, ContactMode::Tracked, ContactMode::Free}) {
        const SwingResult result = swing(mode, 1e-8);
        EXPECT_LT(result.worst, 1e-12);
        EXPECT_GT(result.touched, 30);
        EXPECT_GT(result.lifted, 30);
        if (mode != ContactMode::Events) {
            EXPECT_EQ(result.events, 0);
        }
        EXPECT_LT((result.finalQ - events.finalQ).norm(), 1e-5);
    }
}

TEST(ContactModes, AModeOfOnesOwnComesBeforeTheSubsystems) {
    SwingScene scene(2);
    scene.cables.setDefaultContactMode(ContactMode::Tracked);
    scene.cable.setDefaultContactMode(ContactMode::Free);
    State state = scene.makeStart();
    const Cable& other = scene.cables.getCable(CableIndex(0));
    EXPECT_EQ(other.getContactMode(state), ContactMode::Tracked);
    EXPECT_EQ(scene.cable.getContactMode(state), ContactMode::Free);
    scene.system.realize(state, Stage::Acceleration);
    scene.cables.setContactMode(state, ContactMode::Events);
    EXPECT_EQ(state.getSystemStage(), Stage::Time);
    EXPECT_EQ(scene.cable.getContactMode(state), ContactMode::Events);
    EXPECT_FALSE(scene.cable.areContactsFixed(state));
    scene.system.realize(state, Stage::Position);
    scene.cable.fixContacts(state);
    EXPECT_TRUE(scene.cable.areContactsFixed(state));
    scene.cable.setContactMode(state, ContactMode::Events);
    EXPECT_TRUE(scene.cable.areContactsFixed(state));
    scene.cable.setContactMode(state, ContactMode::Tracked);
    EXPECT_FALSE(scene.cable.areContactsFixed(state));
}

/** A rope that a crank winds up about a post: tracked it keeps its turns, free it has less than one. */
TEST(ContactModes, TrackedKeepsItsTurnsAndFreeForgetsThem) {
    for (const ContactMode mode : {ContactMode::Tracked, ContactMode::Free}) {
        BareScene scene;
        constexpr Real radius = 0.1, distance = 0.8, arm = 0.3;
        MobilizedBody::Pin crank(scene.matter.Ground(), Transform(), makeBody(), Transform());
        SimTK::Motion::Steady(crank, -2);
        Cable rope(scene.cables, scene.matter.Ground(), SimTK::Vec3(-distance, 0, 0), crank, SimTK::Vec3(arm, 0, 0));
        const CableElementIndex post = rope.addObstacle(scene.matter.Ground(), Transform(),
                                                        std::make_shared<Cylinder>(radius), SimTK::Vec3(0, radius, 0));
        rope.setDefaultContactMode(mode);
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setMaximumStepSize(0.1);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.initialize(scene.system.realizeTopology());
        for (int i = 1; i <= 60; ++i) {
            stepper.stepTo(0.1 * i);
            scene.system.realize(stepper.getState(), Stage::Position);
        }
        const Real arc = rope.getArcLength(stepper.getState(), post);
        if (mode == ContactMode::Free) {
            EXPECT_FALSE(arc >= 2 * SimTK::Pi * radius) << arc;
        } else {
            EXPECT_NEAR(arc, radius * (12 + SimTK::Pi - std::acos(radius / distance) - std::acos(radius / arm)), 1e-9);
        }
    }
}

/** Poses a State at one frame after another as an integrator does, and swaps in the last as an accepted step. */
void stepThrough(const SwingScene& scene, State& state, const std::vector<Real>& trials) {
    for (const Real y : trials) {
        scene.mass.setOneQ(state, 2, y);
        scene.system.realize(state, Stage::Velocity);
    }
    state.autoUpdateDiscreteVariables();
}

TEST(ContactModes, ARejectedTrialLeavesNoTraceWhileTracked) {
    SwingScene scene;
    scene.cables.setDefaultContactMode(ContactMode::Tracked);
    State straight = scene.makeStart(), trying = straight;
    for (int k = 0; k < 20; ++k) {
        const Real y = -0.6 + 0.07 * k;
        stepThrough(scene, straight, {y});
        stepThrough(scene, trying, {y + 0.5, y - 0.8, 1.2, -1.5, y});
        for (State* state : {&straight, &trying}) {
            scene.mass.setOneQ(*state, 2, y + 0.03);
            scene.system.realize(*state, Stage::Position);
        }
        EXPECT_EQ(scene.cable.getLength(straight), scene.cable.getLength(trying));
    }
}

TEST(ContactModes, ALoopOverPosesIsWarmIfItAcceptsItsPaths) {
    for (const ContactMode mode : {ContactMode::Tracked, ContactMode::Free}) {
        SwingScene scene;
        scene.cables.setDefaultContactMode(mode);
        State state = scene.makeStart();
        for (int k = 0; k < 100; ++k) {
            scene.mass.setOneQ(state, 2, -0.5 + 0.01 * k);
            scene.system.realize(state, Stage::Position);
            EXPECT_NEAR(scene.cable.getLength(state), scene.calcLength(state), 1e-12);
            scene.cables.acceptPaths(state);
        }
        EXPECT_EQ(scene.cable.getStatistics().numSolves, 100);
        EXPECT_EQ(scene.cable.getStatistics().numColdSolves, 1);
        scene.system.realize(state, Stage::Velocity);
        scene.cable.getLengthRate(state);
        EXPECT_EQ(scene.cable.getStatistics().numSolves, 100);  // the same pose
    }
}

TEST(ContactModes, ACableWhoseBodiesRestIsNotSolvedAgain) {
    SwingScene scene;
    Cable still(scene.cables, scene.matter.Ground(), SimTK::Vec3(-1, 0, 0), scene.matter.Ground(),
                SimTK::Vec3(1, 0, 0));
    still.addObstacle(scene.matter.Ground(), Transform(SimTK::Vec3(0, -0.1, 0)), std::make_shared<Sphere>(0.4));
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    still.resetStatistics();
    stepper.stepTo(5);
    EXPECT_GT(scene.cable.getStatistics().numContactEvents, 2);
    EXPECT_EQ(still.getStatistics().numSolves, 0);
    scene.system.realize(stepper.getState(), Stage::Position);
    EXPECT_EQ(still.getStatus(stepper.getState()), PathStatus::Solved);
}

long countAllocationsOfACopy(int numCables) {
    SwingScene scene(numCables);
    State state = scene.makeStart(), copy = state;
    scene.system.realize(state, Stage::Acceleration);
    copy = state;
    const long before = allocationCount;
    copy = state;
    return allocationCount - before;
}

/** But for what Simbody itself keeps of each of the two witnesses of a cable. */
TEST(ContactModes, CopyingAStateAllocatesNothingPerCable) {
    const long one = countAllocationsOfACopy(1);
    EXPECT_EQ(countAllocationsOfACopy(101), one + 100 * 2);
    EXPECT_GT(one, 0);
}

/** What a user's handler does to the scene. */
struct Shove : SimTK::PeriodicEventHandler {
    Shove(Real interval, std::function<void(State&)> action)
        : PeriodicEventHandler(interval), m_action(std::move(action)) {}
    void handleEvent(State& state, Real, bool&) const override { m_action(state); }
    std::function<void(State&)> m_action;
};

/** Reports of a mass that does not move by itself, while a handler of the user's acts on it. @return how many are not
solved, or not as long as the closed form */
int countWrongReports(SwingScene& scene, std::function<void(State&)> action) {
    scene.system.addEventHandler(new Shove(0.3, std::move(action)));
    const State start = scene.makeStart();
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(start);
    int wrong = 0;
    for (int i = 1; i < 40; ++i) {
        stepper.stepTo(0.1 * i + 0.01);
        const State& state = stepper.getState();
        scene.system.realize(state, Stage::Position);
        if (scene.cable.isDisabled(state)) continue;
        const bool isWrong = scene.cable.calcStatus(state) != PathStatus::Solved ||
                             std::abs(scene.cable.getLength(state) - scene.calcLength(state)) > 1e-10;
        EXPECT_FALSE(isWrong) << "at " << state.getTime() << " s: " << scene.cable.explainStatus(state) << ", "
                              << scene.cable.getLength(state) << " m for " << scene.calcLength(state) << ", mass at "
                              << scene.mass.getBodyOriginLocation(state);
        wrong += isWrong;
    }
    return wrong;
}

// 2026-11-26: 29 of 39 reports had the string inside the cylinder, "solved".
TEST(ContactModes, ContactsSettleWhereAUsersHandlerMovesABody) {
    SwingScene scene;
    const MobilizedBody::Planar& mass = scene.mass;
    EXPECT_EQ(countWrongReports(scene,
                                [&mass](State& state) {
                                    mass.setOneQ(state, 2, mass.getOneQ(state, 2) > 0.3 ? -0.6 : 0.9);
                                    mass.setOneU(state, 2, 0);
                                }),
              0);
}

TEST(ContactModes, ContactsAreFoundAnewWhereAHandlerEnablesACable) {
    SwingScene scene;
    const Cable& cable = scene.cable;
    EXPECT_EQ(
        countWrongReports(
            scene, [&cable](State& state) { cable.isDisabled(state) ? cable.enable(state) : cable.disable(state); }),
        0);
}

/** Who steps a bare Integrator handles its events, or sees in calcStatus() that nobody did. */
TEST(ContactModes, ABareIntegratorThatIgnoresEventsIsFoundOut) {
    SwingScene scene;
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setFinalTime(4);
    integrator.initialize(scene.makeStart());
    int solved = 0, penetrating = 0;
    for (int i = 1; i < 40; ++i) {
        while (integrator.stepTo(0.1 * i) != SimTK::Integrator::ReachedReportTime) {
        }
        scene.system.realize(integrator.getState(), Stage::Position);
        const PathStatus status = scene.cable.calcStatus(integrator.getState());
        const bool isRight =
            std::abs(scene.cable.getLength(integrator.getState()) - scene.calcLength(integrator.getState())) < 1e-10;
        EXPECT_EQ(status == PathStatus::Solved, isRight) << scene.cable.explainStatus(integrator.getState());
        ++(isRight ? solved : penetrating);
    }
    EXPECT_GT(solved, 5);
    EXPECT_GT(penetrating, 5);
}

}  // namespace
}  // namespace tautline::testing
