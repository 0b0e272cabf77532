// SPDX-License-Identifier: Apache-2.0
/** Ends of a string that go into an obstacle and come out of it. */
#include <map>

#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

struct PassingEnd : BareScene {
    /** @param origin_G   of the string; @param offset_B   of its end on a slider that goes along x at 1 m/s from -2 */
    PassingEnd(std::shared_ptr<const Surface> surface, const SimTK::Vec3& origin_G, const SimTK::Vec3& offset_B) {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        cable = Cable(cables, matter.Ground(), origin_G, slider, offset_B);
        cable.addObstacle(matter.Ground(), Transform(), std::move(surface));
    }

    /** Whether the path where the end comes out is the one that is found anew there.
    @return how often it came out and there was a shortest path */
    int expectFreshPathOutside(Real accuracy) {
        State initial = system.realizeTopology();
        slider.setOneQ(initial, 0, -2);
        slider.setOneU(initial, 0, 1);
        SimTK::RungeKuttaMersonIntegrator integrator(system);
        integrator.setAccuracy(accuracy);
        integrator.setMaximumStepSize(0.05);
        integrator.setReturnEveryInternalStep(true);
        SimTK::TimeStepper stepper(system, integrator);
        stepper.setReportAllSignificantStates(true);
        stepper.initialize(initial);
        bool isInside = false;
        int numSolved = 0;
        while (stepper.getTime() < 4) {
            stepper.stepTo(4);
            const State& state = stepper.getState();
            system.realize(state, Stage::Position);
            const PathStatus status = cable.calcStatus(state);
            if (status == PathStatus::EndInside) {
                isInside = true;
                continue;
            }
            if (!std::exchange(isInside, false)) continue;
            State fresh = state;
            cable.releaseContacts(fresh);
            system.realize(fresh, Stage::Position);
            if (cable.getStatus(fresh) != PathStatus::Solved) continue;
            ++numSolved;
            EXPECT_EQ(status, PathStatus::Solved) << "at " << stepper.getTime() << " s: " << cable.explainStatus(state);
            EXPECT_NEAR(cable.getLength(state), cable.getLength(fresh), 1e-9) << "at " << stepper.getTime() << " s";
        }
        return numSolved;
    }

    MobilizedBody slider;
    Cable cable;
};

// 2026-11-25: the string came out over a cylinder on the side on which it had been before its end went in, half a turn
// too long, or did not converge to the end of the run.
TEST(EndInside, ComesOutOfACylinderOnTheSideOfThePose) {
    PassingEnd scene(std::make_shared<Cylinder>(0.5), SimTK::Vec3(0.06, 1.02, -0.15), SimTK::Vec3(0, -0.13, 0));
    EXPECT_EQ(scene.expectFreshPathOutside(1e-3), 1);
}

TEST(EndInside, ComesOutOfEverySurfaceAsIfFoundAnew) {
    SimTK::Random::Uniform random(-1, 1);
    random.setSeed(5);
    const std::shared_ptr<const Surface> surfaces[] = {std::make_shared<Sphere>(0.5), std::make_shared<Cylinder>(0.5),
                                                       std::make_shared<Ellipsoid>(Vector3(0.6, 0.45, 0.5)),
                                                       std::make_shared<Torus>(0.6, 0.2)};
    std::map<const Surface*, int> numSolved;
    for (int i = 0; i < 20; ++i) {
        const auto& surface = surfaces[i % 4];
        const SimTK::Vec3 origin(1.5 * random.getValue(), 1 + 0.4 * random.getValue(), 0.3 * random.getValue());
        const SimTK::Vec3 offset(0, 0.4 * random.getValue(), 0.2 * random.getValue());
        SCOPED_TRACE(surface->getDescription() + " run " + std::to_string(i));
        PassingEnd scene(surface, origin, offset);
        numSolved[surface.get()] += scene.expectFreshPathOutside(1e-3);
    }
    for (const auto& surface : surfaces) EXPECT_GE(numSolved[surface.get()], 3) << surface->getDescription();
}

/** An end goes along y = 0.3 into a cylinder of radius 0.5 at t = 1.6 s and out of it at 2.4 s. */
std::vector<ContactEvent> passThroughCylinder(const SimTK::Vec3& origin_G) {
    PassingEnd scene(std::make_shared<Cylinder>(0.5), origin_G, SimTK::Vec3(0, 0.3, 0));
    std::vector<ContactEvent> events;
    scene.cable.setContactListener([&](const ContactEvent& event) { events.push_back(event); });
    State initial = scene.system.realizeTopology();
    scene.slider.setOneQ(initial, 0, -2);
    scene.slider.setOneU(initial, 0, 1);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-6);
    integrator.setMaximumStepSize(0.05);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(initial);
    stepper.stepTo(4);
    return events;
}

