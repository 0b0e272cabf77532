// SPDX-License-Identifier: Apache-2.0
/** Points that move on their bodies, and points that count only under a condition. */
#include <cstdio>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

/** x(q) = c + (a sin q, b cos q, c q^2) and its slope. */
std::shared_ptr<CoordinateStation> makeStation(const MobilizedBody& coordinate, const SimTK::Vec3& center) {
    return std::make_shared<CoordinateStation>(
        coordinate, SimTK::MobilizerQIndex(0), SimTK::MobilizerUIndex(0),
        [center](Real q) { return center + SimTK::Vec3(0.2 * std::sin(q), 0.1 * std::cos(q), 0.05 * q * q); },
        [](Real q) { return SimTK::Vec3(0.2 * std::cos(q), -0.1 * std::sin(q), 0.1 * q); });
}

/** A cable whose origin, a point on the way and insertion move with three coordinates, over a sphere. Nobody holds
the bodies but a spring on each coordinate. */
struct MovingScene : BareScene {
    explicit MovingScene(bool hasForce = false) {
        MobilizedBody ground = matter.Ground();
        first = MobilizedBody::Pin(ground, Transform(SimTK::Vec3(-1.5, 0, 0)), makeBody(), Transform());
        second = MobilizedBody::Pin(ground, Transform(SimTK::Vec3(1.2, 0.1, 0)), makeBody(), Transform());
        third = MobilizedBody::Slider(second, Transform(SimTK::Vec3(1, 0, 0.1)), makeBody(), Transform());
        cable = Cable(cables, first, SimTK::Vec3(0), third, SimTK::Vec3(0), "moving");
        cable.setMovingOrigin(makeStation(second, SimTK::Vec3(-0.2, 0.1, 0)));
        sphere = cable.addObstacle(ground, Transform(), std::make_shared<Sphere>(0.4), SimTK::Vec3(0, 0.4, 0));
        point = cable.addMovingPoint(second, makeStation(third, SimTK::Vec3(0, 0.05, 0.1)), "slot");
        cable.setMovingInsertion(makeStation(first, SimTK::Vec3(0.3, 0, 0)));
        for (const MobilizedBody& body : {first, second, third})
            SimTK::Force::MobilityLinearSpring(forces, body, SimTK::MobilizerUIndex(0), 3, 0.1);
        if (hasForce) ElasticStringForce(forces, cable, 2, 3);
        system.realizeTopology();
    }

    State makeState(Real number) {
        State state = system.getDefaultState();
        for (int i = 0; i < state.getNQ(); ++i) state.updQ()[i] = 0.3 * std::sin(number + 1.9 * i);
        for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = 0.8 * std::cos(number - i);
        return state;
    }

    MobilizedBody first, second, third;
    Cable cable;
    CableElementIndex sphere, point;
};

TEST(MovingPoints, AreWhereTheirCoordinatePutsThem) {
    MovingScene scene;
    State state = scene.makeState(0.4);
    scene.system.realize(state, Stage::Position);
    ASSERT_TRUE(scene.cable.isTouched(state, scene.sphere));
    const Real q = scene.third.getOneQ(state, 0);
    const SimTK::Vec3 station(0.2 * std::sin(q), 0.05 + 0.1 * std::cos(q), 0.1 + 0.05 * q * q);
    EXPECT_LT((scene.cable.calcStation(state, scene.point) - station).norm(), 1e-15);
    const SimTK::Vec3 point_G = scene.second.findStationLocationInGround(state, station);
    Real nearest = 1;
    for (const SimTK::Vec3& p : scene.cable.calcDrawingPoints(state)) nearest = std::min(nearest, (p - point_G).norm());
    EXPECT_LT(nearest, 1e-14);
}

