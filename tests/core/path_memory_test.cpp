// SPDX-License-Identifier: Apache-2.0
/** What paths and solvers hold, as bench/README.md says. */
#include <gtest/gtest.h>

#include <vector>

#include "support/used_memory.h"
#include "support/weave_scene.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

struct Memory {
    double path, solver;  ///< [bytes]
};

/** After a solve of a weave. */
Memory measure(WeaveScene::Kind kind, int numObstacles) {
    constexpr int kCopies = 4;
    const WeaveScene scene(kind, numObstacles);
    PathPose pose;
    scene.calcPose(0, pose);
    const double before = getUsedMemory();
    std::vector<PathSolution> paths(kCopies);
    std::vector<PathSolver> solvers(kCopies);
    for (int i = 0; i < kCopies; ++i) {
        paths[static_cast<std::size_t>(i)] = scene.makeGuess();
        solvers[static_cast<std::size_t>(i)].solve(scene.getProblem(), pose, paths[static_cast<std::size_t>(i)]);
    }
    const double both = getUsedMemory();
    solvers = std::vector<PathSolver>();
    const double alone = getUsedMemory();
    return {(alone - before) / kCopies, (both - alone) / kCopies};
}

TEST(PathMemory, IsLinearInTheObstaclesAndAsSmallAsIsSaid) {
    if (getUsedMemory() == 0) GTEST_SKIP() << "the allocator does not tell what it has given";
    for (const auto kind : {WeaveScene::Kind::Cylinders, WeaveScene::Kind::Ellipsoids})
        for (const int n : {1, 10, 20}) {
            measure(kind, n);  // what is made once
            const Memory memory = measure(kind, n);
            EXPECT_LT(memory.path, 4e3 + 1.1e3 * n) << n;
            EXPECT_LT(memory.solver, 8e3 + 14e3 * n) << n;
            EXPECT_GT(memory.path, 800 * n) << n << ": is it measured?";
        }
}

}  // namespace
}  // namespace tautline::testing
