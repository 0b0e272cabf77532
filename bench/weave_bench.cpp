// SPDX-License-Identifier: Apache-2.0
/** Warm steps of the weave (tests/support/weave_scene.h), with counters; README.md says how to read them. */
#include <benchmark/benchmark.h>

#include <chrono>

#include "support/allocation_counter.h"
#include "support/weave_scene.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/solve_many.h"

namespace {

using namespace tautline;
using namespace tautline::testing;

/** Arguments: number of obstacles, and k of the tolerance 10^-k of path error and geodesics. */
void stepWeave(benchmark::State& state, WeaveScene::Kind kind) {
    const int count = static_cast<int>(state.range(0));
    const double tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
    const WeaveScene scene(kind, count);
    PathSolverOptions options;
    options.pathErrorTolerance = options.geodesics.accuracy = tolerance;
    options.allowsColdStart = false;
    PathSolver solver(options);
    PathPose pose;
    constexpr int kWarmUp = 50, kPeriod = 400;
    // Poses are made beforehand; the motion runs there and back, so that each step starts from its neighbor.
    std::vector<PathPose> poses(kPeriod);
    for (int k = 0; k < kPeriod; ++k) scene.calcPose(k * WeaveScene::kTimeStep, poses[k]);
    // The guess leads to a minimum over cylinders, to a saddle over some ellipsoids.
    PathSolution path =
        kind == WeaveScene::Kind::Cylinders ? scene.makeGuess() : solvePath(scene.getProblem(), poses.front());
    int at = 0, direction = 1;
    const auto step = [&] {
        if (at + direction < 0 || at + direction >= kPeriod) direction = -direction;
        at += direction;
        solver.solve(scene.getProblem(), poses[at], path);
    };
    for (int k = 0; k < kWarmUp; ++k) step();
    double iterations = 0, shots = 0, unsolved = 0;
    const long allocationsBefore = allocationCount;
    for (auto _ : state) {
        step();
        iterations += path.iterations, shots += path.shots;
        unsolved += path.status != PathStatus::Solved;
    }
    const double allocations = static_cast<double>(allocationCount - allocationsBefore);
    using benchmark::Counter;
    state.counters["iterations"] = Counter(iterations, Counter::kAvgIterations);
    state.counters["shots"] = Counter(shots, Counter::kAvgIterations);
    state.counters["allocations"] = Counter(allocations, Counter::kAvgIterations);
    state.counters["unsolved"] = unsolved;
    // Inverted rate of surfaces: seconds per surface and step.
    state.counters["s/surface"] = Counter(count, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/** Arguments: number of cylinders, and of threads. A row of poses by one thread and by all, in turn, so that both see
the same machine. */
void solveWeaves(benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    constexpr int kBlocks = 32;
    const int count = static_cast<int>(state.range(0)), numThreads = static_cast<int>(state.range(1));
    const WeaveScene scene(WeaveScene::Kind::Cylinders, count);
    std::vector<PathPose> poses(kBlocks * kPosesPerBlock);
    for (std::size_t k = 0; k < poses.size(); ++k)
        scene.calcPose(static_cast<double>(k) * WeaveScene::kTimeStep, poses[k]);
    std::vector<PathSolution> out;
    const auto solve = [&](int threads) {
        const Clock::time_point begin = Clock::now();
        solveMany(scene.getProblem(), poses, out, {}, {threads, {}});
        return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    solve(numThreads);
    double leastOfOne = kInfinity, least = kInfinity, unsolved = 0;
    for (auto _ : state) {
        leastOfOne = std::min(leastOfOne, solve(1));
        const double seconds = solve(numThreads);
        least = std::min(least, seconds);
        state.SetIterationTime(seconds);
        for (const PathSolution& path : out) unsolved += path.status != PathStatus::Solved;
    }
    state.counters["unsolved"] = unsolved;
    state.counters["speedup"] = leastOfOne / least;
    state.counters["us/pose"] = 1e6 * least / static_cast<double>(poses.size());
}

BENCHMARK(solveWeaves)
    ->ArgsProduct({{5, 50}, {1, 2}})
    ->ArgNames({"n", "threads"})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stepWeave, Cylinders, WeaveScene::Kind::Cylinders)
    ->ArgsProduct({{1, 5, 10, 50, 100, 1000}, {3, 9}})
    ->ArgNames({"n", "tol"})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(stepWeave, Ellipsoids, WeaveScene::Kind::Ellipsoids)
    ->ArgsProduct({{5}, {3, 9}})
    ->ArgNames({"n", "tol"})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
