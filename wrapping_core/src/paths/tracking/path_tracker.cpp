// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paths/problem/posed_problem.h"
#include "paths/problem/search_limits.h"
#include "paths/search/default_course.h"
#include "paths/search/threading.h"
#include "paths/tracking/contact_settling.h"
#include "paths/tracking/path_following.h"
#include "paths/tracking/pose_motion.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_stability.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

constexpr double kMaxTurn = 0.5;  ///< of neighbors against each other in one solve [rad]: one step of Newton's method
constexpr double kMostTurns = 200 * kPi;  ///< of a motion that is followed [rad]

/** Whether a path may be followed from there. */
bool isGoodStart(const TrackedPath& start) {
    return !start.pose.X_GE.empty() && start.solution.status != PathStatus::NotConverged &&
           start.solution.status != PathStatus::NotMinimum;
}

/** Whether the velocities are those with which a path begins its way to another one. */
bool isMotionOf(const TrackedPath& start, const PathMotion& motion) {
    return motion.time == start.time && motion.V_GE.size() == start.pose.X_GE.size();
}

/** Calls visit(a, b) for neighbors on the path between which it is wound up if they turn against each other: fixed
points and touched obstacles, one of two at least an obstacle. */
template <class Visitor>
void forEachWindingPair(const PosedProblem& scene, const PathSolution& path, Visitor visit) {
    int a = 0;
    for (int b = 1; b < scene.size(); ++b) {
        if (!scene.pose.hasElement(b) || !(scene.isPoint(b) || path.contacts[b].isTouched)) continue;
        if (!scene.isPoint(a) || !scene.isPoint(b)) visit(a, b);
        a = b;
    }
}

/** 1 + 2 cos of the turn between two rotations. */
double calcTurnTrace(const Matrix3& A, const Matrix3& B) {
    return A.cwiseProduct(B).sum();
}

/** Whether two elements turn against each other by more than kMaxTurn from one pose to another. */
bool turnsFarApart(const PathPose& from, const PathPose& to, int a, int b) {
    static const double kTraceOfMost = 1 + 2 * std::cos(kMaxTurn), kTraceOfHalf = 1 + 2 * std::cos(0.5 * kMaxTurn);
    const auto turnsLittle = [&](int e) { return calcTurnTrace(from.X_GE[e].R, to.X_GE[e].R) > kTraceOfHalf; };
    if (turnsLittle(a) && turnsLittle(b)) return false;  // nearly always, and cheap
    const Matrix3 before = from.X_GE[a].R.transpose() * from.X_GE[b].R, after = to.X_GE[a].R.transpose() * to.X_GE[b].R;
    return calcTurnTrace(before, after) < kTraceOfMost;
}

/** Whether elements turn against each other by more than one solve follows. */
bool turnsFar(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion, const TrackedPath& path) {
    const bool isMotionKnown = isMotionOf(start, motion);
    const double duration = path.time - start.time;
    bool isFar = false;
    forEachWindingPair({problem, path.pose}, start.solution, [&](int a, int b) {
        isFar |= turnsFarApart(start.pose, path.pose, a, b);
        if (isMotionKnown) isFar |= (motion.V_GE[a].w - motion.V_GE[b].w).norm() * std::abs(duration) > kMaxTurn;
    });
    return isFar;
}

/** The most by which the length of a path changes between two poses that are less than half a radian apart, if it goes
over continuously: its rate is the power of its forces, which are no larger than 2 on each element. [m] */
double calcMostChange(const PathProblem& problem, const TrackedPath& start, const PathPose& pose) {
    constexpr double kMostForce = 2 * 1.5;  // and contacts move on the way
    double change = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const Pose &before = start.pose.X_GE[e], &after = pose.X_GE[e];
        const auto calcMove = [&](const Vector3& p) { return (after * p - before * p).norm(); };
        const ObstacleContact& contact = start.solution.contacts[e];
        if (problem.getElement(e).isPoint()) change += kMostForce * calcMove(Vector3::Zero());
        if (contact.isTouched)
            change +=
                kMostForce * std::max(calcMove(contact.geodesic.P.x), calcMove(contact.getLastArc().geodesic.Q.x));
    }
    return change;
}

