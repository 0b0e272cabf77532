// SPDX-License-Identifier: Apache-2.0
/** An answer is a function of its State: not of what was tried before it, nor of what other States, Systems and
threads do. All comparisons are bit by bit. */
#include <algorithm>
#include <random>
#include <thread>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

/** What a cable says in one State, as one row of numbers. */
std::vector<Real> calcNumbers(const MechanismScene& scene, const State& state) {
    scene.system.realize(state, Stage::Velocity);
    const Cable& cable = scene.cable;
    std::vector<Real> numbers = {cable.getLength(state), cable.getLengthRate(state), cable.getPathError(state)};
    SimTK::Vector_<SimTK::SpatialVec> F_G;
    cable.calcUnitBodyForces(state, F_G);
    for (const SimTK::SpatialVec& F : F_G)
        for (int i = 0; i < 3; ++i) numbers.push_back(F[0][i]), numbers.push_back(F[1][i]);
    for (const CableElementIndex obstacle : {scene.sphere, scene.cylinder, scene.ellipsoid}) {
        numbers.push_back(cable.isTouched(state, obstacle));
        numbers.push_back(cable.isTouched(state, obstacle) ? cable.getArcLength(state, obstacle) : 0);
        numbers.push_back(cable.getWitness(state, obstacle));
    }
    return numbers;
}

/** A motion of the mechanism in frames, in which obstacles lift off and touch down. */
State makeFrame(const MechanismScene& scene, State state, int frame) {
    const State pose = scene.makeState(0.15 * frame);
    state.updQ() = pose.getQ();
    state.updU() = pose.getU();
    constexpr int kHeightOfPoint = 6;  // pin, quaternion and place of the free body
    state.updQ()[kHeightOfPoint] += 1.2 * std::sin(0.3 * frame);
    return state;
}

constexpr int kNumFrames = 40;

/** Poses one State after another by the given order and returns the answers by frame. */
std::vector<std::vector<Real>> follow(const MechanismScene& scene, State state, const std::vector<int>& order) {
    std::vector<std::vector<Real>> answers(kNumFrames);
    for (const int frame : order) {
        const State posed = makeFrame(scene, state, frame);
        state.updQ() = posed.getQ();
        state.updU() = posed.getU();
        answers[frame] = calcNumbers(scene, state);
    }
    return answers;
}

std::vector<int> makeOrder(unsigned seed) {
    std::vector<int> order(kNumFrames);
    for (int i = 0; i < kNumFrames; ++i) order[i] = i;
    if (seed == 0) return order;
    std::mt19937 generator(seed);
    for (int i = kNumFrames - 1; i > 0; --i) std::swap(order[i], order[generator() % (i + 1)]);
    return order;
}

TEST(OrderIndependence, FramesInOrderAndShuffledGiveTheSameAnswers) {
    MechanismScene scene;
    const State state = scene.makeState(0);
    const auto answers = follow(scene, state, makeOrder(0));
    for (const unsigned seed : {1u, 2u, 3u}) EXPECT_EQ(follow(scene, state, makeOrder(seed)), answers);
    // Each is the one of a State in which nothing was asked before.
    MechanismScene twin;
    for (int frame = 0; frame < kNumFrames; ++frame)
        EXPECT_EQ(calcNumbers(twin, makeFrame(twin, twin.makeState(0), frame)), answers[frame]) << "frame " << frame;
    std::size_t numTouched = 0;
    for (const std::vector<Real>& answer : answers) numTouched += answer[answer.size() - 9] != 0;
    EXPECT_GT(numTouched, 4u);
    EXPECT_LT(numTouched, kNumFrames - 4u);
}

TEST(OrderIndependence, FramesInOrderAndShuffledGiveTheSameAnswersWithContactsFixed) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    scene.cable.fixContacts(state);
    const auto answers = follow(scene, state, makeOrder(0));
    for (const unsigned seed : {4u, 5u, 6u}) EXPECT_EQ(follow(scene, state, makeOrder(seed)), answers);
}

/** Poses a State at one frame after another as an integrator does, and swaps in the last as an accepted step. */
void stepThrough(const MechanismScene& scene, State& state, const std::vector<int>& trials) {
    for (const int frame : trials) {
        const State posed = makeFrame(scene, state, frame);
        state.updQ() = posed.getQ();
        state.updU() = posed.getU();
        scene.system.realize(state, Stage::Velocity);
    }
    state.autoUpdateDiscreteVariables();
}

