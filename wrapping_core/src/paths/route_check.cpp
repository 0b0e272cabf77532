// SPDX-License-Identifier: Apache-2.0
#include "paths/route_check.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "paths/route.h"
#include "surfaces/arc_walker.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

using Kind = RouteDeviation::Kind;

constexpr double kOnTheEdge = 1e-9;  ///< of a unit vector or a size, by which a side may be missed in rounding

/** By how much a path turns about the z axis of S from A to B, which lie before and after its arc on straight lines,
positive from x to y [rad]: pieces of the arc turn by so little that the way round is plain. */
double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S) {
    constexpr double kMostPieces = 2000;
    double turning = 0;
    Vec3 last = A_S;
    const auto goTo = [&](const Vec3& p) {
        turning += std::atan2(last.x() * p.y() - last.y() * p.x(), last.head<2>().dot(p.head<2>()));
        last = p;
    };
    if (contact.isTouched) {
        const Geodesic& arc = contact.geodesic;
        const double curvature = std::max({std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN), 1 / surface.getSize()});
        const int pieces = static_cast<int>(std::min(kMostPieces, 2 + 2 * std::abs(contact.start.length) * curvature));
        ArcWalker walker(surface, contact.start, kRoughlyAlong, pieces);
        goTo(arc.P.x);
        for (int i = 0; i < pieces; ++i) goTo(walker.next().Q.x);
    }
    goTo(B_S);
    return turning;
}

constexpr double kRoundingOfTurns = 1e-9;  ///< [rad]
constexpr double kCosineOfNear = 0.5;      ///< 60 degrees: minima of one body that lie nearer to each other are few

/** By how much an arc turns, at least nearly [rad]. */
double calcTurn(const ObstacleContact& contact) {
    const Geodesic& arc = contact.geodesic;
    return contact.start.length * std::max(std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN));
}

/** The frame in the middle of an arc, shot to no more accuracy than a side needs. */
DarbouxFrame shootToMiddle(const Surface& surface, const ObstacleContact& contact) {
    GeodesicStart half = contact.start;
    half.length *= 0.5;
    Geodesic geodesic;
    surface.shootGeodesic(half, kRoughlyAlong, geodesic);
    return geodesic.Q;
}

/** Outward in the middle of an arc: of a circular arc the normals of its ends add up to that direction if it turns by
little, and its tangents differ by it if it turns by up to a full turn. */
Vec3 calcMiddleNormal(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kFullTurn = 6;  // [rad], less than 2 pi since curvatures vary
    const Geodesic& arc = contact.geodesic;
    if (calcTurn(contact) > kFullTurn) return shootToMiddle(surface, contact).N;
    return arc.P.t.dot(arc.Q.t) > 0 ? Vec3(arc.P.N + arc.Q.N) : Vec3(arc.P.t - arc.Q.t);
}

/** A point over which the middle of an arc lies: that of its chord while it turns by less than half a circle. */
Vec3 calcMiddlePoint(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kHalfTurn = 2.5;  // [rad], less than pi since curvatures vary
    const Geodesic& arc = contact.geodesic;
    if (calcTurn(contact) > kHalfTurn) return shootToMiddle(surface, contact).x;
    return 0.5 * (arc.P.x + arc.Q.x);
}

/** PassNear says where outward is, PassOnSide where the middle is. */
bool isOnSide(const PathElement& element, const ObstacleContact& contact) {
    const Surface& surface = *element.surface;
    if (std::holds_alternative<PassNear>(element.hint)) {
        const Vec3 N = contact.isTouched ? calcMiddleNormal(surface, contact) : contact.clearance.N;
        return !(element.side_S.dot(N) < -kOnTheEdge);
    }
    const Vec3 p = contact.isTouched ? calcMiddlePoint(surface, contact) : contact.clearance.C.p;
    return !(element.side_S.dot(p) < -kOnTheEdge * surface.getSize());
}

/** The angle nearest to the hint's is off by half a turn at most; by a little more where the path's neighbors may stand
elsewhere than those that the hint was laid between. */
bool turnsAsOften(const WindAround& hint, double turning, bool isBetweenPoints) {
    constexpr double kRounding = 1e-6, kElsewhere = 0.2;
    return std::abs(turning / (2 * kPi) - hint.turns) < 0.5 * (1 + (isBetweenPoints ? kRounding : kElsewhere));
}