/** Whether a string has lost its path, and the minimizer has come to another minimum: shorter by more than any motion
shortens it. */
bool hasJumped(const PathProblem& problem, const TrackedPath& start, const TrackedPath& path) {
    if (start.pose.isActive != path.pose.isActive) return false;
    const double most = calcMostChange(problem, start, path.pose) + kContinuousLength * start.solution.length;
    return path.solution.length < start.solution.length - most;
}

/** The answer for a pose that is not finite: nothing to draw, nothing that pulls. */
void makeEmptyPath(const PathProblem& problem, PathSolution& path) {
    path = PathSolution();
    path.contacts.assign(problem.getNumElements(), ObstacleContact());
}

/** Whether a path that could not be followed to its pose would otherwise be without fault. */
bool isElsewhere(const PathProblem& problem, const TrackedPath& path) {
    const PathSolution& solution = path.solution;
    const bool isUnfollowed = solution.status == PathStatus::NotMinimum || solution.status == PathStatus::NotConverged;
    return isUnfollowed && solution.pathError < kVanishingError && !solution.segments.empty() &&
           !hasLeftAnyHole(solution) && verifyPath(problem, path.pose, solution, kShortestTrackedArc).isMinimum();
}

/** What a settling begins from: the contacts at the start where none were found, what encloses an end now, and what is
known at the start of how the path goes through rings. */
void prepareContacts(const PathSolution& start, PathSolution& path) {
    const std::vector<ObstacleContact> contacts = path.contacts;
    if (path.status == PathStatus::NotConverged) path.contacts = start.contacts;
    for (std::size_t e = 0; e < contacts.size(); ++e) {
        path.contacts[e].isSwitchedOff = contacts[e].isSwitchedOff;
        if (!start.contacts[e].isSwitchedOff) path.contacts[e].passage = start.contacts[e].passage;
    }
}

/** Of an obstacle that stays touched, by its numbers of arcs: a solve that keeps contacts splits and joins them alone.
 */
void listArcEvents(int e, int atStart, int before, int after, std::vector<PathEvent>& events) {
    using Kind = PathEvent::Kind;
    if (atStart > 0 && before > 0 && before != atStart)
        events.push_back({before > atStart ? Kind::Split : Kind::Joined, e});
    if (before > 0 && after > 0 && after != before)
        events.push_back({after > before ? Kind::ArcMade : Kind::ArcLost, e});
}

/** The obstacle on which a path has moved farthest, in sizes. */
int findFarthestMoved(const PathProblem& problem, const PathSolution& from, const PathSolution& to) {
    int farthest = -1;
    double most = -1;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !from.contacts[e].isTouched) continue;
        const double moved = to.contacts[e].isTouched
                                 ? (to.contacts[e].geodesic.P.x - from.contacts[e].geodesic.P.x).norm() /
                                       problem.getElement(e).surface->getSize()
                                 : kInfinity;
        if (moved > most) most = moved, farthest = e;
    }
    return farthest;
}

std::vector<PathEvent> listEvents(const PathProblem& problem, const PathSolution& start, const PathSolution& before,
                                  const PathSolution& after, int slippedAt) {
    using Kind = PathEvent::Kind;
    std::vector<PathEvent> events;
    if (slippedAt >= 0) events.push_back({Kind::Slipped, slippedAt});
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint()) continue;
        if (after.contacts[e].hasLeftHole && !start.contacts[e].hasLeftHole) events.push_back({Kind::LeftHole, e});
        const bool wasOff = start.contacts[e].isSwitchedOff, isOff = after.contacts[e].isSwitchedOff;
        const bool wasTouched = before.contacts[e].isTouched || (isOff && start.contacts[e].isTouched);
        listArcEvents(e, start.contacts[e].getNumArcs(), before.contacts[e].getNumArcs(),
                      after.contacts[e].getNumArcs(), events);
        if (wasTouched == after.contacts[e].isTouched) continue;
        if (wasTouched)
            events.push_back({isOff ? Kind::SwitchedOff : Kind::Lifted, e});
        else
            events.push_back({wasOff ? Kind::SwitchedOn : Kind::Touched, e});
    }
    return events;
}

