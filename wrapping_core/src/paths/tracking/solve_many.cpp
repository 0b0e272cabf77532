// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/solve_many.h"

#include <string>

#include "tautline/error.h"
#include "tautline/paths/path_tracker.h"

namespace tautline {
namespace {

void validatePoses(const PathProblem& problem, const std::vector<PathPose>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) try {
            poses[i].validate(problem);
        } catch (const InvalidInput& error) {
            throw InvalidInput("pose " + std::to_string(i) + " of " + std::to_string(poses.size()) + ": " +
                               error.what());
        }
}

}  // namespace

void solveMany(const PathProblem& problem, const std::vector<PathPose>& poses, std::vector<PathSolution>& out,
               const PathSolverOptions& options, const Threads& threads) {
    problem.validate();
    validatePoses(problem, poses);
    const int count = static_cast<int>(poses.size());
    std::vector<PathTracker> trackers;
    for (int worker = 0; worker < countWorkers(count, kPosesPerBlock, threads); ++worker)
        trackers.emplace_back(options);
    out.resize(poses.size());
    runBlocks(count, kPosesPerBlock, threads, [&](int worker, int i) {
        PathTracker& tracker = trackers[static_cast<std::size_t>(worker)];
        const auto pose = static_cast<std::size_t>(i);
        if (i % kPosesPerBlock == 0)
            tracker.solve(problem, poses[pose], out[pose]);
        else
            tracker.solveFrom(problem, out[pose - 1], poses[pose], out[pose]);
    });
}

}  // namespace tautline