/** By how much a route turns about the z axis of S between two points, over the waypoints between them [rad]. */
double calcRouteTurning(const Pose& X_GS, const Vec3& from_G, const std::vector<Vec3>& waypoints, const Vec3& to_G) {
    double turning = 0;
    Vec3 last = X_GS.shiftBack(from_G);
    const auto goTo = [&](const Vec3& point_G) {
        const Vec3 p = X_GS.shiftBack(point_G);
        turning += std::atan2(last.x() * p.y() - last.y() * p.x(), last.head<2>().dot(p.head<2>()));
        last = p;
    };
    for (const Vec3& point_G : waypoints) goTo(point_G);
    goTo(to_G);
    return turning;
}

/** Outward where a search would have the path: at the point of a hint, or where the straight line comes nearest to the
obstacle or lies deepest in it. */
Vec3 calcDefaultSide(const PosedProblem& scene, int e, const std::vector<Vec3>& waypoints, const Vec3& from_G,
                     const Vec3& to_G) {
    const Surface& surface = scene.getSurface(e);
    if (!waypoints.empty())
        return surface.calcFrame(surface.findSurfacePoint(scene.getPose(e).shiftBack(waypoints.front())), Vec3(1, 2, 3))
            .N;
    LineClearance line;
    findSegmentClearance(surface, scene.getPose(e), from_G, to_G, line);
    return line.N;
}

/** Where an obstacle lies between the waypoints of a route. */
struct RoutePlace {
    const std::vector<Vec3>& waypoints;  ///< of its own
    Vec3 from_G, to_G;                   ///< before and after
};

/** Whether the path is in the class of the route about a body without end: there it is decided by the turning. */
bool turnsAsRoute(const PosedProblem& scene, const PathSolution& path, int e, int in, int out,
                  const RoutePlace& route) {
    const StraightSegment &before = path.segments[in], &after = path.segments[out];
    const double asked = calcRouteTurning(scene.getPose(e), route.from_G, route.waypoints, route.to_G);
    const Pose& X_GS = scene.getPose(e);
    const double turning =
        calcTurning(scene.getSurface(e), path.contacts[e], X_GS.shiftBack(before.A), X_GS.shiftBack(after.B));
    // Where the neighbors stand elsewhere than the waypoints, half a turn says too little.
    const bool isBetweenPoints = scene.isPoint(before.fromElement) && scene.isPoint(after.toElement);
    return std::abs(turning - asked) < (isBetweenPoints ? 1 : 0.5) * kPi;
}

/** Whether the path passes a body where a search would have it, clearly: near the edge of that side there may be
another minimum, which the search prefers. */
bool isOnSideOfRoute(const PosedProblem& scene, const PathSolution& path, int e, const RoutePlace& route) {
    constexpr double kClear = 0.5;  // cosine
    const ObstacleContact& contact = path.contacts[e];
    if (contact.isTouched && !(calcTurn(contact) < 2 * kPi)) return false;
    const Vec3 N =
        contact.isTouched ? calcMiddleNormal(scene.getSurface(e), contact).normalized() : contact.clearance.N;
    return N.dot(calcDefaultSide(scene, e, route.waypoints, route.from_G, route.to_G)) > kClear;
}

/** A string through a ring whose ends pull it to one side lies on the tube there; on the far side there is another
minimum. */
bool liesWhereEndsPull(const PosedProblem& scene, int e, const ObstacleContact& contact, const RoutePlace& route) {
    constexpr double kClear = 0.5;  // cosine
    if (!contact.isTouched) return true;
    const Vec3 axis = scene.getSurface(e).getHole()->getAxis();
    const Pose& X_GS = scene.getPose(e);
    const auto calcAside = [&](const Vec3& v) { return Vec3(v - axis.dot(v) * axis).normalized(); };
    const Vec3 pull = X_GS.shiftBack(route.from_G).normalized() + X_GS.shiftBack(route.to_G).normalized();
    return calcAside(pull).dot(calcAside(contact.geodesic.P.x + contact.geodesic.Q.x)) > kClear;
/** Whether a string over an endless body turns from A to B by half a turn at most: settled without a walk along the
arc where both that and the way from A to B are the same by less than half a turn. */
bool turnsTheShortWay(const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S) {
    constexpr double kQuarterTurn = 0.5 * kPi;
    const DarbouxFrame& P = contact.geodesic.P;
    const auto calcMoment = [](const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); };
    return calcTurn(contact) < kQuarterTurn && calcMoment(P.x, P.t) * calcMoment(A_S, B_S) > 0;
}

