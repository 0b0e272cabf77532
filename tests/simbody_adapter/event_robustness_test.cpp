// SPDX-License-Identifier: Apache-2.0
/** Contact events where integrators are careless: steps that go clean through an obstacle, loose accuracies,
grazing motions. */
#include <cstdio>

#include "adapter_scenes.h"
#include "support/seeded_random.h"

namespace tautline::testing {
namespace {

using Kind = ContactEvent::Kind;
using SimTK::Vec2;

/** A string over a circle around 0 in a plane: two tangents and the arc between, `angle` from end to end on
the circle's side of the string. */
Real calcCircleLength(Real a, Real b, Real angle, Real radius) {
    const Real arc = angle - std::acos(radius / a) - std::acos(radius / b);
    return std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) + radius * arc;
}

/** A double pendulum that is nothing but swinging masses, with a string from ground to its tip and a pin, much
thinner than the tip's way in a step, between them: the scene of simbody issue #831. */
struct PinnedPendulum : BareScene {
    PinnedPendulum() {
        SimTK::Force::Gravity(forces, matter, -SimTK::YAxis, 9.81);
        const SimTK::Body::Rigid bob(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(0.01)));
        upper = MobilizedBody::Pin(matter.Ground(), Transform(), bob, Transform(SimTK::Vec3(0, 1, 0)));
        lower = MobilizedBody::Pin(upper, Transform(), bob, Transform(SimTK::Vec3(0, 1, 0)));
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(0), lower, SimTK::Vec3(0));
        pin = cable.addObstacle(matter.Ground(), Transform(pin_G), std::make_shared<Cylinder>(radius));
    }

    State makeStart(Real angle, Real speed) {
        State state = system.realizeTopology();
        upper.setOneQ(state, 0, angle);
        lower.setOneQ(state, 0, 0.4);
        upper.setOneU(state, 0, speed);
        return state;
    }

    /** Of the tip about the pin, 0 where the string passes straight through it [rad]. */
    Real calcAngle(const State& state) const {
        const SimTK::Vec3 in = pin_G, out = lower.getBodyOriginLocation(state) - pin_G;
        return std::atan2(in[0] * out[1] - in[1] * out[0], ~in * out);
    }

    static constexpr Real radius = 0.002;
    const SimTK::Vec3 pin_G{0.05, -0.7, 0};
    MobilizedBody::Pin upper, lower;
    Cable cable;
    CableElementIndex pin;
};

/** Follows the tip's angle about the pin from accepted step to accepted step and knows the string by it: free, it
catches where the angle passes 0; caught on one side, it comes free where the angle comes back. */
class StringOracle {
public:
    explicit StringOracle(Real angle) : m_angle(angle) {}

    void follow(Real angle) {
        const Real before = m_angle;
        m_angle += std::remainder(angle - m_angle, 2 * SimTK::Pi);
        if (!m_isCaught) {
            // Passing behind the origin, at pi, a free string changes sides without being caught.
            m_angle = std::remainder(m_angle, 2 * SimTK::Pi);
            const bool isNear = std::abs(m_angle) < 2 && std::abs(before) < 2;
            if (!isNear || (m_angle > 0) == (before > 0)) return;
            m_isCaught = true, m_side = m_angle > 0 ? 1 : -1, ++m_catches;
        } else if (m_side * m_angle < 0) {
            m_isCaught = false;
        }
    }
    bool isCaught() const { return m_isCaught; }
    int getCatches() const { return m_catches; }
    /** Turned by the string at the pin [rad], not negative. */
    Real getTurn() const { return m_isCaught ? std::abs(m_angle) : 0; }

private:
    Real m_angle;
    bool m_isCaught = false;
    int m_side = 0, m_catches = 0;
};

