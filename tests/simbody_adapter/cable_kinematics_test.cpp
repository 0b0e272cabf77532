// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <thread>
#include <type_traits>
#include <utility>

#include "adapter_scenes.h"
#include "tautline/surfaces/bspline_patch.h"

namespace tautline::testing {
namespace {

TEST(CableKinematics, AllObstaclesOfTheMechanismAreTouched) {
    MechanismScene scene;
    for (const Real number : {0.0, 1.0, 2.0, 3.0}) {
        State state = scene.makeState(number);
        scene.system.realize(state, Stage::Position);
        EXPECT_EQ(scene.cable.getStatus(state), PathStatus::Solved);
        EXPECT_TRUE(scene.cable.calcVerification(state).isMinimum());
        EXPECT_TRUE(scene.cable.isTouched(state, scene.sphere));
        EXPECT_TRUE(scene.cable.isTouched(state, scene.cylinder));
        EXPECT_TRUE(scene.cable.isTouched(state, scene.ellipsoid));
        SimTK::Vec3 P_G, Q_G;
        ASSERT_TRUE(scene.cable.getContactPoints(state, scene.sphere, P_G, Q_G));
        EXPECT_GT(scene.cable.getArcLength(state, scene.sphere), (Q_G - P_G).norm());
        EXPECT_LT(scene.cable.getPathError(state), 1e-11);
    }
}

/** Drifts every coordinate with its own speed, quaternions as the speeds turn them. */
State drift(const MechanismScene& scene, const State& state, Real time) {
    State moved = state;
    scene.system.realize(state, Stage::Velocity);
    moved.updQ() = state.getQ() + time * state.getQDot();
    scene.system.realize(moved, Stage::Time);
    scene.matter.normalizeQuaternions(moved);
    scene.system.realize(moved, Stage::Velocity);
    return moved;
}

TEST(CableKinematics, RateIsTheDerivativeOfLength) {
    MechanismScene scene;
    Real worst = 0;
    for (const Real number : {0.0, 0.7, 1.4, 2.1, 2.8}) {
        const State state = scene.makeState(number);
        // Central difference: truncation h^2/6 L''' and rounding 1e-15/h balance near 1e-5.
        const Real h = 1e-5;
        const Real difference =
            (scene.cable.getLength(drift(scene, state, h)) - scene.cable.getLength(drift(scene, state, -h))) / (2 * h);
        const Real rate = scene.cable.getLengthRate(state);
        worst = std::max(worst, std::abs(rate - difference) / std::abs(rate));
    }
    std::printf("[measured] rate against difference quotient: %.1e\n", worst);
    EXPECT_LT(worst, 1e-7);
}

TEST(CableKinematics, PowerOfTheForcesIsMinusTensionTimesRate) {
    MechanismScene scene;
    for (const Real number : {0.0, 0.7, 1.4, 2.1}) {
        State state = scene.makeState(number);
        scene.system.realize(state, Stage::Velocity);
        const Real rate = scene.cable.getLengthRate(state);
        EXPECT_NEAR(scene.cable.calcPower(state, 50), -50 * rate, 50e-10 * std::abs(rate));
        SimTK::Vector f;
        scene.cable.calcUnitMobilityForces(state, f);
        EXPECT_NEAR(~f * state.getU(), -rate, 1e-10 * std::abs(rate));
    }
}

TEST(CableKinematics, MobilityForcesByScrewsAreThoseByTheJacobian) {
    MechanismScene scene;
    MobilityScrews screws;
    for (const Real number : {0.0, 0.7, 1.4, 2.1}) {
        State state = scene.makeState(number);
        scene.system.realize(state, Stage::Position);
        screws.update(scene.matter, state);
        SimTK::Vector byJacobian, byScrews;
        scene.cable.calcUnitMobilityForces(state, byJacobian);
        scene.cable.calcUnitMobilityForces(state, screws, byScrews);
        ASSERT_EQ(byScrews.size(), byJacobian.size());
        EXPECT_GT(byJacobian.norm(), 0.1);
        EXPECT_LT((byScrews - byJacobian).norm(), 1e-14 * byJacobian.size());
    }
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    SimTK::Vector f;
    EXPECT_THROW(scene.cable.calcUnitMobilityForces(state, MobilityScrews(), f), InvalidInput);
}

TEST(CableKinematics, ForcesAndMomentsBalance) {
    MechanismScene scene;
    State state = scene.makeState(0.3);
    scene.system.realize(state, Stage::Position);
    SimTK::Vector_<SimTK::SpatialVec> F_G;
    scene.cable.calcUnitBodyForces(state, F_G);
    SimTK::Vec3 force(0), moment(0);
    for (SimTK::MobilizedBodyIndex b(0); b < F_G.size(); ++b) {
        const SimTK::Vec3 p_GB = scene.matter.getMobilizedBody(b).getBodyOriginLocation(state);
        force += F_G[b][1];
        moment += F_G[b][0] + p_GB % F_G[b][1];
    }
    EXPECT_LT(force.norm(), 1e-14);
    EXPECT_LT(moment.norm(), 1e-13);
    SimTK::Vector_<SimTK::SpatialVec> applied = 2.0 * F_G;
    scene.cable.applyBodyForces(state, 3, applied);
    for (SimTK::MobilizedBodyIndex b(0); b < F_G.size(); ++b) EXPECT_LT((applied[b] - 5.0 * F_G[b]).norm(), 1e-14);
}

/** A cable between two free bodies over one or two more, and with everything in motion. */
struct CableOfFreeBodies : BareScene {
    CableOfFreeBodies(const std::vector<std::shared_ptr<const Surface>>& surfaces, const Vector3& hint_S,
                      const PathSolverOptions& options = {}) {
        for (std::size_t i = 0; i < surfaces.size() + 2; ++i)
            bodies.push_back(MobilizedBody::Free(matter.Ground(), Transform(), makeBody(), Transform()));
        cable = Cable(cables, bodies.front(), SimTK::Vec3(0.2, -0.1, 0.3), bodies.back(), SimTK::Vec3(0.1, 0, 0.2));
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            cable.addObstacle(bodies[i + 1], SimTK::Vec3(0.1, 0.2, -0.3), surfaces[i], PassNear{hint_S});
        cable.setOptions(options);
    }
    /** @param places   of the bodies' stations in ground */
    State makeState(const std::vector<SimTK::Vec3>& places) {
        State state = system.realizeTopology();
        pose(state, places);
        return state;
    }
    void pose(State& state, const std::vector<SimTK::Vec3>& places) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const SimTK::Vec3 station = cable.getElementFrame(CableElementIndex(static_cast<int>(i))).p();
            bodies[i].setQToFitTranslation(state, places[i] - station);
        }
        for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = std::sin(1 + 2.3 * i);
        system.realize(state, Stage::Velocity);
    }
    std::vector<MobilizedBody::Free> bodies;
    Cable cable;
};