/** Length from a point on the cylinder, at an angle, over its top to a point beside it. */
double calcOverTop(double angle, double x, double y) {
    const double d = std::hypot(x, y);
    return std::sqrt(d * d - 0.25) + 0.5 * (angle - std::atan2(y, x) - std::acos(0.5 / d));
}

TEST(EndInside, SwitchesOffAnObstacleThatWasTouchedByAnEventOfItsOwn) {
    const std::vector<ContactEvent> events = passThroughCylinder(SimTK::Vec3(1.5, 0.1, 0));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, ContactEvent::Kind::SwitchedOff);
    EXPECT_NEAR(events[0].time, 1.6, 1e-6);
    EXPECT_NEAR(events[0].lengthBefore, calcOverTop(std::atan2(0.3, -0.4), 1.5, 0.1), 1e-6);
    EXPECT_NEAR(events[0].lengthAfter, std::hypot(1.9, 0.2), 1e-6);
}

TEST(EndInside, SwitchesOnAnObstacleThatIsTouchedWhereTheEndComesOut) {
    const std::vector<ContactEvent> events = passThroughCylinder(SimTK::Vec3(-1.5, 0.1, 0));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, ContactEvent::Kind::SwitchedOn);
    EXPECT_NEAR(events[0].time, 2.4, 1e-6);
    EXPECT_NEAR(events[0].lengthBefore, std::hypot(1.9, 0.2), 1e-6);
    EXPECT_NEAR(events[0].lengthAfter, calcOverTop(std::atan2(0.3, -0.4), 1.5, 0.1), 1e-6) << "mirrored";
}

TEST(ConditionalObstacle, TakesPartWhileItsConditionIsTrue) {
    PassingEnd scene(std::make_shared<Cylinder>(0.5), SimTK::Vec3(1.5, 0.1, 0), SimTK::Vec3(0, 0.3, 0));
    const CableElementIndex cylinder(1);
    const auto isActive = [&](const State& state) {
        const Real x = scene.slider.getOneQ(state, 0);
        return x < -1.5 || x > -1;
    };
    scene.cable.setCondition(cylinder, isActive);
    EXPECT_THROW(scene.cable.setCondition(cylinder, isActive), InvalidInput) << "once";
    EXPECT_THROW(scene.cable.setCondition(CableElementIndex(0), isActive), InvalidInput) << "a point";
    std::vector<ContactEvent> events;
    scene.cable.setContactListener([&](const ContactEvent& event) { events.push_back(event); });
    State initial = scene.system.realizeTopology();
    scene.slider.setOneQ(initial, 0, -2);
    scene.slider.setOneU(initial, 0, 1);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-6);
    integrator.setMaximumStepSize(0.05);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(initial);
    stepper.stepTo(1.5);
    ASSERT_EQ(events.size(), 2u);
    using Kind = ContactEvent::Kind;
    const auto calcOver = [](double x) {
        const double d = std::hypot(x, 0.3);
        return std::sqrt(d * d - 0.25) + calcOverTop(std::atan2(0.3, x) - std::acos(0.5 / d), 1.5, 0.1);
    };
    EXPECT_EQ(events[0].kind, Kind::SwitchedOff);
    EXPECT_NEAR(events[0].time, 0.5, 1e-8);
    EXPECT_NEAR(events[0].lengthBefore, calcOver(-1.5), 1e-7);
    EXPECT_NEAR(events[0].lengthAfter, std::hypot(3, 0.2), 1e-7);
    EXPECT_EQ(events[1].kind, Kind::SwitchedOn);
    EXPECT_NEAR(events[1].time, 1, 1e-8);
    EXPECT_NEAR(events[1].lengthBefore, std::hypot(2.5, 0.2), 1e-7);
    EXPECT_NEAR(events[1].lengthAfter, calcOver(-1), 1e-7);
    const State& state = stepper.getState();
    scene.system.realize(state, Stage::Position);
    EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::Solved) << scene.cable.explainStatus(state);
    EXPECT_TRUE(scene.cable.isTouched(state, cylinder));

    // Without a study: a function of the pose.
    State posed = scene.system.getDefaultState();
    for (const auto& [x, isTouched] : {std::pair(-2.0, true), std::pair(-1.2, false), std::pair(-0.9, true)}) {
        scene.slider.setOneQ(posed, 0, x);
        scene.system.realize(posed, Stage::Position);
        EXPECT_EQ(scene.cable.isTouched(posed, cylinder), isTouched);
        EXPECT_EQ(scene.cable.isActive(posed, cylinder), isTouched);
        EXPECT_EQ(scene.cable.getStatus(posed), PathStatus::Solved);
        EXPECT_NEAR(scene.cable.getLength(posed), isTouched ? calcOver(x) : std::hypot(1.5 - x, 0.2), 1e-12);
    }
}

}  // namespace
}  // namespace tautline::testing