/** @param angle, speed   of the upper pendulum at the start
@return how often the string was caught */
int expectEveryCatchSeen(Real accuracy, Real angle, Real speed) {
    PinnedPendulum scene;
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(accuracy);
    integrator.setReturnEveryInternalStep(true);
    integrator.setFinalTime(30);
    integrator.initialize(scene.makeStart(angle, speed));
    scene.system.realize(integrator.getState(), Stage::Position);
    StringOracle oracle(scene.calcAngle(integrator.getState()));
    Real longestMove = 0, worst = 0, largestTurn = 0;
    SimTK::Vec3 tip = scene.lower.getBodyOriginLocation(integrator.getState());
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(integrator.getState());
    stepper.setReportAllSignificantStates(true);
    while (integrator.getTime() < 30) {
        stepper.stepTo(30);
        const State& state = integrator.getState();
        scene.system.realize(state, Stage::Position);
        const SimTK::Vec3 moved = scene.lower.getBodyOriginLocation(state);
        longestMove = std::max(longestMove, (moved - tip).norm());
        tip = moved;
        oracle.follow(scene.calcAngle(state));
        largestTurn = std::max(largestTurn, oracle.getTurn());
        // A thin pin touches a little before or after the angle of its axis says so.
        if (std::abs(std::remainder(scene.calcAngle(state), 2 * SimTK::Pi)) < 0.05 && oracle.getTurn() < 1) continue;
        const bool isTouched = scene.cable.isTouched(state, scene.pin);
        EXPECT_EQ(isTouched, oracle.isCaught()) << "at " << state.getTime() << " s";
        if (isTouched != oracle.isCaught()) break;
        const Real expected = oracle.isCaught() ? calcCircleLength(scene.pin_G.norm(), (tip - scene.pin_G).norm(),
                                                                   SimTK::Pi + oracle.getTurn(), scene.radius)
                                                : tip.norm();
        worst = std::max(worst, std::abs(scene.cable.getLength(state) - expected));
    }
    std::printf(
        "[measured] accuracy %.0e: %d catches, tip moves up to %.2f m (pin %.3f m thick) in a step, turned up to %.1f, "
        "length error %.1e m\n",
        accuracy, oracle.getCatches(), longestMove, 2 * scene.radius, largestTurn, worst);
    EXPECT_GT(longestMove, 20 * scene.radius);
    EXPECT_LT(worst, 1e-12);
    return oracle.getCatches();
}

TEST(EventRobustness, AStepCleanThroughAThinPinIsCaught) {
    for (const Real accuracy : {1e-1, 1e-2, 1e-3, 1e-6}) EXPECT_GE(expectEveryCatchSeen(accuracy, 1.2, 0), 5);
}

// 2026-11-24: in a step that turned the tip by more than a quarter turn, Newton's method came to the tangent point on
// the far side of the pin, and half a turn of string was lost.
TEST(EventRobustness, StringIsWoundUpWhileThePendulumTurnsOver) {
    for (const Real accuracy : {1e-1, 1e-2, 1e-3, 1e-6}) EXPECT_GE(expectEveryCatchSeen(accuracy, 2.5, 4), 1);
}

/** The side, and how far the string is wound on, are variables of the State: a copy has them, a fresh State at the same
pose has the straight string, and neither disturbs the other. */
TEST(EventRobustness, WindingBelongsToTheState) {
    PinnedPendulum scene;
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-6);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart(2.5, 4));
    Real longestArc = 0;
    for (int i = 1; longestArc < 1.2 * SimTK::Pi * scene.radius; ++i) {
        ASSERT_LT(i, 3000) << "the string was never wound up";
        stepper.stepTo(0.01 * i);
        scene.system.realize(integrator.getState(), Stage::Position);
        if (scene.cable.isTouched(integrator.getState(), scene.pin))
            longestArc = scene.cable.getArcLength(integrator.getState(), scene.pin);
    }
    const State& wound = integrator.getState();
    const Real length = scene.cable.getLength(wound), arc = scene.cable.getArcLength(wound, scene.pin);
    State fresh = scene.system.getDefaultState();
    fresh.updQ() = wound.getQ();
    scene.system.realize(fresh, Stage::Position);
    EXPECT_LT(scene.cable.getLength(fresh), length - 0.01);
    EXPECT_FALSE(scene.cable.getArcLength(fresh, scene.pin) >= SimTK::Pi * scene.radius);
    State copy = wound;
    EXPECT_LT(copy.getSystemStage(), Stage::Position);
    scene.system.realize(copy, Stage::Position);
    EXPECT_NEAR(scene.cable.getLength(copy), length, 1e-14);
    EXPECT_NEAR(scene.cable.getArcLength(copy, scene.pin), arc, 1e-14);
    EXPECT_EQ(scene.cable.getLength(wound), length);
}

/** A string through a ring, both ends carried sideways as x = a sin(w t), far beyond the ring's tube. */
struct PulledRing : BareScene {
    explicit PulledRing(bool isDriven = true) {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        if (isDriven) SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, 3, frequency, 0);
        cable = Cable(cables, slider, SimTK::Vec3(0, 0, -2), slider, SimTK::Vec3(0, 0, 2));
        ring = cable.addObstacle(matter.Ground(), Transform(), std::make_shared<Torus>(0.6, tube), ThreadHole{1});
        cable.setContactListener([this](const ContactEvent& event) { events.push_back(event); });
    }

    /** The ring's near side is a circle of the tube about x = +-0.6, which the string passes on the side of x = 0. */
    Real calcLength(Real x) const {
        const Real beyond = std::abs(x) - 0.6;
        if (beyond <= -tube) return 4;
        const Real a = std::hypot(beyond, 2);
        return calcCircleLength(a, a, 2 * (SimTK::Pi - std::atan2(2, beyond)), tube);
    }

    static constexpr Real frequency = 2, tube = 0.02;
    MobilizedBody slider;
    Cable cable;
    CableElementIndex ring;
    std::vector<ContactEvent> events;
};

