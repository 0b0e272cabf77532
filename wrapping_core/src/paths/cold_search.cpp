// SPDX-License-Identifier: Apache-2.0
#include "paths/cold_search.h"

#include <cmath>

#include "paths/hint_following.h"
#include "tautline/paths/path_verification.h"

namespace tautline {
namespace {

constexpr double kStringPush = 0.1;  ///< the first one of a string that goes beyond a conjugate point, in sizes
constexpr int kMaxStringPushes = 6;  ///< each twice the one before
constexpr int kMaxOtherSides = 4;    ///< obstacles that are tried from the other side
/** Geodesics shot after which no further search begins: scenes that are solved need half as many at most. */
constexpr int kMaxShotsPerElement = 20000;

/** Nothing but a point at most: what leads to no minimum there may on another side. */
bool leavesSideOpen(const StartHint& hint) {
    return std::holds_alternative<std::monostate>(hint) || std::holds_alternative<PassNear>(hint);
}

/** The pose with each element moved a little, in a way of its own. */
PathPose calcMovedPose(const PathPose& pose) {
    constexpr double kMove = 1e-9;  // of the distance between the ends
    PathPose moved = pose;
    const double extent = (pose.X_GE.back().p - pose.X_GE.front().p).norm();
    for (std::size_t e = 0; e < moved.X_GE.size(); ++e) {
        const double phase = 1.0 + static_cast<double>(e);
        moved.X_GE[e].p += kMove * extent * Vec3(std::sin(phase), std::sin(2 * phase), std::sin(3 * phase));
    }
    return moved;
}

}  // namespace

bool ColdSearch::findPathAlong(const PathProblem& problem, const PathPose& pose, const PathSolution& previous,
                               PathSolution& path) {
    m_string.beginSearch();
    return findPath(problem, pose, calcPreviousCourse(problem, pose, previous), path);
}

bool ColdSearch::findPathFromHints(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (!findPathOfScene(problem, pose, path)) return false;
    // Where a string slips off, it ends elsewhere than it was laid.
    path.followsHints = path.followsHints && turnsAsHinted(problem, pose, path);
    return true;
}

bool ColdSearch::findPathOfScene(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (findHintedPath(problem, pose, path)) return true;
    if (path.fault.kind != StringFault::Kind::Sliding) return false;
    // A string that still slides may come to rest in a scene that is moved by next to nothing.
    m_stuck = path;
    if (findHintedPath(problem, calcMovedPose(pose), path) && m_search.findMinimum(problem, pose, PassageRule(), path))
        return true;
    goBack(m_stuck, path);
    return false;
}

bool ColdSearch::findHintedPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    StartCourse course = calcHintedCourse(problem, pose);
    m_string.beginSearch();
    m_spare.contacts.clear();
    path.followsHints = findPath(problem, pose, course, path);
    if (path.followsHints || findPathWithoutPoints(problem, pose, course, path) ||
        findOtherSides(problem, pose, course, path))
        return true;
    if (m_spare.isEmpty()) return findPathWithoutHints(problem, pose, path);
    goBack(m_spare, path);
    return true;
}

/** Lets a string fall taut along the guides, ever finer, until the search leads on from it to a
verified minimum. */
bool ColdSearch::findPath(const PathProblem& problem, const PathPose& pose, const StartCourse& course,
                          PathSolution& path) {
    struct Level {
        double fineness, tolerance;
        int maxSweeps;
    };
    constexpr Level kLevels[] = {{1.0, 2e-3, 400}, {0.5, 2e-4, 1500}, {0.25, 2e-5, 3000}};
    constexpr Level kPatient = {0.5, 1e-6, 6000};  // for strings that slide off slowly
    path.wasCold = true;
    path.fault = {};
    m_string.lay(problem, pose, course.guides);
    const auto tighten = [&](const Level& level) {
        return tightenString(problem, pose, level.fineness, level.tolerance, level.maxSweeps, course.passages, path);
    };
    for (const Level& level : kLevels) {
        if (tighten(level)) return true;
        double push = kStringPush;
        for (int i = 0; i < kMaxStringPushes && pushOffConjugatePoint(problem, pose, push, path); ++i, push *= 2)
            if (tighten(kPatient)) return true;
    }
    // A string in which nothing is wrong may still slide, slower than was asked for.
    if (m_string.findFault(problem).kind == StringFault::Kind::None && tighten(kPatient)) return true;
    path.fault = m_string.findFault(problem);
    return false;
}

