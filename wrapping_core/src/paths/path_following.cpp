#include "tautline/paths/path_following.h"

#include <algorithm>

#include "tautline/paths/path_stability.h"

namespace tautline {
namespace {

constexpr double kShortestStep = 1.0 / 128;  ///< of the way

/** A pose between two, the fraction `share` of the way; which elements take part is that of the second. */
void interpolatePose(const PathPose& from, const PathPose& to, double share, PathPose& between) {
    between = to;
    for (std::size_t e = 0; e < to.X_GE.size(); ++e) {
        const Pose &A = from.X_GE[e], &B = to.X_GE[e];
        Eigen::AngleAxisd turn(Mat3(A.R.transpose() * B.R));
        turn.angle() *= share;
        between.X_GE[e] = Pose(A.R * turn.toRotationMatrix(), (1 - share) * A.p + share * B.p);
    }
}

}  // namespace

bool isStablePath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    return path.status == PathStatus::Solved && calcPathStability(problem, pose, path).isStable();
}

bool followPath(PathSolver& solver, const PathProblem& problem, const PathPose& from, const PathPose& to,
                PathSolution& path) {
    PathSolution reached = path, next;
    PathPose pose;
    double share = 0, step = 0.5;
    while (share < 1) {
        next = reached;
        const double trial = std::min(1.0, share + step);
        interpolatePose(from, to, trial, pose);
        const PathPose& trialPose = trial < 1 ? pose : to;
        solver.solveKeepingContacts(problem, trialPose, next);
        if (isStablePath(problem, trialPose, next)) {
            reached = next, share = trial, step *= 2;
        } else {
            step /= 2;
            if (step < kShortestStep) return false;
        }
    }
    path = reached;
    return true;
}

}  // namespace tautline