TEST(EventRobustness, AStepThroughARingIsCaughtByTheRing) {
    for (const Real maxStep : {0.01, 0.1, 0.35}) {
        SCOPED_TRACE(maxStep);
        PulledRing scene;
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setMaximumStepSize(maxStep);
        integrator.setReturnEveryInternalStep(true);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.setReportAllSignificantStates(true);
        stepper.initialize(scene.system.realizeTopology());
        Real worst = 0;
        while (integrator.getTime() < 10) {
            stepper.stepTo(10);
            const State& state = integrator.getState();
            scene.system.realize(state, Stage::Position);
            const Real x = scene.slider.getBodyOriginLocation(state)[0];
            worst = std::max(worst, std::abs(scene.cable.getLength(state) - scene.calcLength(x)));
        }
        std::printf("[measured] ring pulled over in steps of %.2f s: %zu events, length error %.1e m\n", maxStep,
                    scene.events.size(), worst);
        EXPECT_LT(worst, 1e-9);
        EXPECT_GE(scene.events.size(), 10u);
    }
}

/** A string beside a ring, not quite in its plane of symmetry, carried to the other side: it is pressed on the outside
of the tube, slips round the ring, and is never in its hole. */
struct RoundedRing : BareScene {
    /** @param y, tilt   of the string [m] */
    RoundedRing(Real tube, Real y, Real tilt, Real frequency) {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, 3, frequency, SimTK::Pi / 2);
        cable = Cable(cables, slider, SimTK::Vec3(0, y, -2), slider, SimTK::Vec3(0, y + tilt, 2));
        cable.addObstacle(matter.Ground(), Transform(), std::make_shared<Torus>(kRadius, tube));
    }

    /** By points along the path. */
    bool isInHole(const State& state) const {
        const std::vector<SimTK::Vec3> points = cable.calcResampledPoints(state, 500);
        for (std::size_t i = 1; i < points.size(); ++i) {
            const SimTK::Vec3 &a = points[i - 1], &b = points[i];
            if ((a[2] < 0) == (b[2] < 0)) continue;
            const SimTK::Vec3 crossing = a + a[2] / (a[2] - b[2]) * (b - a);
            if (std::hypot(crossing[0], crossing[1]) < kRadius) return true;
        }
        return false;
    }

    static constexpr Real kRadius = 0.6;
    MobilizedBody slider;
    Cable cable;
};

// 2026-11-26: it slipped through the ring, and was then said to have left it.
TEST(EventRobustness, AStringBesideAThinRingDoesNotSlipThroughIt) {
    SeededRandom random(7);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(i);
        RoundedRing scene(i % 2 == 0 ? 0.05 : 0.02, random.uniform(-0.5, 0.5), random.uniform(-0.1, 0.1),
                          random.uniform(1, 3));
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setMaximumStepSize(random.uniform(0.05, 0.4));
        integrator.setReturnEveryInternalStep(true);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.setReportAllSignificantStates(true);
        stepper.initialize(scene.system.realizeTopology());
        while (integrator.getTime() < 5) {
            stepper.stepTo(5);
            const State& state = integrator.getState();
            scene.system.realize(state, Stage::Position);
            ASSERT_FALSE(scene.isInHole(state)) << "at " << state.getTime() << " s";
            ASSERT_EQ(scene.cable.calcStatus(state), PathStatus::Solved) << "at " << state.getTime() << " s";
        }
        EXPECT_GT(scene.cable.getStatistics().numContactEvents, 1);
        EXPECT_EQ(scene.cable.getStatistics().numHolesLeft, 0);
    }
}

TEST(EventRobustness, AStringThatHasLeftItsRingSaysSo) {
    PulledRing scene(false);
    State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    scene.cable.fixContacts(state);
    scene.system.realize(state, Stage::Position);
    EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::Solved);
    EXPECT_GT(scene.cable.getWitness(state, scene.ring), 0);
    scene.slider.setOneQ(state, 0, 3);
    scene.system.realize(state, Stage::Position);
    EXPECT_FALSE(scene.cable.isTouched(state, scene.ring));
    EXPECT_EQ(scene.cable.getStatus(state), PathStatus::Solved);
    EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::NotMinimum);
    EXPECT_LT(scene.cable.getWitness(state, scene.ring), 0);
    scene.cables.countStep(state);
    EXPECT_EQ(scene.cable.getStatistics().numDegradedSteps, 1);
    // Found anew, the string is threaded again.
    scene.cable.releaseContacts(state);
    scene.system.realize(state, Stage::Position);
    EXPECT_NEAR(scene.cable.getLength(state), scene.calcLength(3), 1e-10);
}

}  // namespace
}  // namespace tautline::testing
