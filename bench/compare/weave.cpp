// SPDX-License-Identifier: Apache-2.0
#include "weave.h"

#include <stdexcept>

#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"

namespace tautline::compare {
namespace {

using testing::WeaveScene;

/** Of the lengths that others are compared with. */
constexpr double kExact = 1e-12;

PathProblem makeProblem(const WeaveScene& scene, int count, bool hasPointsBetween) {
    PathProblem problem;
    problem.addPoint("origin");
    for (int i = 0; i < count; ++i) {
        if (hasPointsBetween && i > 0) problem.addPoint("between" + std::to_string(i));
        const PathElement& obstacle = scene.getProblem().getElement(i + 1);
        problem.addObstacle(obstacle.name, obstacle.surface, obstacle.hint);
    }
    problem.addPoint("insertion");
    return problem;
}

PathPose makePose(const WeaveScene& scene, double time, int count, bool hasPointsBetween) {
    PathPose simple, pose;
    scene.calcPose(time, simple);
    pose.X_GE.push_back(simple.X_GE.front());
    for (int i = 0; i < count; ++i) {
        if (hasPointsBetween && i > 0) pose.X_GE.emplace_back(Vector3(i - 0.5, 0, 0));
        pose.X_GE.push_back(simple.X_GE[static_cast<std::size_t>(i) + 1]);
    }
    pose.X_GE.push_back(simple.X_GE.back());
    return pose;
}

/** A path of many cylinders is not found from nothing in reasonable time; that over ellipsoids begins at a saddle if it
is guessed. */
PathSolution makeStart(const WeaveScene& scene, const WeaveRow& row) {
    if (row.kind != Kind::Cylinders || row.hasPointsBetween) return solvePath(row.problem, row.poses.front());
    PathSolution path = scene.makeGuess();
    PathSolver(makeOptions(kExact)).solve(row.problem, row.poses.front(), path);
    return path;
}

/** A solver with its path, which steps from pose to pose. */
struct WarmSolver {
    WarmSolver(const WeaveRow& row, double tolerance) : solver(makeOptions(tolerance)), path(row.start) {}
    PathSolver solver;
    PathSolution path;
    std::vector<SpatialForce> forces;
};

}  // namespace

PathSolverOptions makeOptions(double tolerance) {
    PathSolverOptions options;
    options.pathErrorTolerance = options.geodesics.accuracy = tolerance;
    options.allowsColdStart = false;
    return options;
}

WeaveRow::WeaveRow(Kind kind_, int count_, int numPoses, bool hasPointsBetween_)
    : kind(kind_), count(count_), hasPointsBetween(hasPointsBetween_) {
    const WeaveScene scene(kind, count);
    problem = makeProblem(scene, count, hasPointsBetween);
    for (int k = 0; k < numPoses; ++k)
        poses.push_back(makePose(scene, WeaveScene::kTimeStep * turnBack(k, numPoses), count, hasPointsBetween));
    start = makeStart(scene, *this);
    PathSolver solver(makeOptions(kExact));
    PathSolution path = start;
    for (const PathPose& pose : poses) {
        solver.solve(problem, pose, path);
        if (path.status != PathStatus::Solved) throw std::runtime_error("the weave has no path in one of its poses");
        lengths.push_back(path.length);
    }
}

bool WeaveRow::isPointBetween(int element) const {
    return problem.getElement(element).isPoint() && element > 0 && element + 1 < problem.getNumElements();
}

int WeaveRow::getObstacle(int element) const {
    if (problem.getElement(element).isPoint()) return -1;
    return hasPointsBetween ? (element - 1) / 2 : element - 1;
}

Contestant makeCore(const WeaveRow& row, double tolerance) {
    const auto warm = std::make_shared<WarmSolver>(row, tolerance);
    const auto step = [warm, &row](int k) {
        warm->solver.solve(row.problem, row.poses[static_cast<std::size_t>(k)], warm->path);
        return warm->path.length;
    };
    return {kCore, step, nullptr, nullptr};
}

Contestant makeCoreWithForces(const WeaveRow& row, double tolerance) {
    const auto warm = std::make_shared<WarmSolver>(row, tolerance);
    const auto step = [warm, &row](int k) {
        const PathPose& pose = row.poses[static_cast<std::size_t>(k)];
        warm->solver.solve(row.problem, pose, warm->path);
        calcUnitForces(warm->path, pose, warm->forces);
        return warm->path.length;
    };
    return {kCoreWithForces, step, nullptr, nullptr};
}

}  // namespace tautline::compare
