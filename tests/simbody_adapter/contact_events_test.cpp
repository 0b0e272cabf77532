#include <cstdio>

#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

using Kind = ContactEvent::Kind;

/** A string between two points of a slider that moves as h(t) = a sin(w t + phase) above the top of a fixed
obstacle of radius 0.5: it touches while h < 0. */
struct BobbingString : BareScene {
    explicit BobbingString(std::shared_ptr<const Surface> surface) {
        const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);  // a slider goes along x
        MobilizedBody::Slider slider(matter.Ground(), Transform(upward, SimTK::Vec3(0, 0.5, 0)), makeBody(),
                                     Transform(upward));
        SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, amplitude, frequency, phase);
        cable = Cable(cables, slider, SimTK::Vec3(-2, 0, 0), slider, SimTK::Vec3(1.5, 0, 0));
        obstacle = cable.addObstacle(matter.Ground(), Transform(), std::move(surface), SimTK::Vec3(0, 0.5, 0));
        cable.setContactListener([this](const ContactEvent& event) { events.push_back(event); });
    }

    /** @param accuracy   of the integrator */
    void simulate(Real accuracy, Real finalTime) {
        SimTK::RungeKuttaMersonIntegrator integrator(system);
        integrator.setAccuracy(accuracy);
        integrator.setMaximumStepSize(0.1);
        SimTK::TimeStepper stepper(system, integrator);
        stepper.initialize(system.realizeTopology());
        stepper.stepTo(finalTime);
        finalState = integrator.getState();
    }

    static constexpr Real amplitude = 0.3, frequency = 3, phase = 0.4;
    Cable cable;
    CableElementIndex obstacle;
    std::vector<ContactEvent> events;
    State finalState;
};

/** h is zero where 3 t + 0.4 is a multiple of pi; the tolerance of contact, 1e-10 of the radius below the
top, delays touchdown by about 1e-10 s. */
void expectEventsOnTime(const BobbingString& scene, int count, Real tolerance) {
    ASSERT_EQ(static_cast<int>(scene.events.size()), count);
    Real worst = 0, jump = 0;
    for (int i = 0; i < count; ++i) {
        const ContactEvent& event = scene.events[i];
        const Real expected = ((i + 1) * SimTK::Pi - scene.phase) / scene.frequency;
        EXPECT_EQ(event.kind, i % 2 == 0 ? Kind::Made : Kind::Lost);
        worst = std::max(worst, std::abs(event.time - expected));
        jump = std::max(jump, std::abs(event.lengthAfter - event.lengthBefore));
    }
    std::printf("[measured] worst event time error %.1e s, length jump %.1e m\n", worst, jump);
    EXPECT_LT(worst, tolerance);
    EXPECT_LT(jump, 1e-9);
}

TEST(ContactEvents, TouchdownAndLiftOffOfACylinderOnTime) {
    BobbingString scene(std::make_shared<Cylinder>(0.5));
    scene.simulate(1e-6, 6);
    expectEventsOnTime(scene, 5, 1e-6);
    EXPECT_EQ(scene.cable.getStatistics().numContactEvents, 5);
    EXPECT_TRUE(scene.cable.areContactsFixed(scene.finalState));
}

TEST(ContactEvents, OnTimeAtLooseAccuracyToo) {
    BobbingString scene(std::make_shared<Cylinder>(0.5));
    scene.simulate(1e-2, 6);
    expectEventsOnTime(scene, 5, 1e-6);
}

TEST(ContactEvents, TouchdownAndLiftOffOfEverySurfaceOnTime) {
    const std::shared_ptr<const Surface> surfaces[] = {std::make_shared<Sphere>(0.5),
                                                       std::make_shared<Ellipsoid>(Vec3(0.7, 0.5, 0.6))};
    for (const auto& surface : surfaces) {
        SCOPED_TRACE(surface->getDescription());
        BobbingString scene(surface);
        scene.simulate(1e-6, 6);
        expectEventsOnTime(scene, 5, 1e-6);
    }
}

TEST(ContactEvents, ABareIntegratorFixesContactsToo) {
    BobbingString scene(std::make_shared<Cylinder>(0.5));
    State state = scene.system.realizeTopology();
    EXPECT_FALSE(scene.cable.areContactsFixed(state));
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.initialize(state);
    EXPECT_TRUE(scene.cable.areContactsFixed(integrator.getState()));
    EXPECT_FALSE(scene.cable.areContactsFixed(state));
}