PathSolverOptions limitIterations(PathSolverOptions options) {
    options.maxIterations = std::min(options.maxIterations, kMaxPartIterations);
    return options;
}

}  // namespace

struct PathTracker::Workspace {
    explicit Workspace(const PathSolverOptions& options)
        : solver(options),
          continuer(options.withoutSearch()),
          brief(limitIterations(options)),
          follower(limitIterations(options)) {}

    PathSolver solver;
    PathSolver continuer;  ///< finds nothing anew
    PathSolver brief;      ///< for poses that can be come to in parts
    PathFollower follower;
    Route asked;
    ContactSettler settler;
    PoseMotion way;
};

PathTracker::PathTracker(const PathSolverOptions& options) : m_workspace(std::make_unique<Workspace>(options)) {}
PathTracker::PathTracker(PathTracker&&) noexcept = default;
PathTracker& PathTracker::operator=(PathTracker&&) noexcept = default;
PathTracker::~PathTracker() = default;

const PathSolverOptions& PathTracker::getOptions() const {
    return m_workspace->solver.getOptions();
}

void PathTracker::solve(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (!pose.isFinite()) return makeEmptyPath(problem, path);
    const bool isRoomKept = !problem.hasObstacles() && path.contacts.size() == pose.X_GE.size();
    if (!isRoomKept) path.contacts.clear();
    m_workspace->solver.solve(problem, pose, path);
}

void PathTracker::solveFrom(const PathProblem& problem, const PathSolution& start, const PathPose& pose,
                            PathSolution& path) {
    if (!pose.isFinite()) return makeEmptyPath(problem, path);
    const auto isMinimum = [](const PathSolution& solution) {
        return solution.status == PathStatus::Solved || solution.status == PathStatus::EndInside;
    };
    if (problem.hasObstacles() && !start.isEmpty() && isMinimum(start)) {
        path = start;
        m_workspace->continuer.solve(problem, pose, path);
        const bool isAsAsked = path.deviation.kind == RouteDeviation::Kind::None;
        if (isMinimum(path) && isAsAsked && isOnDefaultCourse({problem, pose}, path, m_workspace->asked)) return;
    }
    solve(problem, pose, path);
}

void PathTracker::trackFreely(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion,
                              TrackedPath& path) {
    if (!path.pose.isFinite()) return makeEmptyPath(problem, path.solution);
    if (start.solution.isEmpty() || !problem.hasObstacles()) return solve(problem, path);
    const bool isFar = isGoodStart(start) && turnsFar(problem, start, motion, path);
    // Wound up as the motion says, even where contacts change on the way.
    if (!isFar || !follow(problem, start, motion, 1, path)) path.solution = start.solution;
    m_workspace->solver.solve(problem, path.pose, path.solution);
}

void PathTracker::track(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion,
                        TrackedPath& path) {
    if (!path.pose.isFinite()) return makeEmptyPath(problem, path.solution);
    if (start.solution.isEmpty() || !problem.hasObstacles()) return solve(problem, path);
    PathSolution& solution = path.solution;
    const bool canFollow = isGoodStart(start), isFar = canFollow && turnsFar(problem, start, motion, path);
    if (isFar && follow(problem, start, motion, 1, path)) return;
    solution = start.solution;
    PathSolver& solver = canFollow ? m_workspace->brief : m_workspace->solver;
    solver.solveKeepingContacts(problem, path.pose, solution);
    if (hasSwallowedEnd(solution)) return;
    // A path that has lost its turns is not the one that was asked for.
    if (isFar) {
        solution.status = PathStatus::NotConverged;
        return;
    }
    if (isHoldingPath(problem, path.pose, solution)) {
        const bool mayHaveJumped = canFollow && solution.report.usedMinimizer;
        if (mayHaveJumped && hasJumped(problem, start, path)) solution.status = PathStatus::NotMinimum;
        return;
    }
    PathStatus status = solution.status;
    if (canFollow && follow(problem, start, motion, 0.5, path)) {
        if (hasJumped(problem, start, path)) solution.status = PathStatus::NotMinimum;
        return;
    }
    if (status == PathStatus::Solved) solution.status = PathStatus::NotMinimum;
}