/** Whatever the path is that is returned: its forces balance, and their power is that of its own rate. */
void expectBalancedWithItsOwnRate(const CableOfFreeBodies& scene, const State& state, PathStatus status) {
    ASSERT_EQ(scene.cable.calcStatus(state), status) << getName(scene.cable.calcStatus(state));
    EXPECT_TRUE(std::isfinite(scene.cable.getLength(state)));
    SimTK::Vector_<SimTK::SpatialVec> F_G;
    scene.cable.calcUnitBodyForces(state, F_G);
    SimTK::Vec3 force(0), moment(0);
    Real power = 0;
    for (SimTK::MobilizedBodyIndex b(0); b < F_G.size(); ++b) {
        const MobilizedBody& body = scene.matter.getMobilizedBody(b);
        force += F_G[b][1];
        moment += F_G[b][0] + body.getBodyOriginLocation(state) % F_G[b][1];
        power += ~F_G[b] * body.getBodyVelocity(state);
    }
    EXPECT_LT(force.norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-12);
    EXPECT_NEAR(power, -scene.cable.getLengthRate(state), 1e-12);
    EXPECT_NEAR(scene.cable.calcPower(state, 7), -7 * scene.cable.getLengthRate(state), 1e-12);
}

/** One iteration is not enough for the solver, and the best path that it met is what pulls. */
TEST(CableKinematics, APathThatHasNotConvergedBalancesAndHasItsOwnRateAndPower) {
    PathSolverOptions options;
    options.maxIterations = 1;
    CableOfFreeBodies scene({std::make_shared<Cylinder>(1), std::make_shared<Torus>(1, 0.4)}, Vector3(0, 1, 0),
                            options);
    expectBalancedWithItsOwnRate(scene,
                                 scene.makeState({SimTK::Vec3(-3, 0, 0), SimTK::Vec3(-1, 0, 0), SimTK::Vec3(2, -0.5, 0),
                                                  SimTK::Vec3(4, 0.1, 0.3)}),
                                 PathStatus::NotConverged);
}

TEST(CableKinematics, APathWhoseEndIsInsideAnObstacleBalancesAndHasItsOwnRateAndPower) {
    CableOfFreeBodies scene({std::make_shared<Sphere>(1)}, Vector3(0, 1, 0));
    expectBalancedWithItsOwnRate(scene,
                                 scene.makeState({SimTK::Vec3(-3, 0, 0), SimTK::Vec3(0), SimTK::Vec3(0.2, 0.4, 0.1)}),
                                 PathStatus::EndInside);
}

