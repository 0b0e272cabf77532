// SPDX-License-Identifier: Apache-2.0
#include "paths/search/route_check.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "paths/contacts/arc_course.h"
#include "paths/search/route.h"
#include "surfaces/nearest_point.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

using Kind = RouteDeviation::Kind;

/** PassNear says where outward is. */
bool isNearPoint(const PathElement& element, const ObstacleContact& contact) {
    const Vector3 N = contact.isTouched ? calcMiddleNormal(*element.surface, contact) : contact.clearance.N;
    return !(element.side_S.dot(N) < -kOnTheEdge);
}

/** Where a lifted string comes nearest to a surface: past an end of the segment the place that is watched is the foot
of the steepest descent from that end, which from afar leads elsewhere. */
Vector3 findPlaceBeside(const Surface& surface, const Pose& X_GS, const StraightSegment& line,
                        const LineClearance& clearance) {
    if (!surface.isConvex()) return clearance.C.p;
    const Vector3 A_S = X_GS.shiftBack(line.A), B_S = X_GS.shiftBack(line.B);
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return clearance.C.p;
    return findNearestPoint(surface, A_S + clearance.lineCoordinate / length * (B_S - A_S), clearance.C).p;
}

/** PassOnSide says where the middle is. @param line   that comes to the obstacle */
bool isOnSide(const PathElement& element, const Pose& X_GS, const StraightSegment& line,
              const ObstacleContact& contact) {
    const Surface& surface = *element.surface;
    const double onSide = contact.isTouched
                              ? calcMiddleAlong(surface, contact, element.side_S)
                              : element.side_S.dot(findPlaceBeside(surface, X_GS, line, contact.clearance));
    return !(onSide < -kOnTheEdge * surface.getSize());
}

/** The angle nearest to the hint's is off by half a turn at most; by a little more where the path's neighbors may stand
elsewhere than those that the hint was laid between. */
bool turnsAsOften(const WindAround& hint, double turning, bool isBetweenPoints) {
    constexpr double kRounding = 1e-6, kElsewhere = 0.2;
    return std::abs(turning / (2 * kPi) - hint.turns) < 0.5 * (1 + (isBetweenPoints ? kRounding : kElsewhere));
}

/** Whether a string over an endless body, between straight lines from A and to B, turns about its axis otherwise than a
search would begin: the short way round, or the long one if that alone leads to the side asked for. */
bool hasComeRoundAxis(const PathElement& element, const ObstacleContact& contact, const Vector3& A_S,
                      const Vector3& B_S) {
    constexpr double kHalfTurn = 3;  // [rad], less than pi since curvatures vary
    const auto calcMoment = [](const Vector3& a, const Vector3& b) { return a.x() * b.y() - a.y() * b.x(); };
    const DarbouxFrame& P = contact.geodesic.P;
    if (calcTurn(contact) < kHalfTurn) {
        // By less than a full turn: the short way if it goes the way of the angle from A to B.
        if (calcMoment(P.x, P.t) * calcMoment(A_S, B_S) >= 0) return false;
    } else {
        const double turning = std::abs(calcTurning(*element.surface, contact, A_S, B_S));
        if (turning < kPi + kTurnRounding) return false;
        if (turning > 2 * kPi) return true;
    }
    if (!element.side_S.allFinite()) return true;
    // The middle of the short way lies half way between its tangent points, on a circle through this path's; or where
    // the straight line passes clear of that, nearest to the axis.
    const double moment = calcMoment(A_S, B_S), way = std::copysign(1.0, moment);
    const double radius = std::max(P.x.head<2>().norm(), std::abs(moment) / (B_S - A_S).head<2>().norm());
    const auto calcTangentPoint = [&](const Vector3& p, double direction) -> Eigen::Vector2d {
        const double rho2 = p.head<2>().squaredNorm();
        const double sine = direction * std::sqrt(std::max(0.0, rho2 - radius * radius));
        return Eigen::Vector2d(radius * p.x() - sine * p.y(), sine * p.x() + radius * p.y()) / rho2;
    };
    const Eigen::Vector2d middle = calcTangentPoint(A_S, way) + calcTangentPoint(B_S, -way);
    return element.side_S.head<2>().dot(middle) > 0;
}

