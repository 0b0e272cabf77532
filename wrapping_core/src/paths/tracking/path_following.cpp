// SPDX-License-Identifier: Apache-2.0
#include "paths/tracking/path_following.h"

#include <algorithm>

#include "paths/problem/search_limits.h"
#include "tautline/paths/path_stability.h"

namespace tautline {
namespace {

constexpr double kShortestPart = 1.0 / 128;  ///< of the largest one

/** Whether no contact has moved farther than a way that a string slides within one step. */
bool isNear(const PathProblem& problem, const PathSolution& a, const PathSolution& b) {
    constexpr double kNear = 0.1;  // of the surface's size
    for (std::size_t e = 0; e < a.contacts.size(); ++e) {
        if (!a.contacts[e].isTouched) continue;
        const ShotGeodesic &aFirst = a.contacts[e].geodesic, &aLast = a.contacts[e].getLastArc().geodesic;
        const ShotGeodesic &bFirst = b.contacts[e].geodesic, &bLast = b.contacts[e].getLastArc().geodesic;
        const double moved = std::max((aFirst.P.x - bFirst.P.x).norm(), (aLast.Q.x - bLast.Q.x).norm());
        if (!(moved < kNear * problem.getElement(static_cast<int>(e)).surface->getSize())) return false;
    }
    return true;
}

int countTouched(const PathSolution& path) {
    return static_cast<int>(std::count_if(path.contacts.begin(), path.contacts.end(),
                                          [](const ObstacleContact& contact) { return contact.isTouched; }));
}

}  // namespace

bool isHoldingPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    return path.status == PathStatus::Solved && calcPathStability(problem, pose, path).holds();
}

bool PathFollower::follow(PathSolver& solver, const PathProblem& problem, const PoseMotion& way, double firstPart,
                          double largestPart, PathSolution& path) {
    PathSolution reached = path;
    double share = 0, part = firstPart;
    m_shots = 0;
    const long mostShots = static_cast<long>(kMaxFollowShots) * countTouched(path);
    while (share < 1) {
        const double trial = std::min(1.0, share + part);
        way.calcPose(trial, m_pose);
        if (step(solver, problem, reached)) {
            reached = m_next;
            share = trial;
            part = std::min(2 * part, largestPart);
        } else {
            part /= 2;
            if (part < kShortestPart * largestPart || m_shots > mostShots) return false;
        }
    }
    path = reached;
    return true;
}

bool PathFollower::step(PathSolver& solver, const PathProblem& problem, const PathSolution& reached) {
    m_next = reached;
    solve(solver, problem);
    if (isHoldingPath(problem, m_pose, m_next)) return true;
    // Else the solve itself has tried to go downhill from there.
    return !m_next.report.usedMinimizer && slide(solver, problem, reached);
}

/** Downhill from where the path was: where a path that was the shortest becomes a saddle, two others part from it as
the square root of the way, and Newton's method stays on the saddle. */
bool PathFollower::slide(PathSolver& solver, const PathProblem& problem, const PathSolution& reached) {
    m_next = reached;
    m_next.shots = 0;
    const bool isStationary = m_minimizer.minimize(problem, m_pose, m_next);
    m_shots += m_next.shots;
    if (!isStationary) return false;
    solve(solver, problem);
    return isHoldingPath(problem, m_pose, m_next) && isNear(problem, reached, m_next);
}

/** m_next at m_pose. */
void PathFollower::solve(PathSolver& solver, const PathProblem& problem) {
    solver.solveKeepingContacts(problem, m_pose, m_next);
    m_shots += m_next.shots;
}

}  // namespace tautline