/** Lowered onto the near tube of a ring while it lies on the far one: one arc cannot describe it. */
TEST(CableKinematics, APathThatIsNoMinimumBalancesAndHasItsOwnRateAndPower) {
    CableOfFreeBodies scene({std::make_shared<Torus>(1, 0.2)}, Vector3(1, 0, 0.2));
    State state = scene.makeState({SimTK::Vec3(-3, 0, 1), SimTK::Vec3(0), SimTK::Vec3(2, 0, -0.6)});
    scene.cable.fixContacts(state);
    scene.pose(state, {SimTK::Vec3(-3, 0, 0.1), SimTK::Vec3(0), SimTK::Vec3(2, 0, -0.6)});
    expectBalancedWithItsOwnRate(scene, state, PathStatus::NotMinimum);
}

TEST(CableKinematics, APathThatHasLeftItsDomainBalancesAndHasItsOwnRateAndPower) {
    Eigen::MatrixXd heights(5, 5);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j) heights(i, j) = -0.2 * (SimTK::square(i - 2) + SimTK::square(j - 2)) / 4;
    CableOfFreeBodies scene(
        {std::make_shared<BSplinePatch>(BSplinePatch::interpolateHeights({Vector2(-1, -1), Vector2(1, 1)}, heights))},
        Vector3(1.2, 0, -0.2));
    expectBalancedWithItsOwnRate(
        scene, scene.makeState({SimTK::Vec3(0.7, -3, -1.3), SimTK::Vec3(0), SimTK::Vec3(1.25, 3, -1.3)}),
        PathStatus::LeftDomain);
}

TEST(CableKinematics, MomentArmIsMinusTheDerivativeOfLength) {
    MechanismScene scene;
    const State state = scene.makeState(0.4);
    scene.system.realize(state, Stage::Position);
    const SimTK::MobilizedBodyIndex pinned(1), slider(4);
    for (const SimTK::MobilizedBodyIndex body : {pinned, slider}) {
        const Real h = 1e-5;
        Real length[2];
        for (int side : {0, 1}) {
            State moved = state;
            const MobilizedBody& mobilizedBody = scene.matter.getMobilizedBody(body);
            const Real q = mobilizedBody.getOneQ(state, 0);
            mobilizedBody.setOneQ(moved, 0, q + (side ? h : -h));
            scene.system.realize(moved, Stage::Position);
            length[side] = scene.cable.getLength(moved);
        }
        EXPECT_NEAR(scene.cable.calcMomentArm(state, body, SimTK::MobilizerUIndex(0)),
                    -(length[1] - length[0]) / (2 * h), 1e-8);
    }
    EXPECT_MESSAGE(scene.cable.calcMomentArm(state, slider, SimTK::MobilizerUIndex(1)), "has no mobility 1");
}

TEST(CableKinematics, AnAnswerDoesNotDependOnWhatWasAskedBefore) {
    MechanismScene scene;
    std::vector<Real> forward, backward;
    State wandering = scene.system.getDefaultState();
    for (int i = 0; i < 8; ++i) {
        wandering.updQ() = scene.makeState(i).getQ();
        scene.system.realize(wandering, Stage::Position);
        forward.push_back(scene.cable.getLength(wandering));
    }
    for (int i = 7; i >= 0; --i) {
        wandering.updQ() = scene.makeState(i).getQ();
        scene.system.realize(wandering, Stage::Position);
        backward.push_back(scene.cable.getLength(wandering));
    }
    for (int i = 0; i < 8; ++i) EXPECT_EQ(forward[i], backward[7 - i]);
}

TEST(CableKinematics, TrialsWithFixedContactsDoNotDependOnTheirOrder) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    scene.cable.fixContacts(state);
    EXPECT_TRUE(scene.cable.areContactsFixed(state));
    const auto calcLength = [&](Real number) {
        state.updQ() = scene.makeState(number).getQ();
        scene.system.realize(state, Stage::Position);
        return scene.cable.getLength(state);
    };
    const Real first = calcLength(0.1), far = calcLength(2.5);
    EXPECT_EQ(calcLength(0.1), first);
    EXPECT_EQ(calcLength(2.5), far);
    // With contacts free the start is another, and so is the rounding, no more.
    scene.cable.releaseContacts(state);
    EXPECT_NEAR(calcLength(2.5), far, 1e-13);
}

TEST(CableKinematics, StatesAreIndependentAndCopiesAlike) {
    MechanismScene scene;
    State a = scene.makeState(0.2), b = scene.makeState(2.2);
    scene.system.realize(a, Stage::Velocity);
    const Real length = scene.cable.getLength(a), rate = scene.cable.getLengthRate(a);
    scene.system.realize(b, Stage::Velocity);
    EXPECT_NE(scene.cable.getLength(b), length);
    EXPECT_EQ(scene.cable.getLength(a), length);
    scene.cable.fixContacts(b);
    EXPECT_FALSE(scene.cable.areContactsFixed(a));
    const State copy = a;
    scene.system.realize(copy, Stage::Velocity);
    EXPECT_EQ(scene.cable.getLength(copy), length);
    EXPECT_EQ(scene.cable.getLengthRate(copy), rate);
}