/** Whether a string over a body of another kind lies far from where a search would begin: where the line passes the
middle of the body, or else on the side asked for. */
bool liesElsewhere(const PathElement& element, const ObstacleContact& contact, const Vector3& A_S, const Vector3& B_S) {
    const Vector3 step = B_S - A_S;
    const Vector3 D = A_S + std::clamp(-A_S.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
    const Vector3& begin = D.dot(element.side_S) < 0 ? element.side_S : D;  // a side that is not asked for is none: D
    return begin.dot(calcMiddleNormal(*element.surface, contact).normalized()) < kCosineOfNear * begin.norm();
}

/** Whether a string through a ring goes through it otherwise than a search would begin. */
bool hasComeThroughOtherwise(const PathElement& element, const ObstacleContact& contact, const Vector3& A_S,
                             const Vector3& B_S) {
    if (!element.hasHole || contact.isSwitchedOff || !contact.passage.isKnown()) return false;
    const int asked = calcAskedPassages(element, A_S, B_S);
    return asked != PassageRule::kAny && contact.passage.count != asked;
}

/** Windings and passages are judged by themselves. */
bool isJudged(const PosedProblem& scene, const PathSolution& path, int e) {
    if (scene.isPoint(e)) return false;
    const ObstacleContact& contact = path.contacts[e];
    return !contact.isSwitchedOff && !contact.passage.isKnown() &&
           !std::holds_alternative<WindAround>(scene.getHint(e));
}

}  // namespace

RouteDeviation findContinuedDeviation(const PosedProblem& scene, const PathSolution& path) {
    const auto isKnown = [&](int e) { return scene.isPoint(e) || std::holds_alternative<PassNear>(scene.getHint(e)); };
    const std::vector<StraightSegment>& lines = path.segments;
    Vector3 before_G = lines.front().A;
    std::size_t next = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const int e = lines[i].fromElement;
        if (lines[i].toElement == e) continue;  // between two arcs
        while (next < i || !isKnown(lines[next].toElement)) ++next;
        if (!scene.isPoint(e)) {
            const Pose& X_GS = scene.getPose(e);
            const Vector3 A_S = X_GS.shiftBack(before_G), B_S = X_GS.shiftBack(lines[next].B);
            const PathElement& element = scene.problem.getElement(e);
            const auto isElsewhere = element.isEndless ? hasComeRoundAxis : liesElsewhere;
            if (hasComeThroughOtherwise(element, path.contacts[e], A_S, B_S) ||
                (isJudged(scene, path, e) && isElsewhere(element, path.contacts[e], A_S, B_S)))
                return {Kind::Continued, e};
        }
        if (isKnown(e)) before_G = lines[i].A;
    }
    return {};
}

RouteDeviation findSideDeviation(const PosedProblem& scene, const PathSolution& path) {
    RouteDeviation deviation;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        const PathElement& element = scene.problem.getElement(e);
        const ObstacleContact& contact = path.contacts[e];
        if (deviation.kind != Kind::None || contact.isSwitchedOff) return;
        if (const auto* winding = std::get_if<WindAround>(&element.hint)) {
            const Pose& X_GS = scene.getPose(e);
            const double turning = calcTurning(*element.surface, contact, X_GS.shiftBack(path.segments[in].A),
                                               X_GS.shiftBack(path.segments[out].B));
            if (!turnsAsOften(*winding, turning, scene.isBetweenPoints(path, in, out))) deviation = {Kind::Winding, e};
        } else if (!element.side_S.allFinite() || element.isAskedThroughHole) {
            return;
        } else if (std::holds_alternative<PassNear>(element.hint)) {
            if (!isNearPoint(element, contact)) deviation = {Kind::Near, e};
        } else if (!isOnSide(element, scene.getPose(e), path.segments[in], contact)) {
            deviation = {Kind::Side, e};
        }
    });
    return deviation;
}

RouteDeviation findDeviation(const PosedProblem& scene, const PathSolution& path) {
    RouteDeviation deviation = findSideDeviation(scene, path);
    if (!scene.problem.hasHoles()) return deviation;
    scene.forEachObstacle([&](int e) {
        const ObstacleContact& contact = path.contacts[e];
        const int count = contact.passage.count;
        const auto* thread = std::get_if<ThreadHole>(&scene.getHint(e));
        const bool isThroughHole = scene.problem.getElement(e).isAskedThroughHole;
        const bool isJudged = deviation.kind == Kind::None && !contact.isSwitchedOff && contact.passage.isKnown();
        if (isJudged && ((thread && count != thread->passages) || (isThroughHole && std::abs(count) != 1)))
            deviation = {Kind::Threading, e};
    });
    return deviation;
}

}  // namespace tautline
