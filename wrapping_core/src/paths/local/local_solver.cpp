// SPDX-License-Identifier: Apache-2.0
#include "paths/local/local_solver.h"

#include "paths/contacts/arc_changes.h"
#include "paths/equations/second_variation.h"
#include "paths/local/reversed_tangents.h"
#include "paths/problem/search_limits.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

using Condition = PathVerification::Condition;

/** Whether a path may lie on an obstacle in several arcs. */
bool hasHollows(const PosedProblem& scene) {
    for (int e = 0; e < scene.size(); ++e)
        if (scene.isObstacle(e) && !scene.getSurface(e).isConvex()) return true;
    return false;
}

/** Below zero by how much an obstacle that is lifted, but could be touched, is penetrated beyond the tolerance of
contact; else 0. */
double calcExcess(const ObstacleContact& contact) {
    if (contact.isTouched || contact.isSwitchedOff || contact.yields) return 0;
    const double depth = contact.clearance.distance * contact.clearance.scale;
    return depth < kContactTolerance ? depth : 0;
}

/** The arc that is the most negative, or the first of an obstacle that has swallowed an end; none: a minimum. */
PathVerification findArcToLift(const PosedProblem& scene, const PathSolution& path) {
    PathVerification lift;
    double shortest = kShortestArc;
    scene.forEachObstacle([&](int e) {
        const ObstacleContact& contact = path.contacts[e];
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            const double length = contact.getArc(i).start.length / scene.getSurface(e).getSize();
            const double judged = contact.isSwitchedOff ? -kInfinity : length;
            if (!(judged < shortest)) continue;
            shortest = judged;
            lift.condition = Condition::NegativeLength, lift.element = e, lift.arc = i;
        }
    });
    return lift;
}

int countFurtherArcs(const PathSolution& path) {
    int count = 0;
    for (const ObstacleContact& contact : path.contacts) count += static_cast<int>(contact.furtherArcs.size());
    return count;
}

/** @return the lifted obstacle that a segment penetrates most, -1 if there is none */
int findDeepest(const PosedProblem& scene, const PathSolution& path) {
    int deepest = -1;
    double depth = 0;
    scene.forEachObstacle([&](int e) {
        const double excess = calcExcess(path.contacts[e]);
        if (!(excess < depth)) return;
        depth = excess;
        deepest = e;
    });
    return deepest;
}

}  // namespace

void goBack(const PathSolution& earlier, PathSolution& path) {
    const int iterations = path.iterations, shots = path.shots;
    SolveReport report = path.report;
    report.strategy = earlier.report.strategy;
    report.bandLevel = earlier.report.bandLevel;
    path = earlier;
    path.iterations = iterations;
    path.shots = shots;
    path.report = report;
}

PathVerification LocalSolver::solve(const PosedProblem& scene, PathSolution& path, const Effort& effort) {
    m_numDescents = effort.maxDescents;
    m_deepest.reserve(scene.size());
    int numRepairs = 0;
    for (int change = 0;; ++change) {
        const PathVerification broken = findBrokenCondition(scene, path);
        if (broken.isMinimum() || change >= calcMaxContactChanges(scene.size() + countFurtherArcs(path))) return broken;
        if (broken.condition == Condition::Unstable && !effort.leavesSaddles) return broken;
        if (!act(scene, broken, numRepairs, path)) return broken;
    }
}

/** Solves the path error of the contact set and asks what is wrong with that path, contacts first. */
PathVerification LocalSolver::findBrokenCondition(const PosedProblem& scene, PathSolution& path) {
    const bool isStationary = findForwardPath(scene, path);
    updateClearances(scene, path);
    if (!isStationary) return {Condition::NotStationary, -1};
    if (const PathVerification lift = findArcToLift(scene, path); !lift.isMinimum()) return lift;
    if (const int e = findDeepest(scene, path); e >= 0) return {Condition::Penetration, e};
    watchNearestPlaces(scene, path);
    if (const int e = findDeepest(scene, path); e >= 0) return {Condition::Penetration, e};
    return verifyPath(scene.problem, scene.pose, path);
}

/** @return false where the condition cannot be mended from here: the table of local_solver.h */
bool LocalSolver::act(const PosedProblem& scene, const PathVerification& broken, int& numRepairs, PathSolution& path) {
    switch (broken.condition) {
        case Condition::NegativeLength:
            if (path.contacts[broken.element].isSwitchedOff)
                liftContact(path.contacts[broken.element]);
            else
                liftArc(broken.arc, path.contacts[broken.element]);
            return true;
        case Condition::Penetration:
            if (path.contacts[broken.element].isTouched)
                touchAgain(scene, broken.element, broken.segment, path);
            else
                touchDeepest(scene, path);
            return true;
        case Condition::ReversedTangent:
            if (++numRepairs > kMaxRepairs) return false;
            path.report.turnedTangents = true;
            reverseTangents(scene, nullptr, path);
            return true;
        case Condition::Unstable:
            if (++numRepairs > kMaxRepairs) return false;
            path.report.leftSaddle = true;
            leaveSaddle(scene, path);
            return true;
        default:
            return false;
    }
}

