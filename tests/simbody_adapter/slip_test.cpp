/** Strings that slide round obstacles and slip off them. */
#include <cstdio>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

using Kind = ContactEvent::Kind;

/** What became of a run. */
struct Run {
    std::vector<ContactEvent> events;
    long numSteps = 0, numDegraded = 0;
    Real excess = 0;  ///< by which the path was longer than one found anew, at most [m]
    Real length = 0;  ///< at the end [m]
    bool isTouched = false;
};

/** Steps to the end and compares each path with one found anew. */
Run run(BareScene& scene, const Cable& cable, CableElementIndex obstacle, const State& initial, Real accuracy,
        Real finalTime, Real maxStep = SimTK::Infinity) {
    Run result;
    cable.setContactListener([&](const ContactEvent& event) { result.events.push_back(event); });
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

/** A mass on a spring carries one end of a string up and down past an obstacle that stands off the plane of the motion:
the string touches, slides round it, comes free. */
struct PassingString : BareScene {
    PassingString(std::shared_ptr<const Surface> surface, Real z) {
        const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);
        slider = MobilizedBody::Slider(matter.Ground(), Transform(upward, SimTK::Vec3(1, 0, 0)), makeBody(),
                                       Transform(upward));
        SimTK::Force::MobilityLinearSpring(forces, slider, SimTK::MobilizerUIndex(0), 9, 0);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1, 0, 0), slider, SimTK::Vec3(0));
        obstacle = cable.addObstacle(matter.Ground(), Transform(SimTK::Vec3(0, 0.1, z)), std::move(surface));
    }
    Run run(Real accuracy) {
        State state = system.realizeTopology();
        slider.setOneQ(state, 0, -0.6);
        return testing::run(*this, cable, obstacle, state, accuracy, 4.2);
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
          Case{std::make_shared<Sphere>(0.3), 0.1}, Case{std::make_shared<Ellipsoid>(Vec3(0.1, 0.05, 0.07)), 0.03}}) {
        SCOPED_TRACE(surface->getDescription() + " at z = " + std::to_string(z));
        std::vector<ContactEvent> expected;
        Real length = 0;
        for (const Real accuracy : {1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1}) {
            SCOPED_TRACE(accuracy);
            PassingString scene(surface, z);
            const Run run = scene.run(accuracy);
            std::printf("[measured] accuracy %.0e: %zu events in %ld steps, %ld degraded, longer by %.1e m\n", accuracy,
                        run.events.size(), run.numSteps, run.numDegraded, run.excess);
            EXPECT_EQ(run.numDegraded, 0);
            EXPECT_LT(run.excess, 1e-9);
            if (expected.empty()) expected = run.events, length = run.length;
            ASSERT_EQ(run.events.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(run.events[i].kind, expected[i].kind);
            EXPECT_NEAR(run.length, length, 20 * accuracy);
        }
        EXPECT_GE(expected.size(), 4u);
    }
}

/** A string between two points of a slider that is pressed down on an ellipsoid (0.5, 0.5, c) about the origin, in its
plane of symmetry, as deep as y = 0.5 + rise - depth sin(t). */
struct PressedString : BareScene {
    static constexpr Real halfLength = 1;

    explicit PressedString(Real thickness, Real depth) : c(thickness), amplitude(depth) {
        const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);
        slider = MobilizedBody::Slider(matter.Ground(), Transform(upward, SimTK::Vec3(0, 0.5 + rise, 0)), makeBody(),
                                       Transform(upward));
        SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, -depth, 1, 0);
        cable = Cable(cables, slider, SimTK::Vec3(-halfLength, 0, 0), slider, SimTK::Vec3(halfLength, 0, 0));
        obstacle = cable.addObstacle(matter.Ground(), Transform(), std::make_shared<Ellipsoid>(Vec3(0.5, 0.5, c)),
                                     SimTK::Vec3(0, 0.5, 0));
    }

    /** When the string slips off: the sideways field along the circle of radius 0.5 is cos(s/c) from the top, and
    comes to zero at the ends of the string, m from the arc, where tan(s/c) = c/m. */
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
    Real c, amplitude;
    MobilizedBody slider;
    Cable cable;
    CableElementIndex obstacle;
};

TEST(Slip, AStringSlipsOffWhereItsStabilityEndsAtAnyAccuracy) {
    for (const Real accuracy : {1e-1, 1e-3, 1e-6, 1e-8}) {
        SCOPED_TRACE(accuracy);
        PressedString scene(0.2, 0.5);
        const State initial = scene.system.realizeTopology();
        const Run run = testing::run(scene, scene.cable, scene.obstacle, initial, accuracy, 1.5, 0.1);
        ASSERT_GE(run.events.size(), 2u);
        EXPECT_EQ(run.events[0].kind, Kind::Made);
        EXPECT_EQ(run.events[1].kind, Kind::Slipped);
        EXPECT_EQ(run.events[1].obstacle, scene.obstacle);
        EXPECT_NEAR(run.events[1].time, scene.calcSlipTime(), 1e-6);
        EXPECT_LT(run.events[1].lengthAfter, run.events[1].lengthBefore);
        EXPECT_EQ(run.numDegraded, 0);
        EXPECT_LT(run.excess, 1e-9);
        EXPECT_EQ(scene.cable.getStatistics().numSlips, 1);
        std::printf(
            "[measured] accuracy %.0e: slips at %.6f s, expected at %.6f s, length %.6f to %.6f m, %zu events\n",
            accuracy, run.events[1].time, scene.calcSlipTime(), run.events[1].lengthBefore, run.events[1].lengthAfter,
            run.events.size());
    }
}

}  // namespace
}  // namespace tautline::testing
