#include "tautline/paths/contact_settling.h"

#include "paths/obstacle_walk.h"
#include "tautline/paths/contact_switch.h"

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

}  // namespace

bool settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PathSolution before = path;
    const int maxSwitches = 2 * problem.getNumElements();
    for (int i = 0; i < maxSwitches; ++i) {
        const int worst = findLowestWitness(problem, pose, path);
        if (worst < 0) return !haveSameContacts(before, path);
        switchContact(problem, pose, worst, path);
        solver.solveKeepingContacts(problem, pose, path);
        if (path.status == PathStatus::NotConverged) break;
    }
    path = before;
    solver.solve(problem, pose, path);
    if (path.status == PathStatus::NotConverged) path = before;
    return !haveSameContacts(before, path);
}

}  // namespace tautline