TEST(CableKinematics, ThreadsRealizeStatesSideBySide) {
    MechanismScene scene;
    constexpr int n = 6;
    std::vector<State> states;
    std::vector<Real> expected(n), found(n);
    for (int i = 0; i < n; ++i) {
        states.push_back(scene.makeState(i));
        State alone = states.back();
        scene.system.realize(alone, Stage::Velocity);
        expected[i] = scene.cable.getLengthRate(alone);
    }
    std::vector<std::thread> threads;
    for (int i = 0; i < n; ++i)
        threads.emplace_back([&, i] {
            scene.system.realize(states[i], Stage::Velocity);
            found[i] = scene.cable.getLengthRate(states[i]);
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
}

TEST(CableKinematics, DrawingPointsFollowThePath) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    Real length = 0;
    const std::vector<SimTK::Vec3> points_G = scene.cable.calcDrawingPoints(state, 0.01);
    for (std::size_t i = 1; i < points_G.size(); ++i) length += (points_G[i] - points_G[i - 1]).norm();
    // A polygon of arcs turned by 0.01 is short by 0.01^2/24 of them.
    EXPECT_NEAR(length, scene.cable.getLength(state), 1e-5);
}

TEST(CableKinematics, ForcesOfElementsAddUpToThoseOfBodiesAndTurnWithTheirPoint) {
    MechanismScene scene;
    const State state = scene.makeState(0.3);
    scene.system.realize(state, Stage::Position);
    SimTK::Vector_<SimTK::SpatialVec> expected, sum(scene.matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0)));
    scene.cable.calcUnitBodyForces(state, expected);
    for (CableElementIndex e(0); e < scene.cable.getNumElements(); ++e) {
        const SimTK::MobilizedBody& body = scene.matter.getMobilizedBody(scene.cable.getElementBody(e));
        const SimTK::SpatialVec aboutBody = scene.cable.calcUnitForceAboutBodyOrigin(state, e);
        const SimTK::SpatialVec aboutElement = scene.cable.calcUnitForceAboutElementOrigin(state, e);
        sum[body.getMobilizedBodyIndex()] += aboutBody;
        const SimTK::Vec3 arm = body.getBodyRotation(state) * scene.cable.getElementFrame(e).p();
        EXPECT_LT((aboutBody[0] - aboutElement[0] - arm % aboutElement[1]).norm(), 1e-14);
        EXPECT_EQ(aboutBody[1], aboutElement[1]);
    }
    for (int b = 0; b < sum.size(); ++b) EXPECT_LT((sum[b] - expected[b]).norm(), 1e-14);
}

// What is asked of a Cable in a study is told in Simbody's own types.
TEST(CableKinematics, TangentsAreUnitVectorsOfSimbody) {
    static_assert(std::is_same_v<decltype(std::declval<Cable>().calcOriginTangent(State())), SimTK::UnitVec3>);
    static_assert(std::is_same_v<decltype(std::declval<Cable>().calcInsertionTangent(State())), SimTK::UnitVec3>);
    MechanismScene scene;
    const State state = scene.makeState(1);
    scene.system.realize(state, Stage::Position);
    const std::vector<SimTK::Vec3> points = scene.cable.calcDrawingPoints(state);
    const std::size_t n = points.size();
    const SimTK::UnitVec3 out(points[1] - points[0]), in(points[n - 1] - points[n - 2]);
    EXPECT_LT((SimTK::Vec3(scene.cable.calcOriginTangent(state)) - SimTK::Vec3(out)).norm(), 1e-12);
    EXPECT_LT((SimTK::Vec3(scene.cable.calcInsertionTangent(state)) - SimTK::Vec3(in)).norm(), 1e-12);
    // At both ends of an arc the path goes on in the direction of its segments.
    SimTK::UnitVec3 atP, atQ;
    SimTK::Vec3 P, Q;
    for (const CableElementIndex obstacle : {scene.sphere, scene.cylinder, scene.ellipsoid}) {
        ASSERT_TRUE(scene.cable.getContactTangents(state, obstacle, atP, atQ));
        ASSERT_TRUE(scene.cable.getContactPoints(state, obstacle, P, Q));
        for (std::size_t k = 1; k + 1 < n; ++k) {
            if ((points[k] - P).norm() < 1e-12) {
                EXPECT_LT(((points[k] - points[k - 1]).normalize() % atP).norm(), 1e-9);
            }
            if ((points[k] - Q).norm() < 1e-12) {
                EXPECT_LT(((points[k + 1] - points[k]).normalize() % atQ).norm(), 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace tautline::testing