/** Counts how often the slider passes its middle, seen at Acceleration. */
class MiddleCounter : public SimTK::TriggeredEventHandler {
public:
    MiddleCounter(const SimTK::MobilizedBody& slider, int& count)
        : TriggeredEventHandler(Stage::Acceleration), m_slider(slider), m_count(count) {}
    Real getValue(const State& state) const override { return m_slider.getBodyOriginAcceleration(state)[1] + 0.5; }
    void handleEvent(State&, Real, bool&) const override { ++m_count; }

private:
    SimTK::MobilizedBody m_slider;
    int& m_count;
};

TEST(ContactEvents, AUsersHandlerAtALaterStageWorksBesideOurs) {
    BobbingString scene(std::make_shared<Cylinder>(0.5));
    int count = 0;
    scene.system.addEventHandler(new MiddleCounter(scene.matter.getMobilizedBody(SimTK::MobilizedBodyIndex(1)), count));
    scene.simulate(1e-6, 6);
    expectEventsOnTime(scene, 5, 1e-6);
    EXPECT_GE(count, 5);
}

TEST(ContactEvents, TheWitnessIsSmoothThroughTheEvent) {
    // With contacts fixed the witness passes zero with a finite slope, on both sides of the event.
    BobbingString scene(std::make_shared<Sphere>(0.5));
    State state = scene.system.realizeTopology();
    const auto calcWitness = [&](Real height, bool startsTouched) {
        State trial = state;
        trial.setTime((std::asin((startsTouched ? -0.01 : 0.01) / 0.3) - 0.4) / 3);
        scene.system.realize(trial, Stage::Time);
        scene.system.prescribeQ(trial);
        scene.system.realize(trial, Stage::Position);
        EXPECT_EQ(scene.cable.getWitness(trial, scene.obstacle), 1);
        scene.cable.fixContacts(trial);
        trial.setTime((std::asin(height / 0.3) - 0.4) / 3);
        scene.system.realize(trial, Stage::Time);
        scene.system.prescribeQ(trial);
        scene.system.realize(trial, Stage::Position);
        EXPECT_EQ(scene.cable.isTouched(trial, scene.obstacle), startsTouched);
        return scene.cable.getWitness(trial, scene.obstacle);
    };
    for (const bool startsTouched : {false, true}) {
        SCOPED_TRACE(startsTouched);
        const Real sign = startsTouched ? -1 : 1, h = 1e-4;
        const Real before = calcWitness(sign * h, startsTouched);
        const Real after = calcWitness(-sign * h, startsTouched);
        EXPECT_GT(before, 0);
        EXPECT_LT(after, 0);
        EXPECT_NEAR(-after / before, 1, 1e-2);
        EXPECT_NE(calcWitness(0, startsTouched), 0);
    }
}

TEST(ContactEvents, TwoObstaclesTouchedAtOneInstantAreBothFound) {
    BareScene scene;
    const SimTK::Rotation upward(SimTK::Pi / 2, SimTK::ZAxis);
    MobilizedBody::Slider slider(scene.matter.Ground(), Transform(upward, SimTK::Vec3(0, 0.5, 0)), makeBody(),
                                 Transform(upward));
    SimTK::Motion::Sinusoid(slider, SimTK::Motion::Position, 0.3, 3, 0.4);
    Cable cable(scene.cables, slider, SimTK::Vec3(-3, 0, 0), slider, SimTK::Vec3(3, 0, 0));
    int made = 0, lost = 0;
    for (const Real x : {-1.0, 1.0})
        cable.addObstacle(scene.matter.Ground(), Transform(SimTK::Vec3(x, 0, 0)), std::make_shared<Cylinder>(0.5));
    cable.setContactListener([&](const ContactEvent& event) {
        ++(event.kind == Kind::Made ? made : lost);
        EXPECT_LT(std::abs(event.lengthAfter - event.lengthBefore), 1e-9);
    });
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-6);
    integrator.setMaximumStepSize(0.1);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.system.realizeTopology());
    stepper.stepTo(6);
    EXPECT_EQ(made, 6);
    EXPECT_EQ(lost, 4);
}

}  // namespace
}  // namespace tautline::testing
