#include "contact_settling.h"

#include <cmath>

namespace tautline {
namespace {

/** @return the obstacle with the lowest witness below zero, -1 if there is none */
int findWorstContact(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    int worst = -1;
    double lowest = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !pose.hasElement(e)) continue;
        const double witness = calcContactWitness(problem, path, e);
        if (witness < lowest) lowest = witness, worst = e;
    }
    return worst;
}

void lift(ObstacleContact& contact) {
    contact.isTouched = false;
    contact.clearance = LineClearance();
    contact.clearance.C = contact.start.point;
    contact.clearance.N = contact.geodesic.P.N;
}

void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path) {
    ObstacleContact& contact = path.contacts[element];
    if (contact.isTouched) return lift(contact);
    const Vec3 e_S = pose.X_GE[element].R.transpose() * path.segments[contact.segment].e;
    touchAtClearance(*problem.getElement(element).surface, e_S, contact);
}

}  // namespace

double calcContactWitness(const PathProblem& problem, const PathSolution& path, int element) {
    // The smallest sign that there is: a start from exactly zero would hide the event that follows.
    constexpr double kTiny = std::numeric_limits<double>::min();
    const ObstacleContact& contact = path.contacts[element];
    // An end inside leaves no path over the obstacle: it must be off, and then nothing is watched.
    if (contact.isSwitchedOff) return contact.isTouched ? -1 : 1;
    const double witness = contact.isTouched ? contact.start.length / problem.getElement(element).surface->getSize()
                                             : contact.clearance.distance * contact.clearance.scale - kContactTolerance;
    if (!std::isfinite(witness)) return 1;
    return witness == 0 ? kTiny : witness;
}

bool settleContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PathSolution before = path;
    const int maxSwitches = 2 * problem.getNumElements();
    for (int i = 0; i < maxSwitches; ++i) {
        const int worst = findWorstContact(problem, pose, path);
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

bool haveSameContacts(const PathSolution& a, const PathSolution& b) {
    if (a.contacts.size() != b.contacts.size()) return false;
    for (std::size_t e = 0; e < a.contacts.size(); ++e)
        if (a.contacts[e].isTouched != b.contacts[e].isTouched) return false;
    return true;
}

}  // namespace tautline
