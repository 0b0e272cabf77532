// SPDX-License-Identifier: Apache-2.0
#include "paths/contact_search.h"

#include "paths/obstacle_walk.h"
#include "paths/path_cusps.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

constexpr int kMaxRepairs = 4;       ///< of cusps and saddles, in the search from one start
constexpr double kSaddlePush = 0.1;  ///< of an arc on a saddle, sideways, in sizes

/** @return the obstacle whose contact violates its condition most, those that must lift first; -1 if none does */
int findWorstContact(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    int lift = -1, touch = -1;
    double shortest = kShortestArc, deepest = kContactTolerance;
    visitObstacles(problem, pose, [&](int e) {
        const ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) {
            const double length =
                contact.isSwitchedOff ? -kInfinity : contact.start.length / problem.getElement(e).surface->getSize();
            if (length < shortest) shortest = length, lift = e;
        } else if (!contact.isSwitchedOff) {
            const double depth = contact.clearance.distance * contact.clearance.scale;
            if (depth < deepest) deepest = depth, touch = e;
        }
    });
    return lift >= 0 ? lift : touch;
}

}  // namespace

void goBack(const PathSolution& earlier, PathSolution& path) {
    const int iterations = path.iterations, shots = path.shots;
    path = earlier;
    path.iterations = iterations, path.shots = shots;
}

bool ContactSearch::findStationaryPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    m_starts.resize(path.contacts.size());
    for (std::size_t e = 0; e < path.contacts.size(); ++e) m_starts[e] = path.contacts[e].start;
    if (m_newton.iterate(problem, pose, path)) return true;
    restoreStarts(path);
    return m_minimizer.minimize(problem, pose, path);
}

/** Of one contact set; where the stationary path turns back at an arc, the minimizer's takes its place if it does not.
 */
bool ContactSearch::findPathOfContacts(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (!findStationaryPath(problem, pose, path)) return false;
    if (!hasCusp(problem, pose, path)) return true;
    m_cusp = path;
    restoreStarts(path);
    if (!m_minimizer.minimize(problem, pose, path) || hasCusp(problem, pose, path)) goBack(m_cusp, path);
    return true;
}

/** The starts from which the last contact set was solved. */
void ContactSearch::restoreStarts(PathSolution& path) const {
    for (std::size_t e = 0; e < path.contacts.size(); ++e) path.contacts[e].start = m_starts[e];
}

bool ContactSearch::search(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const int maxChanges = 3 * problem.getNumElements() + 10;
    for (int change = 0; change <= maxChanges; ++change) {
        const bool isConverged = findPathOfContacts(problem, pose, path);
        updateClearances(problem, pose, path);
        if (!isConverged) return false;
        int worst = findWorstContact(problem, pose, path);
        if (worst < 0) {
            watchNearestPlaces(problem, pose, path);
            worst = findWorstContact(problem, pose, path);
        }
        if (worst < 0) return true;
        if (change < maxChanges) switchContact(problem, pose, worst, path);
    }
    return false;
}

bool ContactSearch::findMinimum(const PathProblem& problem, const PathPose& pose, const PassageRule& rule,
                                PathSolution& path) {
    for (int repair = 0; search(problem, pose, path); ++repair) {
        const PathVerification verification = verifyPath(problem, pose, path);
        if (verification.isMinimum()) return hasRightPassages(problem, pose, rule, path);
        if (repair == kMaxRepairs) return false;
        if (verification.condition == PathVerification::Condition::ReversedTangent)
            turnCuspsRound(problem, pose, nullptr, path);
        else if (verification.condition == PathVerification::Condition::Unstable)
            leaveSaddle(problem, pose, path);
        else
            return false;
    }
    return false;
}

void ContactSearch::leaveSaddle(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    restoreStarts(path);
    if (!m_minimizer.minimize(problem, pose, path)) return;
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.condition != PathVerification::Condition::Unstable) return;
    const Surface& surface = *problem.getElement(verification.element).surface;
    ObstacleContact& contact = path.contacts[verification.element];
    contact.start = calcPushedStart(surface, contact.start, contact.geodesic.P, kSaddlePush);
    m_minimizer.minimize(problem, pose, path);
}

void updateClearances(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    visitObstaclesOnSegments(problem, pose, path, [&](int e, int in, int) {
        ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) return;
        contact.segment = in;
        const StraightSegment& line = path.segments[in];
        findSegmentClearance(*problem.getElement(e).surface, pose.X_GE[e], line.A, line.B, contact.clearance);
    });
}

void watchNearestPlaces(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    visitObstacles(problem, pose, [&](int e) {
        ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) return;
        const StraightSegment& line = path.segments[contact.segment];
        takeNearerClearance(*problem.getElement(e).surface, pose.X_GE[e], line.A, line.B, contact.clearance);
    });
}

}  // namespace tautline