/** Whether a string over a body, between straight lines from A and to B, runs otherwise than a search would begin. */
bool hasComeRound(const PathElement& element, const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S) {
    const Surface& surface = *element.surface;
    const bool hasSide = element.side_S.allFinite();
    if (element.isEndless) {
        if (turnsTheShortWay(contact, A_S, B_S)) return false;
        const double turning = calcTurning(surface, contact, A_S, B_S);
        const double asked = hasSide && std::abs(turning) > kPi ? calcAskedTurn(element, A_S, B_S) : 0;
        return std::abs(turning - asked) > kPi + kRoundingOfTurns;
    }
    // A search begins where the line passes the middle of the body, or else on the side asked for.
    const Vec3 step = B_S - A_S;
    const Vec3 D = A_S + std::clamp(-A_S.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
    const Vec3& begin = hasSide && D.dot(element.side_S) < 0 ? element.side_S : D;
    return begin.dot(calcMiddleNormal(surface, contact).normalized()) < kCosineOfNear * begin.norm();
}

}  // namespace

RouteDeviation findContinuedDeviation(const PosedProblem& scene, const PathSolution& path) {
    int before = 0, after = 0;
    for (int e = 0; e < scene.size(); ++e) {
        if (!scene.pose.hasElement(e)) continue;
        if (scene.isPoint(e)) before = e;
        const PathElement& element = scene.problem.getElement(e);
        const ObstacleContact& contact = path.contacts[e];
        const bool isJudged = !scene.isPoint(e) && contact.isTouched && !contact.isSwitchedOff &&
                              !std::holds_alternative<WindAround>(element.hint) && !contact.passage.isKnown();
        if (!isJudged) continue;
        while (after <= e || !scene.isPoint(after) || !scene.pose.hasElement(after)) ++after;
        const Pose& X_GS = scene.getPose(e);
        const Vec3 A_S = X_GS.shiftBack(scene.getPose(before).p), B_S = X_GS.shiftBack(scene.getPose(after).p);
        if (hasComeRound(element, contact, A_S, B_S)) return {Kind::Continued, e};
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
            const bool isBetweenPoints =
                scene.isPoint(path.segments[in].fromElement) && scene.isPoint(path.segments[out].toElement);
            if (!turnsAsOften(*winding, turning, isBetweenPoints)) deviation = {Kind::Winding, e};
        } else if (element.side_S.allFinite() && !element.isAskedThroughHole && !isOnSide(element, contact)) {
            deviation = {std::holds_alternative<PassNear>(element.hint) ? Kind::Near : Kind::Side, e};
        }
    });
    return deviation;
}

RouteDeviation findDeviation(const PosedProblem& scene, const PathSolution& path) {
    RouteDeviation deviation = findSideDeviation(scene, path);
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

bool isOnDefaultCourse(const PosedProblem& scene, const PathSolution& path) {
    if (findDeviation(scene, path).kind != Kind::None) return false;
    const Route asked = calcAskedRoute(scene);
    bool isOnCourse = true;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        const ObstacleContact& contact = path.contacts[e];
        if (!isOnCourse || contact.isSwitchedOff) return;
        int last = e - 1, next = e + 1;
        while (asked.waypoints[last].empty()) --last;
        while (asked.waypoints[next].empty()) ++next;
        const RoutePlace route{asked.waypoints[e], asked.waypoints[last].back(), asked.waypoints[next].front()};
        const int count = asked.threading.counts[e];
        isOnCourse = !contact.yields;
        if (count != PassageRule::kAny)
            isOnCourse = isOnCourse && contact.passage.isKnown() && contact.passage.count == count;
        if (!isOnCourse) return;
        if (scene.problem.getElement(e).isEndless)
            isOnCourse = turnsAsRoute(scene, path, e, in, out, route);
        else if (count == PassageRule::kAny || (count == 0 && route.waypoints.empty()))
            isOnCourse = isOnSideOfRoute(scene, path, e, route);
        else  // more often, or round the ring, in several ways
            isOnCourse = std::abs(count) == 1 && liesWhereEndsPull(scene, e, contact, route);
    });
    return isOnCourse;
}

}  // namespace tautline