/** Of the obstacles that one segment penetrates, the deepest lifts it off most of the others; segments do not disturb
each other. */
void LocalSolver::touchDeepest(const PosedProblem& scene, PathSolution& path) {
    m_deepest.assign(path.segments.size(), -1);
    scene.forEachObstacle([&](int e) {
        const ObstacleContact& contact = path.contacts[e];
        if (!(calcExcess(contact) < 0)) return;
        int& deepest = m_deepest[contact.segment];
        if (deepest < 0 || calcExcess(contact) < calcExcess(path.contacts[deepest])) deepest = e;
    });
    for (const int e : m_deepest)
        if (e >= 0) switchContact(scene.problem, scene.pose, e, path);
}

bool LocalSolver::findStationaryPath(const PosedProblem& scene, PathSolution& path) {
    m_numDescents = Effort::kUnlimited;
    return solveArcs(scene, path);
}

/** Solves the contact set with as many arcs on each obstacle as the string has there. One that has no path may be one
of too many arcs. */
bool LocalSolver::solveArcs(const PosedProblem& scene, PathSolution& path) {
    if (!hasHollows(scene)) return solveContacts(scene, path);
    for (int change = 0; change < kMaxArcChanges; ++change) {
        const bool isStationary = solveContacts(scene, path);
        const bool isChanged =
            isStationary ? joinArcs(scene, path) || splitArcs(scene, path) : joinNearestArcs(scene, path);
        if (!isChanged) return isStationary;
    }
    return solveContacts(scene, path);
}

/** Newton's method, else the minimizer from the same starts. */
bool LocalSolver::solveContacts(const PosedProblem& scene, PathSolution& path) {
    rememberStarts(path);
    if (m_newton.iterate(scene.problem, scene.pose, path)) return true;
    restoreStarts(path);
    return minimize(scene, path);
}

/** A stationary path that turns back at an arc gives way to the minimizer's, if that does not. */
bool LocalSolver::findForwardPath(const PosedProblem& scene, PathSolution& path) {
    if (!solveArcs(scene, path)) return false;
    if (!hasReversedTangent(scene, path)) return true;
    m_reversed = path;
    restoreStarts(path);
    if (!minimize(scene, path) || hasReversedTangent(scene, path)) goBack(m_reversed, path);
    return true;
}

bool LocalSolver::minimize(const PosedProblem& scene, PathSolution& path) {
    path.report.usedMinimizer = true;
    const int before = path.iterations;
    const bool isStationary = m_minimizer.minimize(scene.problem, scene.pose, m_numDescents, path);
    m_numDescents -= path.iterations - before;
    if (isStationary) return true;
    return path.pathError < kNearlyStationary && m_newton.iterate(scene.problem, scene.pose, path);
}

void LocalSolver::rememberStarts(const PathSolution& path) {
    m_starts.clear();
    forEachArc(path.contacts, [&](const ContactArc& arc) { m_starts.push_back(arc.start); });
}

/** The starts from which the last contact set was solved. */
void LocalSolver::restoreStarts(PathSolution& path) const {
    auto start = m_starts.begin();
    forEachArc(path.contacts, [&](ContactArc& arc) { arc.start = *start++; });
}

/** Downhill from where Newton's method began, as a string would fall; if that too ends on a saddle, from there along
its direction of negative curvature. */
void LocalSolver::leaveSaddle(const PosedProblem& scene, PathSolution& path) {
    restoreStarts(path);
    if (!minimize(scene, path)) return;
    if (calcSecondVariation(scene, path).isStable()) return;
    moveAlongNegativeCurvature(scene, kSaddleMove, path);
    minimize(scene, path);
}

void updateClearances(const PosedProblem& scene, PathSolution& path) {
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int) {
        ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) return;
        contact.segment = in;
        const StraightSegment& line = path.segments[in];
        findSegmentClearance(scene.getSurface(e), scene.getPose(e), line.A, line.B, contact.clearance);
    });
}

void watchNearestPlaces(const PosedProblem& scene, PathSolution& path) {
    scene.forEachObstacle([&](int e) {
        ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) return;
        const StraightSegment& line = path.segments[contact.segment];
        takeNearerClearance(scene.getSurface(e), scene.getPose(e), line.A, line.B, contact.clearance);
    });
}

}  // namespace tautline