TEST(MovingPoints, RateIsTheDerivativeOfLength) {
    MovingScene scene;
    Real worst = 0;
    for (const Real number : {0.0, 0.8, 1.6, 2.4, 3.2}) {
        State state = scene.makeState(number);
        scene.system.realize(state, Stage::Velocity);
        const Real rate = scene.cable.getLengthRate(state), h = 1e-5;
        Real length[2];
        for (const int side : {0, 1}) {
            State moved = state;
            moved.updQ() = state.getQ() + (side ? h : -h) * state.getQDot();
            scene.system.realize(moved, Stage::Position);
            length[side] = scene.cable.getLength(moved);
        }
        worst = std::max(worst, std::abs((length[1] - length[0]) / (2 * h) - rate));
    }
    std::printf("[measured] rate against difference quotient: %.1e m/s\n", worst);
    EXPECT_LT(worst, 1e-9);
}

TEST(MovingPoints, MobilityForcesAreTheSlopeOfTheLengthAndThePowerIsRight) {
    MovingScene scene;
    for (const Real number : {0.3, 1.7, 2.9}) {
        State state = scene.makeState(number);
        scene.system.realize(state, Stage::Velocity);
        SimTK::Vector f;
        scene.cable.calcUnitMobilityForces(state, f);
        MobilityScrews screws;
        screws.update(scene.matter, state);
        SimTK::Vector byScrews;
        scene.cable.calcUnitMobilityForces(state, screws, byScrews);
        EXPECT_LT((byScrews - f).norm(), 1e-14 * f.size());
        for (int i = 0; i < state.getNQ(); ++i) {
            Real length[2];
            const Real h = 1e-5;
            for (const int side : {0, 1}) {
                State moved = state;
                moved.updQ()[i] += side ? h : -h;
                scene.system.realize(moved, Stage::Position);
                length[side] = scene.cable.getLength(moved);
            }
            EXPECT_NEAR(f[i], -(length[1] - length[0]) / (2 * h), 1e-9);
        }
        const Real rate = scene.cable.getLengthRate(state);
        EXPECT_NEAR(scene.cable.calcPower(state, 20), -20 * rate, 20e-12);
        // The bodies' share alone does not account for it.
        SimTK::Vector onlyBodies;
        SimTK::Vector_<SimTK::SpatialVec> F_G;
        scene.cable.calcUnitBodyForces(state, F_G);
        scene.matter.multiplyBySystemJacobianTranspose(state, F_G, onlyBodies);
        EXPECT_GT(std::abs(~onlyBodies * state.getU() + rate), 1e-3);
    }
}

TEST(MovingPoints, EnergyIsKept) {
    MovingScene scene(true);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeState(0.5));
    const Real initial = scene.system.calcEnergy(integrator.getState());
    Real worst = 0, largestKinetic = 0;
    for (int i = 1; i <= 100; ++i) {
        stepper.stepTo(0.1 * i);
        scene.system.realize(integrator.getState(), Stage::Dynamics);
        worst = std::max(worst, std::abs(scene.system.calcEnergy(integrator.getState()) - initial));
        largestKinetic = std::max(largestKinetic, scene.system.calcKineticEnergy(integrator.getState()));
    }
    std::printf("[measured] energy error with moving points: %.1e of the largest kinetic energy, %ld contact events\n",
                worst / largestKinetic, scene.cable.getStatistics().numContactEvents);
    EXPECT_LT(worst, 1e-8 * largestKinetic);
}

/** A cable from ground to a slider at x, over an eyelet above its way that counts while x < 2. */
struct ConditionalScene : BareScene {
    ConditionalScene() {
        slider = MobilizedBody::Slider(matter.Ground(), Transform(), makeBody(), Transform());
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-2, 0, 0), slider, SimTK::Vec3(0));
        sphere = cable.addObstacle(matter.Ground(), SimTK::Vec3(-1, -0.3, 0), std::make_shared<Sphere>(0.4),
                                   SimTK::Vec3(0, 0.4, 0));
        const MobilizedBody body = slider;
        point = cable.addConditionalPoint(
            matter.Ground(), SimTK::Vec3(0, 1, 0), [body](const State& state) { return body.getOneQ(state, 0) < 2; },
            "eyelet");
        system.realizeTopology();
    }

    State makeState(Real x) {
        State state = system.getDefaultState();
        slider.setOneQ(state, 0, x);
        system.realize(state, Stage::Position);
        return state;
    }

    MobilizedBody slider;
    Cable cable;
    CableElementIndex sphere, point;
};