/** @return true if the path that the relaxed string suggests leads on to a verified minimum */
bool ColdSearch::tightenString(const PathProblem& problem, const PathPose& pose, double fineness, double tolerance,
                               int maxSweeps, const PassageRule& rule, PathSolution& path) {
    m_string.relax(problem, fineness, tolerance, maxSweeps);
    if (path.shots > kMaxShotsPerElement * problem.getNumElements()) return false;
    for (ObstacleContact& contact : path.contacts) contact.clearance = LineClearance();
    m_string.extractContacts(problem, pose, path.contacts);
    if (m_search.findMinimum(problem, pose, rule, path)) return true;
    if (m_spare.isEmpty() && isMinimumBesideRings(problem, pose, rule, path)) m_spare = path;
    return false;
}

/** True for a minimum that only misses the way in which the straight line goes through rings without a hint. */
bool ColdSearch::isMinimumBesideRings(const PathProblem& problem, const PathPose& pose, PassageRule rule,
                                      const PathSolution& path) const {
    if (rule.counts.empty() || !(path.pathError <= m_tolerance)) return false;
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (std::holds_alternative<std::monostate>(problem.getElement(e).hint)) rule.counts[e] = PassageRule::kAny;
    return hasRightPassages(problem, pose, rule, path) && verifyPath(problem, pose, path).isMinimum();
}

/** An arc beyond its conjugate point is shortest among geodesics nearby, but not among curves: only the string, which
can bend inside the arc, leads on from there. Laid symmetrically it stays, so that it is pushed sideways.
@return false if the path is no such one */
bool ColdSearch::pushOffConjugatePoint(const PathProblem& problem, const PathPose& pose, double push,
                                       const PathSolution& path) {
    if (!(path.pathError <= m_tolerance)) return false;
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.condition != PathVerification::Condition::ConjugatePoint) return false;
    const int e = verification.element;
    m_string.push(e,
                  push * problem.getElement(e).surface->getSize() * (pose.X_GE[e].R * path.contacts[e].geodesic.P.B));
    return true;
}

/** @return false with `path` as it was, but for what was counted */
bool ColdSearch::tryCourse(const PathProblem& problem, const PathPose& pose, const StartCourse& course,
                           PathSolution& path) {
    m_before = path;
    if (findPath(problem, pose, course, path)) return true;
    goBack(m_before, path);
    return false;
}

/** Where points near the path lead to no minimum (they may be far from any), the sides that the straight lines between
the others suggest may. */
bool ColdSearch::findPathWithoutPoints(const PathProblem& problem, const PathPose& pose, StartCourse course,
                                       PathSolution& path) {
    bool hasPoints = false;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!std::holds_alternative<PassNear>(problem.getElement(e).hint)) continue;
        hasPoints = hasPoints || !course.guides[e].empty();
        course.guides[e].clear();
    }
    return hasPoints && tryCourse(problem, pose, course, path);
}

/** At last: a string that slips off where it was to be wound or threaded has a minimum elsewhere. */
bool ColdSearch::findPathWithoutHints(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const int n = problem.getNumElements();
    StartCourse course{StartGuides(n), PassageRule{std::vector<int>(n, PassageRule::kAny)}};
    bool hasHints = false;
    for (int e = 0; e < n; ++e) {
        const PathElement& element = problem.getElement(e);
        if (pose.hasElement(e) && element.isPoint()) course.guides[e] = {pose.X_GE[e].p};
        hasHints = hasHints || !leavesSideOpen(element.hint);
    }
    if (!hasHints) return false;
    m_string.beginSearch();
    if (tryCourse(problem, pose, course, path)) return true;
    // Where nothing is known against the hinted string, what keeps the free one from a minimum is the reason.
    if (path.fault.kind == StringFault::Kind::None) path.fault = m_string.findFault(problem);
    return false;
}

/** Where the side that the straight line or a point near the path suggests leads to no minimum (surfaces that overlap
there, a contact that would have to be two), the other side of one obstacle may. */
bool ColdSearch::findOtherSides(const PathProblem& problem, const PathPose& pose, StartCourse& course,
                                PathSolution& path) {
    int tries = 0;
    for (int e = 0; e < problem.getNumElements() && tries < kMaxOtherSides; ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e) || !path.contacts[e].isTouched || !leavesSideOpen(element.hint))
            continue;
        const std::vector<Vec3> hinted = course.guides[e];
        course.guides[e] = {calcOppositeGuide(problem, pose, path, e)};
        if (course.guides[e].front().allFinite() && ++tries && tryCourse(problem, pose, course, path)) return true;
        course.guides[e] = hinted;
    }
    return false;
}

}  // namespace tautline
