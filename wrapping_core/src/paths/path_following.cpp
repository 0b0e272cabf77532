// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_following.h"

#include <algorithm>

#include "paths/length_minimizer.h"
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

/** Whether no contact has moved farther than a way that a string slides within one step. */
bool isNear(const PathProblem& problem, const PathSolution& a, const PathSolution& b) {
    constexpr double kNear = 0.1;  // of the surface's size
    for (std::size_t e = 0; e < a.contacts.size(); ++e) {
        if (!a.contacts[e].isTouched) continue;
        const Geodesic &p = a.contacts[e].geodesic, &q = b.contacts[e].geodesic;
        const double moved = std::max((p.P.x - q.P.x).norm(), (p.Q.x - q.Q.x).norm());
        if (!(moved < kNear * problem.getElement(static_cast<int>(e)).surface->getSize())) return false;
    }
    return true;
}

/** Downhill from where the path was: where a path that was the shortest becomes a saddle, two others part from it as
the square root of the way, and Newton's method stays on the saddle. */
bool slideOn(PathSolver& solver, const PathProblem& problem, const PathPose& pose, const PathSolution& reached,
             PathSolution& next) {
    next = reached;
    LengthMinimizer minimizer(solver.getOptions());
    if (!minimizer.minimize(problem, pose, next)) return false;
    solver.solveKeepingContacts(problem, pose, next);
    return isHoldingPath(problem, pose, next) && isNear(problem, reached, next);
}

}  // namespace

bool isHoldingPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    return path.status == PathStatus::Solved && calcPathStability(problem, pose, path).holds();
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
        if (isHoldingPath(problem, trialPose, next) || slideOn(solver, problem, trialPose, reached, next)) {
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
