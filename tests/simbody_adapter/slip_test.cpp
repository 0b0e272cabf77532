// SPDX-License-Identifier: Apache-2.0
/** Strings that slide round obstacles and slip off them. */
#include <cstdio>
#include <map>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

using Kind = ContactEvent::Kind;

/** What became of a run. */
struct Outcome {
    std::vector<ContactEvent> events;
    long numSteps = 0, numDegraded = 0;
    Real excess = 0;  ///< by which the path was longer than one found anew, at most [m]
    Real length = 0;  ///< at the end [m]
    bool isTouched = false;
    std::string why;  ///< the first degraded step is
};

/** Steps to the end and compares each path with one found anew. */
Outcome simulate(
    BareScene& scene, const Cable& cable, CableElementIndex obstacle, const State& initial, Real accuracy,
    Real finalTime, Real maxStep = SimTK::Infinity,
    const std::function<void(const ContactEvent&)>& listen = [](const ContactEvent&) {}) {
    Outcome result;
    cable.setContactListener([&](const ContactEvent& event) {
        result.events.push_back(event);
        listen(event);
    });
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(accuracy);
    integrator.setReturnEveryInternalStep(true);
    if (maxStep < SimTK::Infinity) integrator.setMaximumStepSize(maxStep);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.setReportAllSignificantStates(true);
    stepper.initialize(initial);
    while (stepper.getTime() < finalTime) {
        stepper.stepTo(finalTime);
        const State& state = stepper.getState();
        scene.cables.countStep(state);
        if (cable.calcStatus(state) != PathStatus::Solved && result.why.empty())
            result.why = "at " + std::to_string(state.getTime()) + " s: " + cable.explainStatus(state);
        State fresh = state;
        cable.releaseContacts(fresh);
        scene.system.realize(fresh, Stage::Position);
        result.length = cable.getLength(state);
        result.isTouched = cable.isTouched(state, obstacle);
        result.excess = std::max(result.excess, result.length - cable.getLength(fresh));
    }
    result.numSteps = cable.getStatistics().numSteps, result.numDegraded = cable.getStatistics().numDegradedSteps;
    cable.setContactListener(nullptr);
    return result;
}

/** A drive carries one end of a string up and down past an obstacle that stands off the plane of the motion:
the string touches, slides round it, comes free. */
struct PassingString : BareScene {
    PassingString(std::shared_ptr<const Surface> surface, Real z) {
        const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);
        slider = MobilizedBody::Slider(matter.Ground(), Transform(upward, SimTK::Vec3(1, 0, 0)), makeBody(),
                                       Transform(upward));
        SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, 0.6, 3, -SimTK::Pi / 2);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1, 0, 0), slider, SimTK::Vec3(0));
        obstacle = cable.addObstacle(matter.Ground(), Transform(SimTK::Vec3(0, 0.1, z)), std::move(surface));
    }
    Outcome simulate(Real accuracy, Real maxStep) {
        return testing::simulate(*this, cable, obstacle, system.realizeTopology(), accuracy, 4.2, maxStep);
    }
    MobilizedBody slider;
    Cable cable;
    CableElementIndex obstacle;
};

// 2026-11-25: at accuracies from 1e-1 to 1e-4 a long step led to the arc on the far side of the sphere, where the
// string stayed to the end of the run: a saddle, of status Solved.
TEST(Slip, AStringSlidesRoundASmallSphereAlikeAtAnyAccuracy) {
    struct Case {
        std::shared_ptr<const Surface> surface;
        Real z;
    };
    for (const auto& [surface, z] :
         {Case{std::make_shared<Sphere>(0.05), 0.03}, Case{std::make_shared<Sphere>(0.05), 0.005},
          Case{std::make_shared<Sphere>(0.3), 0.1},
          Case{std::make_shared<Ellipsoid>(Vector3(0.1, 0.05, 0.07)), 0.03}}) {
        SCOPED_TRACE(surface->getDescription() + " at z = " + std::to_string(z));
        std::vector<ContactEvent> expected;
        Real length = 0;
        for (const Real accuracy : {1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1}) {
            SCOPED_TRACE(accuracy);
            PassingString scene(surface, z);
            const Outcome run = scene.simulate(accuracy, accuracy < 1e-2 ? 0.05 : 0.2);
            std::printf("[measured] accuracy %.0e: %zu events in %ld steps, %ld degraded, longer by %.1e m\n", accuracy,
                        run.events.size(), run.numSteps, run.numDegraded, run.excess);
            EXPECT_EQ(run.numDegraded, 0);
            EXPECT_LT(run.excess, 1e-9);
            if (expected.empty()) expected = run.events, length = run.length;
            ASSERT_EQ(run.events.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) {
                EXPECT_EQ(run.events[i].kind, expected[i].kind);
                EXPECT_NEAR(run.events[i].time, expected[i].time, 1e-8);
            }
            EXPECT_NEAR(run.length, length, 1e-10);
        }
        EXPECT_GE(expected.size(), 4u);
    }
}