TEST(OrderIndependence, ARejectedTrialLeavesNoTrace) {
    MechanismScene scene;
    State straight = scene.makeState(0);
    scene.system.realize(straight, Stage::Position);
    scene.cable.fixContacts(straight);
    State trying = straight;
    for (int frame = 1; frame < 8; ++frame) {
        stepThrough(scene, straight, {frame});
        stepThrough(scene, trying, {frame + 9, frame + 1, 30 - frame, frame});
        const State next = makeFrame(scene, straight, frame + 1), nextTrying = makeFrame(scene, trying, frame + 1);
        EXPECT_EQ(calcNumbers(scene, next), calcNumbers(scene, nextTrying)) << "frame " << frame;
    }
}

/** Simulates the mechanism hanging on its cable and returns the answers on the way.
@param asCopies   goes on with a copy of the State after each leg */
std::vector<std::vector<Real>> simulate(const MechanismScene& scene, const State& start, bool asCopies) {
    std::vector<std::vector<Real>> answers;
    State state = start;
    auto integrator = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(scene.system);
    for (int leg = 1; leg <= 10; ++leg) {
        if (leg == 1 || asCopies) {
            integrator = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(scene.system);
            integrator->setAccuracy(1e-6);
            integrator->initialize(State(state));
        } else {
            integrator->initialize(state);
        }
        SimTK::TimeStepper stepper(scene.system, *integrator);
        stepper.initialize(integrator->getState());
        stepper.stepTo(0.05 * leg);
        state = integrator->getState();
        answers.push_back(calcNumbers(scene, state));
        const SimTK::Vector& y = state.getY();
        for (int i = 0; i < y.size(); ++i) answers.back().push_back(y[i]);
    }
    return answers;
}

struct StrungMechanism : MechanismScene {
    StrungMechanism() {
        ElasticStringForce(forces, cable, 5, 4, 0.1);
        system.realizeTopology();
    }
};

TEST(OrderIndependence, SimulationsRepeatInCopiesOfAStateAndInASecondSystem) {
    StrungMechanism scene, twin;
    const auto answers = simulate(scene, scene.makeState(0.4), false);
    EXPECT_EQ(simulate(scene, scene.makeState(0.4), false), answers);
    EXPECT_EQ(simulate(scene, scene.makeState(0.4), true), answers);
    EXPECT_EQ(simulate(twin, twin.makeState(0.4), false), answers);
    EXPECT_NE(answers.front(), answers.back());
}

TEST(Threads, RealizeManyStatesOfOneSystemAtOnce) {
    MechanismScene scene;
    constexpr int kNumThreads = 8, kRounds = 3;
    std::vector<State> states;
    std::vector<std::vector<Real>> expected, found(kNumThreads);
    for (int i = 0; i < kNumThreads; ++i) {
        State state = scene.makeState(0.3 * i);
        scene.system.realize(state, Stage::Position);
        if (i % 2) scene.cable.fixContacts(state);
        states.push_back(state);
    }
    const auto follow3 = [&](int i) {
        std::vector<Real> numbers;
        for (int round = 0; round < kRounds; ++round) {
            State posed = makeFrame(scene, states[i], 3 * i + round);
            for (const Real number : calcNumbers(scene, posed)) numbers.push_back(number);
        }
        return numbers;
    };
    for (int i = 0; i < kNumThreads; ++i) expected.push_back(follow3(i));
    std::vector<std::thread> threads;
    for (int i = 0; i < kNumThreads; ++i) threads.emplace_back([&, i] { found[i] = follow3(i); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
}

TEST(Threads, SimulateASystemEach) {
    constexpr int kNumThreads = 4;
    std::vector<std::unique_ptr<StrungMechanism>> scenes;
    for (int i = 0; i < kNumThreads; ++i) scenes.push_back(std::make_unique<StrungMechanism>());
    std::vector<std::vector<std::vector<Real>>> found(kNumThreads);
    const auto expected = simulate(*scenes[0], scenes[0]->makeState(0.7), false);
    std::vector<std::thread> threads;
    for (int i = 0; i < kNumThreads; ++i)
        threads.emplace_back([&, i] { found[i] = simulate(*scenes[i], scenes[i]->makeState(0.7), false); });
    for (std::thread& thread : threads) thread.join();
    for (int i = 0; i < kNumThreads; ++i) EXPECT_EQ(found[i], expected) << "thread " << i;
}

}  // namespace
}  // namespace tautline::testing
