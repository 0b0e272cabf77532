// SPDX-License-Identifier: Apache-2.0
/** A bone from a mesh (tests/support/triangle_meshes.h): one evaluation of its function, and a muscle over it. */
#include <benchmark/benchmark.h>

#include <random>

#include "support/triangle_meshes.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/solid_fit.h"

namespace {

using namespace tautline;

const SolidFit& getBone() {
    static const SolidFit fit = fitSolid(testing::makeBoneMesh());
    return fit;
}

/** At places on all sides of the bone, one after the other. */
void evaluate(benchmark::State& state) {
    const SolidFit& bone = getBone();
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> draw(0, bone.points.size() - 1);
    std::vector<Vector3> places(1000);
    for (Vector3& place : places) place = bone.points[draw(random)];
    std::size_t at = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(bone.solid.calcImplicit(places[at]));
        at = at + 1 < places.size() ? at + 1 : 0;
    }
}
BENCHMARK(evaluate);

/** A muscle across the shaft whose insertion goes to and fro by a fifth of a millimeter per step. */
class MuscleOverBone {
public:
    MuscleOverBone() {
        m_problem.addPoint("origin");
        m_problem.addObstacle("bone", std::make_shared<BSplineSolid>(getBone().solid), PassNear{Vector3(0.03, 0, 0)});
        m_problem.addPoint("insertion");
    }
    const PathProblem& getProblem() const { return m_problem; }
    PathPose calcPose(int step) const {
        PathPose pose;
        const double along = 2e-4 * (step % 200 < 100 ? step % 200 : 200 - step % 200);
        pose.X_GE = {Pose(Vector3(-0.01, -0.06, -0.03)), Pose(), Pose(Vector3(-0.02, 0.07, 0.01 + along))};
        return pose;
    }

private:
    PathProblem m_problem;
};

void count(benchmark::State& state, const PathSolution& path, double unsolved) {
    state.counters["unsolved"] = unsolved;
    state.counters["arc"] = path.contacts[1].start.length;
}

/** Argument: k of the tolerance 10^-k of path error and geodesics. */
void stepOverBone(benchmark::State& state) {
    const MuscleOverBone muscle;
    PathSolverOptions options;
    options.pathErrorTolerance = options.geodesics.accuracy = std::pow(10.0, -static_cast<double>(state.range(0)));
    PathSolver solver(options);
    PathSolution path = solvePath(muscle.getProblem(), muscle.calcPose(0));
    std::vector<PathPose> poses;
    for (int step = 0; step < 200; ++step) poses.push_back(muscle.calcPose(step));
    std::size_t at = 0;
    double unsolved = 0;
    for (auto _ : state) {
        at = at + 1 < poses.size() ? at + 1 : 0;
        solver.solve(muscle.getProblem(), poses[at], path);
        unsolved += path.status != PathStatus::Solved;
    }
    count(state, path, unsolved);
}
BENCHMARK(stepOverBone)->Arg(3)->Arg(6)->Arg(9)->ArgNames({"tol"})->Unit(benchmark::kMicrosecond);

void solveOverBone(benchmark::State& state) {
    const MuscleOverBone muscle;
    PathSolution path;
    double unsolved = 0;
    int step = 0;
    for (auto _ : state) {
        path = solvePath(muscle.getProblem(), muscle.calcPose(step++));
        unsolved += path.status != PathStatus::Solved;
    }
    count(state, path, unsolved);
}
BENCHMARK(solveOverBone)->Unit(benchmark::kMicrosecond);

}  // namespace
