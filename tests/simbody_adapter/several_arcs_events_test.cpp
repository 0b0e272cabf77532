// SPDX-License-Identifier: Apache-2.0
/** A cable on a surface with hollows in a study over time: arcs split and join as events, none of which the length, the
force or the energy knows of. */
#include <cstdio>
#include <map>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/surfaces/function_surface.h"

namespace tautline::testing {
namespace {

using Kind = ContactEvent::Kind;

/** A sphere of radius 1 with two bumps beside its top, one before and one behind it along x:
f = |p| - 1 - h sum exp(-|p - bump|^2 / w^2). */
class BumpySphere final : public ImplicitSurface {
public:
    double getSize() const override { return 1; }
    std::string getDescription() const override { return "bumpy sphere"; }
    ImplicitValue calcImplicit(const Vector3& p) const override {
        constexpr double height = 0.05, w2 = 0.15 * 0.15;
        const double rho = p.norm();
        const Vector3 radial = p / rho;
        ImplicitValue value{rho - 1, radial, (Matrix3::Identity() - radial * radial.transpose()) / rho};
        for (const double side : {-1.0, 1.0}) {
            const Vector3 from = p - Vector3(side * std::sin(0.25), 0, std::cos(0.25));
            const double rise = height * std::exp(-from.squaredNorm() / w2);
            value.f -= rise;
            value.gradient += 2 * rise / w2 * from;
            value.hessian += 2 * rise / w2 * (Matrix3::Identity() - 2 / w2 * from * from.transpose());
        }
        return value;
    }
};

/** Nearly the same, of the direction in place of the point: there the string slides off a bump once. */
std::shared_ptr<const Surface> makeBumpsOfDirection() {
    constexpr double height = 0.05, width = 0.15, angle = 0.25;
    return std::make_shared<ImplicitFunctionSurface>(
        makeImplicitSurface("bumpy sphere", 1.0, [=](auto x, auto y, auto z) {
            const auto rho = sqrt(x * x + y * y + z * z);
            auto f = rho - 1;
            for (const double side : {-1.0, 1.0}) {
                const auto dx = x / rho - side * std::sin(angle), dy = y / rho, dz = z / rho - std::cos(angle);
                f = f - height * exp(-1 / (width * width) * (dx * dx + dy * dy + dz * dz));
            }
            return f;
        }));
}

/** A mass on springs draws an elastic string over the bumps, and swings across them. */
struct SwingAcrossBumps : BareScene {
    explicit SwingAcrossBumps(std::shared_ptr<const Surface> surface = std::make_shared<BumpySphere>()) {
        MobilizedBody::Translation mass(matter.Ground(), Transform(), makeBody(), Transform());
        body = mass;
        const Real stiffness[] = {40, 60, 50}, rest[] = {1.75, 0, 0.8};
        for (int i = 0; i < 3; ++i)
            SimTK::Force::MobilityLinearSpring(forces, mass, SimTK::MobilizerQIndex(i), stiffness[i], rest[i]);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1.6, 0, 0.8), mass, SimTK::Vec3(0));
        bumps = cable.addObstacle(matter.Ground(), Transform(), std::move(surface), SimTK::Vec3(0, 0, 1));
        ElasticStringForce(forces, cable, 10, 3.0, 0);
        cable.setContactListener([this](const ContactEvent& event) {
            ++numEvents[event.kind];
            jump = std::max(jump, std::abs(event.lengthAfter - event.lengthBefore));
            rateJump = std::max(rateJump, std::abs(event.rateAfter - event.rateBefore));
        });
    }
    State makeStart() {
        State state = system.realizeTopology();
        body.setQFromVector(state, SimTK::Vector(SimTK::Vec3(1.65, 0.4, 0.82)));
        return state;
    }

    MobilizedBody body;
    Cable cable;
    CableElementIndex bumps;
    std::map<Kind, int> numEvents;
    Real jump = 0, rateJump = 0;
};

/** @return the largest error of the energy over the largest kinetic energy */
Real swing(SwingAcrossBumps& scene, Real finalTime) {
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-11);
    integrator.setMaximumStepSize(0.004);  // at each event Simbody loses (frequency x step)^4 (energy_test.cpp)
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    const Real initial = scene.system.calcEnergy(integrator.getState());
    Real worst = 0, largestKinetic = 0;
    for (int i = 1; 0.01 * i <= finalTime; ++i) {
        stepper.stepTo(0.01 * i);
        const State& state = stepper.getState();
        scene.system.realize(state, Stage::Dynamics);
        scene.cables.countStep(state);
        worst = std::max(worst, std::abs(scene.system.calcEnergy(state) - initial));
        largestKinetic = std::max(largestKinetic, scene.system.calcKineticEnergy(state));
    }
    const CableStatistics statistics = scene.cable.getStatistics();
    std::printf(
        "[measured] energy error %.1e of %.2g J; %d splits, %d joins; jumps %.1e m, %.1e m/s; %.1f us a solve\n",
        worst / largestKinetic, largestKinetic, scene.numEvents[Kind::Split], scene.numEvents[Kind::Joined], scene.jump,
        scene.rateJump, 1e6 * statistics.seconds / double(statistics.numSolves));
    EXPECT_EQ(statistics.numFailures, 0);
    EXPECT_EQ(statistics.numDegradedSteps, 0);
    EXPECT_EQ(statistics.numSlips, 0);
    EXPECT_LT(scene.jump, 1e-12);
    EXPECT_LT(scene.rateJump, 1e-9);
    return worst / largestKinetic;
}