/** Over a sphere of radius 0.4 from (-1, 0.3) and (1 + x, 0.3) about its center. */
Real calcLengthOverSphere(Real x) {
    const Real a = std::hypot(1, 0.3), b = std::hypot(1 + x, 0.3);
    const Real arc = SimTK::Pi - std::atan(0.3) - std::atan2(0.3, 1 + x) - std::acos(0.4 / a) - std::acos(0.4 / b);
    return std::sqrt(a * a - 0.16) + std::sqrt(b * b - 0.16) + 0.4 * arc;
}

TEST(ConditionalPoints, ArePassedOverWhereTheirConditionIsFalse) {
    ConditionalScene scene;
    State inside = scene.makeState(1.5), outside = scene.makeState(2.5);
    EXPECT_TRUE(scene.cable.isActive(inside, scene.point));
    EXPECT_FALSE(scene.cable.isTouched(inside, scene.sphere));
    EXPECT_NEAR(scene.cable.getLength(inside), std::hypot(2, 1) + std::hypot(1.5, 1), 1e-14);
    EXPECT_FALSE(scene.cable.isActive(outside, scene.point));
    EXPECT_TRUE(scene.cable.isTouched(outside, scene.sphere));
    EXPECT_NEAR(scene.cable.getLength(outside), calcLengthOverSphere(2.5), 1e-13);
    EXPECT_EQ(scene.cable.calcUnitForceAboutElementOrigin(outside, scene.point).norm(), 0);
    EXPECT_GT(scene.cable.calcUnitForceAboutElementOrigin(inside, scene.point).norm(), 0.5);
}

TEST(ConditionalPoints, AStudyStopsWhereTheConditionChangesAndContactsFollow) {
    ConditionalScene scene;
    std::vector<ContactEvent> events;
    scene.cable.setContactListener([&](const ContactEvent& event) { events.push_back(event); });
    scene.system.realizeTopology();
    State state = scene.makeState(1);
    scene.slider.setOneU(state, 0, 1.5);  // passes 2 after 2/3 s
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-4);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(state);
    stepper.stepTo(1);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, ContactEvent::Kind::Made);
    EXPECT_NEAR(events[0].time, 2.0 / 3, 1e-9);
    EXPECT_NEAR(scene.cable.getLength(integrator.getState()), calcLengthOverSphere(2.5), 1e-10);
}

TEST(MovingPoints, RefuseWhatIsEmpty) {
    BareScene scene;
    MobilizedBody ground = scene.matter.Ground();
    Cable cable(scene.cables, ground, SimTK::Vec3(0), ground, SimTK::Vec3(1), "c");
    EXPECT_MESSAGE(cable.addMovingPoint(ground, nullptr, "m"), "cable 'c': the moving point 'm' has no station");
    EXPECT_MESSAGE(cable.addConditionalPoint(ground, SimTK::Vec3(0), nullptr, "n"),
                   "cable 'c': the conditional point 'n' has no condition");
    EXPECT_MESSAGE(cable.setMovingOrigin(nullptr), "the moving origin has no station");
    EXPECT_MESSAGE(cable.setMovingInsertion(nullptr), "the moving insertion has no station");
    EXPECT_MESSAGE(CoordinateStation(ground, SimTK::MobilizerQIndex(0), SimTK::MobilizerUIndex(0), nullptr, nullptr),
                   "a function is empty");
    EXPECT_EQ(cable.getNumElements(), 2);
}

}  // namespace
}  // namespace tautline::testing