/** A string between two points of a slider that is pressed down on an ellipsoid about the origin, in its plane of
symmetry, from 0.1 above the top, as deep as depth sin(t). */
struct PressedString : BareScene {
    PressedString(const Vector3& semiAxes, Real halfWidth, Real depth)
        : c(semiAxes.z()), halfLength(halfWidth), amplitude(depth) {
        const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);
        slider = MobilizedBody::Slider(matter.Ground(), Transform(upward, SimTK::Vec3(0, semiAxes.y() + rise, 0)),
                                       makeBody(), Transform(upward));
        drive = SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, -depth, 1, 0);
        cable = Cable(cables, slider, SimTK::Vec3(-halfLength, 0, 0), slider, SimTK::Vec3(halfLength, 0, 0));
        obstacle = cable.addObstacle(matter.Ground(), Transform(), std::make_shared<Ellipsoid>(semiAxes),
                                     SimTK::Vec3(0, semiAxes.y(), 0));
    }

    /** When the string slips off an ellipsoid (0.5, 0.5, c): the sideways field along the circle of radius 0.5 is
    cos(s/c) from the top, and comes to zero at the ends of the string, m from the arc, where tan(s/c) = c/m. */
    Real calcSlipTime() const {
        const auto calcExcess = [&](Real t) {
            const Real y = 0.5 + rise - amplitude * std::sin(t), far = std::hypot(halfLength, y);
            const Real m = std::sqrt(far * far - 0.25);
            const Real half = 0.5 * (std::atan2(halfLength, y) - std::acos(0.5 / far));
            return half / c - std::atan2(c, m);
        };
        Real low = 0.15, high = SimTK::Pi / 2;
        for (int i = 0; i < 60; ++i) {
            const Real t = 0.5 * (low + high);
            (calcExcess(t) < 0 ? low : high) = t;
        }
        return low;
    }

    static constexpr Real rise = 0.1;
    Real c, halfLength, amplitude;
    SimTK::Motion::Sinusoid drive;
    MobilizedBody slider;
    Cable cable;
    CableElementIndex obstacle;
};

TEST(Slip, AStringSlipsOffWhereItsStabilityEndsAtAnyAccuracy) {
    for (const Real accuracy : {1e-1, 1e-3, 1e-6, 1e-8}) {
        SCOPED_TRACE(accuracy);
        PressedString scene(Vector3(0.5, 0.5, 0.2), 1, 0.5);
        const State initial = scene.system.realizeTopology();
        const Outcome run = testing::simulate(scene, scene.cable, scene.obstacle, initial, accuracy, 1.5, 0.1);
        ASSERT_GE(run.events.size(), 2u);
        EXPECT_EQ(run.events[0].kind, Kind::Made);
        EXPECT_EQ(run.events[1].kind, Kind::Slipped);
        EXPECT_EQ(run.events[1].obstacle, scene.obstacle);
        EXPECT_NEAR(run.events[1].time, scene.calcSlipTime(), 1e-5);
        EXPECT_LT(run.events[1].lengthAfter, run.events[1].lengthBefore + 1e-12);
        EXPECT_EQ(run.numDegraded, 0);
        EXPECT_LT(run.excess, 1e-9);
        EXPECT_EQ(scene.cable.getStatistics().numSlips, 1);
        std::printf(
            "[measured] accuracy %.0e: slips at %.6f s, expected at %.6f s, length %.6f to %.6f m, %zu events\n",
            accuracy, run.events[1].time, scene.calcSlipTime(), run.events[1].lengthBefore, run.events[1].lengthAfter,
            run.events.size());
    }
}