TEST(SeveralArcsInTime, SplitAndJoinWithoutAJumpOfLengthRateOrEnergy) {
    SwingAcrossBumps scene;
    EXPECT_LT(swing(scene, 1.5), 1e-8);
    EXPECT_GE(scene.numEvents[Kind::Split], 3);
    EXPECT_GE(scene.numEvents[Kind::Joined], 3);
}

// 2026-11-27: the path came to its end, as the square root of time, and the next one was taken for it without a word:
// shorter by 4.4e-5 m, and by 1.3e-4 J in the energy.
TEST(SeveralArcsInTime, SlipFromAPathThatComesToItsEnd) {
    SwingAcrossBumps scene(makeBumpsOfDirection());
    std::vector<ContactEvent> slips;
    scene.cable.setContactListener([&](const ContactEvent& event) {
        if (event.kind == Kind::Slipped) slips.push_back(event);
    });
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    integrator.setMaximumStepSize(0.01);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    const Real initial = scene.system.calcEnergy(integrator.getState());
    stepper.stepTo(0.23);
    const State& state = stepper.getState();
    scene.system.realize(state, Stage::Dynamics);
    ASSERT_EQ(slips.size(), 1u);
    EXPECT_EQ(slips[0].obstacle, scene.bumps);
    EXPECT_NEAR(slips[0].time, 0.2021, 1e-4);
    EXPECT_NEAR(slips[0].lengthBefore - slips[0].lengthAfter, 4.4e-5, 2e-6);
    EXPECT_EQ(scene.cable.getStatistics().numSlips, 1);
    // The string's energy is k (L - L0)^2 / 2.
    const auto calcEnergy = [](Real length) { return 5 * (length - 3) * (length - 3); };
    EXPECT_NEAR(scene.system.calcEnergy(state) - initial,
                calcEnergy(slips[0].lengthAfter) - calcEnergy(slips[0].lengthBefore), 5e-6);
    EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::Solved);
}

TEST(LongSeveralArcsInTime, KeepTheirEnergyForTwentySeconds) {
    SwingAcrossBumps scene;
    EXPECT_LT(swing(scene, 20), 1e-8);
    EXPECT_GE(scene.numEvents[Kind::Split] + scene.numEvents[Kind::Joined], 20);
}

// Beside the bumps there is one arc, over them two; each knows its own ends, and both together their length.
TEST(SeveralArcsInTime, AreCountedAndAskedForOneByOne) {
    SwingAcrossBumps scene;
    State state = scene.makeStart();
    scene.body.setQFromVector(state, SimTK::Vector(SimTK::Vec3(1.6, 0.05, 0.8)));
    scene.system.realize(state, Stage::Position);
    ASSERT_EQ(scene.cable.getNumArcs(state, scene.bumps), 2);
    Real length = 0;
    SimTK::Vec3 last(-2, 0, 0), P, Q;
    SimTK::Transform X_GP, X_GQ;
    SimTK::UnitVec3 atP, atQ;
    for (int arc = 0; arc < 2; ++arc) {
        ASSERT_TRUE(scene.cable.getContactPoints(state, scene.bumps, P, Q, arc));
        ASSERT_TRUE(scene.cable.getContactFrames(state, scene.bumps, X_GP, X_GQ, arc));
        ASSERT_TRUE(scene.cable.getContactTangents(state, scene.bumps, atP, atQ, arc));
        EXPECT_LT((X_GP.p() - P).norm() + (X_GQ.p() - Q).norm(), 1e-14);
        EXPECT_LT((SimTK::Vec3(X_GP.x()) - SimTK::Vec3(atP)).norm(), 1e-14);
        EXPECT_LT(last[0], P[0]);
        EXPECT_LT(P[0], Q[0]);
        const auto points = scene.cable.calcResampledArc(state, scene.bumps, 50, arc);
        for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
        last = Q;
    }
    EXPECT_NEAR(scene.cable.getArcLength(state, scene.bumps), length, 1e-6);
    EXPECT_FALSE(scene.cable.getContactPoints(state, scene.bumps, P, Q, 2));
    EXPECT_NE(catchMessage([&] { scene.cable.calcResampledArc(state, scene.bumps, 5, 2); }).find("arc 2"),
              std::string::npos);
    EXPECT_NE(catchMessage([&] { scene.cable.getContactPoints(state, scene.bumps, P, Q, -1); }).find("arc -1"),
              std::string::npos);
    scene.body.setQFromVector(state, SimTK::Vector(SimTK::Vec3(1.6, 0.4, 0.8)));
    scene.system.realize(state, Stage::Position);
    EXPECT_EQ(scene.cable.getNumArcs(state, scene.bumps), 1);
}

}  // namespace
}  // namespace tautline::testing
