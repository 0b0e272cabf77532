// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The weave (tests/support/weave_scene.h) for all who can solve it. */
#include <memory>
#include <vector>

#include "contestant.h"
#include "support/weave_scene.h"
#include "tautline/paths/path_solver_options.h"

namespace tautline::compare {

using Kind = testing::WeaveScene::Kind;

/** A row of poses of the weave there and back, with the exact lengths. */
struct WeaveRow {
    /** @param hasPointsBetween   a fixed point halfway between each two obstacles, as MuJoCo asks for */
    WeaveRow(Kind kind, int count, int numPoses, bool hasPointsBetween);

    Kind kind;
    int count;  ///< of obstacles
    bool hasPointsBetween;
    PathProblem problem;
    std::vector<PathPose> poses;
    PathSolution start;  ///< in the first pose
    std::vector<double> lengths;

    bool isPointBetween(int element) const;
    /** Index of the element's obstacle; -1 for points. */
    int getObstacle(int element) const;
};

PathSolverOptions makeOptions(double tolerance);

/** Names of ways that others are divided by. */
inline constexpr char kCore[] = "core";
inline constexpr char kCoreWithForces[] = "core, with forces on all bodies";
inline constexpr char kThroughSimbody[] = "through Simbody";

// Each holds what it needs in its contestant's functions; the row must outlive it.
Contestant makeCore(const WeaveRow& row, double tolerance);
Contestant makeCoreWithForces(const WeaveRow& row, double tolerance);
Contestant makeThroughSimbody(const WeaveRow& row, double tolerance);
/** Reports on itself on std::cout, which is shut up meanwhile. */
Contestant makeCablePath(const WeaveRow& row);
/** @param isRootFinder   else the length's minimizer, its default */
Contestant makeCableSpan(const WeaveRow& row, double tolerance, bool isRootFinder);
/** For rows of cylinders or spheres with points between. */
Contestant makeMujoco(const WeaveRow& row);

}  // namespace tautline::compare