/** @param firstPart   of the way, or less where elements turn far
@param path   unchanged if the path cannot be followed */
bool PathTracker::follow(const PathProblem& problem, const TrackedPath& start, const PathMotion& motion,
                         double firstPart, TrackedPath& path) {
    static const std::vector<SpatialVelocity> kUnknown;
    PoseMotion& way = m_workspace->way;
    way.set(start.pose, isMotionOf(start, motion) ? motion.V_GE : kUnknown, path.time - start.time, path.pose);
    double turn = kMaxTurn;
    forEachWindingPair({problem, path.pose}, start.solution,
                       [&](int a, int b) { turn = std::max(turn, way.calcTurnBound(a, b)); });
    if (!(turn < kMostTurns)) return false;
    const double largestPart = kMaxTurn / turn;
    PathSolution followed = start.solution;
    if (!m_workspace->follower.follow(m_workspace->brief, problem, way, std::min(firstPart, largestPart), largestPart,
                                      followed))
        return false;
    path.solution = followed;
    return true;
}

std::vector<PathEvent> PathTracker::resolveEvent(const PathProblem& problem, const TrackedPath& start,
                                                 TrackedPath& path) {
    const PathSolution before = path.solution;
    const PathSolution& from = start.solution.isEmpty() ? before : start.solution;
    const bool isElsewhereNow = isGoodStart(start) && isElsewhere(problem, path);
    if (isElsewhereNow) path.solution.status = PathStatus::Solved;  // a minimum, though not the one that it was
    prepareContacts(from, path.solution);
    int slippedAt = m_workspace->settler.settle(m_workspace->solver, problem, path.pose, path.solution);
    if (isElsewhereNow && slippedAt < 0) slippedAt = findFarthestMoved(problem, from, path.solution);
    return listEvents(problem, from, before, path.solution, slippedAt);
}

void PathTracker::settle(const PathProblem& problem, TrackedPath& path) {
    if (path.solution.status != PathStatus::NotConverged)
        m_workspace->settler.settle(m_workspace->solver, problem, path.pose, path.solution);
}

double PathTracker::calcStabilityWitness(const PathProblem& problem, const TrackedPath& start,
                                         const TrackedPath& path) {
    constexpr double kTiny = std::numeric_limits<double>::min(), kGrowth = 10;
    if (path.solution.status == PathStatus::NotConverged) return -1;
    const auto calcMargin = [&](const TrackedPath& at) {
        return calcPathStability(problem, at.pose, at.solution).margin;
    };
    double threshold = kSlipMargin;
    if (start.solution.status == PathStatus::NotMinimum && !start.pose.X_GE.empty())
        threshold = kGrowth * std::min(calcMargin(start), kSlipMargin);
    if (isGoodStart(start) && isElsewhere(problem, path)) return -1;
    const double margin = calcMargin(path) - threshold;
    return margin == 0 ? -kTiny : margin;
}

PathStatus PathTracker::calcStatus(const PathProblem& problem, const TrackedPath& path) {
    const PathSolution& solution = path.solution;
    if (solution.status != PathStatus::Solved) return solution.status;
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (!problem.getElement(e).isPoint() && path.pose.hasElement(e) && solution.contacts[e].isSwitchedOff)
            return PathStatus::EndInside;
    if (hasLeftAnyHole(solution)) return PathStatus::NotMinimum;
    using Condition = PathVerification::Condition;
    switch (verifyPath(problem, path.pose, solution, kShortestTrackedArc).condition) {
        case Condition::None:
            return PathStatus::Solved;
        case Condition::OutsideDomain:
            return PathStatus::LeftDomain;
        case Condition::Unstable:
            if (calcPathStability(problem, path.pose, solution).holds()) return PathStatus::Solved;
            [[fallthrough]];
        default:
            return PathStatus::NotMinimum;
    }
}

std::string PathTracker::explainStatus(const PathProblem& problem, const TrackedPath& path) {
    if (isElsewhere(problem, path)) return "a local minimum, but not the one that the motion leads to";
    PathSolution judged = path.solution;
    judged.status = calcStatus(problem, path);
    return tautline::explainStatus(problem, path.pose, judged, kShortestTrackedArc);
}

}  // namespace tautline
