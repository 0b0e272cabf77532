#include "tautline/paths/contact_settling.h"

#include <cmath>

#include "paths/geodesic_variations.h"
#include "paths/obstacle_walk.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_stability.h"

namespace tautline {
namespace {

/** @return the obstacle with the lowest witness below zero, -1 if there is none */
int findLowestWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    int worst = -1;
    double lowest = 0;
    visitObstacles(problem, pose, [&](int e) {
        const double witness = calcContactWitness(problem, path, e);
        if (witness < lowest) lowest = witness, worst = e;
    });
    return worst;
}

int findFirstTouched(const PathSolution& path) {
    for (std::size_t e = 0; e < path.contacts.size(); ++e)
        if (path.contacts[e].isTouched) return static_cast<int>(e);
    return -1;
}

/** @return true if no witness is left below zero */
bool switchContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const int maxSwitches = 2 * problem.getNumElements();
    for (int i = 0; i < maxSwitches; ++i) {
        const int worst = findLowestWitness(problem, pose, path);
        if (worst < 0) return true;
        switchContact(problem, pose, worst, path);
        solver.solveKeepingContacts(problem, pose, path);
        if (path.status == PathStatus::NotConverged) return false;
    }
    return false;
}

/** Moves the arc of an obstacle sideways, by a part of the surface's size. */
void pushArc(const PathProblem& problem, int e, double push, PathSolution& path) {
    const Surface& surface = *problem.getElement(e).surface;
    ObstacleContact& contact = path.contacts[e];
    contact.start =
        calcCorrectedStart(surface, contact.start, contact.geodesic.P, Vec4(0, push * surface.getSize(), 0, 0));
}

bool isMinimum(const PathSolution& path) {
    return path.status == PathStatus::Solved || path.status == PathStatus::EndInside;
}

/** The solver goes downhill from the saddle by itself; where it does not come to a shorter path, it is pushed off to
either side. @return the obstacle at which the path was a saddle, if it is now a minimum that is no longer; else -1 */
int leaveSaddle(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    constexpr double kRounding = 1e-12, kPushes[] = {0, 0.3, -0.3, 1, -1};
    const PathStability stability = calcPathStability(problem, pose, path);
    if (stability.holds()) return -1;
    for (const double push : kPushes) {
        PathSolution next = path;
        if (push != 0) pushArc(problem, stability.element, push, next);
        solver.solve(problem, pose, next);
        if (!isMinimum(next) || !(next.length <= (1 + kRounding) * path.length)) continue;
        path = next;
        return stability.element;
    }
    return -1;
}

/** Lets the solver find a contact set. */
Settlement solveAnew(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    constexpr double kContinuous = 1e-9;  // of the length
    PathSolution next = path;
    solver.solve(problem, pose, next);
    if (next.status == PathStatus::NotConverged) return {};
    Settlement settlement;
    settlement.isAnew = true;
    // An end that has just gone inside loses its contact without a jump.
    if (!(std::abs(next.length / path.length - 1) < kContinuous)) settlement.slippedAt = findFirstTouched(path);
    path = next;
    return settlement;
}

}  // namespace

Settlement settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PathSolution before = path;
    Settlement settlement;
    if (path.status != PathStatus::NotConverged && switchContacts(solver, problem, pose, path)) {
        settlement.slippedAt = leaveSaddle(solver, problem, pose, path);
    } else {
        path = before;
        settlement = solveAnew(solver, problem, pose, path);
    }
    settlement.isAnew = settlement.isAnew || settlement.slippedAt >= 0 || !haveSameContacts(before, path);
    return settlement;
}

}  // namespace tautline