// An elastic string that springs press on a broad ellipsoid: at the end it snaps from its top.
TEST(Slip, TakesTheEnergyThatItsLengthsSay) {
    PressedString scene(Vector3(1, 0.5, 0.6), 1.5, 0);
    constexpr Real slackLength = 2.9, stiffness = 20;
    const ElasticStringForce string(scene.forces, scene.cable, stiffness, slackLength);
    SimTK::Force::MobilityLinearSpring(scene.forces, scene.slider, SimTK::MobilizerUIndex(0), 30, -0.8);
    State state = scene.system.realizeTopology();
    scene.drive.disable(state);
    Real lost = 0;
    int numSlips = 0;
    const auto calcStored = [&](Real length) {
        return stiffness * SimTK::square(std::max(Real(0), length - slackLength)) / 2;
    };
    scene.cable.setContactListener([&](const ContactEvent& event) {
        if (event.kind != Kind::Slipped) return;
        ++numSlips;
        lost += calcStored(event.lengthBefore) - calcStored(event.lengthAfter);
    });
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    integrator.setMaximumStepSize(0.01);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(state);
    const Real initial = scene.system.calcEnergy(stepper.getState());
    Real worst = 0, largestKinetic = 0;
    for (int i = 1; i <= 400; ++i) {
        stepper.stepTo(0.01 * i);
        scene.system.realize(stepper.getState(), Stage::Dynamics);
        largestKinetic = std::max(largestKinetic, scene.system.calcKineticEnergy(stepper.getState()));
        worst = std::max(worst, std::abs(scene.system.calcEnergy(stepper.getState()) - initial + lost));
    }
    std::printf("[measured] %d slips took %.3e J of %.3e J, books off by %.1e J\n", numSlips, lost, largestKinetic,
                worst);
    EXPECT_GE(numSlips, 2);
    EXPECT_GT(lost, 1e-3 * largestKinetic);
    EXPECT_LT(worst, 1e-7 * largestKinetic);
}

/** A mass flung about on springs, its string past three thin obstacles. */
struct FlungMass : BareScene {
    explicit FlungMass(int number) {
        SimTK::Random::Uniform random(-1, 1);
        random.setSeed(number);
        MobilizedBody::Translation mass(matter.Ground(), Transform(), makeBody(), Transform());
        const Real stiffness[] = {20, 30, 25}, rest[] = {2, 0, 0};
        for (int i = 0; i < 3; ++i)
            SimTK::Force::MobilityLinearSpring(forces, mass, SimTK::MobilizerUIndex(i),
                                               stiffness[i] + 8 * random.getValue(), rest[i] + 0.1 * random.getValue());
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1, 0, 0), mass, SimTK::Vec3(0));
        const std::shared_ptr<const Surface> kinds[] = {std::make_shared<Sphere>(0.05),
                                                        std::make_shared<Ellipsoid>(Vector3(0.05, 0.1, 0.075)),
                                                        std::make_shared<Cylinder>(0.05)};
        for (int i = 0; i < 3; ++i) {
            const SimTK::UnitVec3 axis(SimTK::Vec3(random.getValue(), random.getValue(), 0.3));
            const SimTK::Vec3 place(-0.5 + 0.6 * i, 0.15 * random.getValue(), 0.1 * random.getValue());
            cable.addObstacle(matter.Ground(), Transform(SimTK::Rotation(1.5 * random.getValue(), axis), place),
                              kinds[(number + i) % 3]);
        }
        ElasticStringForce(forces, cable, 2, 1);
        initial = system.realizeTopology();
        mass.setQ(initial, SimTK::Vec3(1.5, 0.5 * random.getValue(), 0.5 * random.getValue()));
        mass.setU(initial, SimTK::Vec3(0, 4 * random.getValue(), 4 * random.getValue()));
    }
    Cable cable;
    State initial;
};

// 2026-11-25: at accuracies from 1e-1 to 1e-3 a quarter of all steps stood on saddles or did not converge. Beside them,
// an arc of scene 5 at 1e-5 and one of scene 10 at 1e-3 went on below zero length: an event had been found where
// solving once more gave the witness the other sign, by rounding.
TEST(Slip, AFlungMassDoesNotLeaveItsStringOnASaddle) {
    for (const Real accuracy : {1e-1, 1e-3, 1e-5})
        for (int number = 1; number <= 12; ++number) {
            SCOPED_TRACE(std::to_string(accuracy) + ", scene " + std::to_string(number));
            FlungMass scene(number);
            std::map<int, Real> lastTime;
            int numRattles = 0;
            const auto listen = [&](const ContactEvent& event) {
                if (event.kind == Kind::Slipped) {
                    EXPECT_LT(event.lengthAfter, event.lengthBefore + 1e-9) << "at " << event.time;
                    return;
                }
                if (lastTime.count(event.obstacle) && event.time - lastTime[event.obstacle] < 1e-6) ++numRattles;
                lastTime[event.obstacle] = event.time;
            };
            const Outcome run = testing::simulate(scene, scene.cable, CableElementIndex(1), scene.initial, accuracy, 5,
                                                  SimTK::Infinity, listen);
            EXPECT_EQ(run.numDegraded, 0) << "of " << run.numSteps << ", first " << run.why;
            EXPECT_EQ(numRattles, 0);
        }
}

}  // namespace
}  // namespace tautline::testing
