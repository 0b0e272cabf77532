// SPDX-License-Identifier: Apache-2.0
#include "paths/search/default_course.h"

#include <cmath>

#include "paths/contacts/arc_course.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

/** By how much a route turns about the z axis of S between two points, over the waypoints between them [rad]. */
double calcRouteTurning(const Pose& X_GS, const Vector3& from_G, const std::vector<Vector3>& waypoints,
                        const Vector3& to_G) {
    double turning = 0;
    Vector3 last = X_GS.shiftBack(from_G);
    const auto goTo = [&](const Vector3& point_G) {
        const Vector3 p = X_GS.shiftBack(point_G);
        turning += calcShortTurning(last, p);
        last = p;
    };
    for (const Vector3& point_G : waypoints) goTo(point_G);
    goTo(to_G);
    return turning;
}

/** Outward where a search would have the path: at the point of a hint, or where the straight line comes nearest to the
obstacle or lies deepest in it. */
Vector3 calcDefaultSide(const PosedProblem& scene, int e, const std::vector<Vector3>& waypoints, const Vector3& from_G,
                        const Vector3& to_G) {
    const Surface& surface = scene.getSurface(e);
    if (!waypoints.empty())
        return surface
            .calcFrame(surface.findSurfacePoint(scene.getPose(e).shiftBack(waypoints.front())), Vector3(1, 2, 3))
            .N;
    LineClearance line;
    findSegmentClearance(surface, scene.getPose(e), from_G, to_G, line);
    return line.N;
}

/** Where an obstacle lies between the waypoints of a route. */
struct RoutePlace {
    const std::vector<Vector3>& waypoints;  ///< of its own
    Vector3 from_G, to_G;                   ///< before and after
};

/** Whether the path is in the class of the route about a body without end: there it is decided by the turning.
@param asked   that of the route [rad] */
bool turnsAsRoute(const PosedProblem& scene, const PathSolution& path, int e, int in, int out, double asked) {
    const StraightSegment &before = path.segments[in], &after = path.segments[out];
    const Pose& X_GS = scene.getPose(e);
    const double turning =
        calcTurning(scene.getSurface(e), path.contacts[e], X_GS.shiftBack(before.A), X_GS.shiftBack(after.B));
    // Where the neighbors stand elsewhere than the waypoints, half a turn says too little.
    return std::abs(turning - asked) < (scene.isBetweenPoints(path, in, out) ? 1 : 0.5) * kPi;
}

/** Whether an endless body lies alone between the points beside it, with no more than a side asked for. */
bool isAloneWithSide(const PosedProblem& scene, int e) {
    const PathElement& element = scene.problem.getElement(e);
    if (!element.isEndless || !std::holds_alternative<PassOnSide>(element.hint)) return false;
    const auto isPointOrNext = [&](int next, int step) {
        while (!scene.pose.hasElement(next)) next += step;
        return scene.isPoint(next);
    };
    return isPointOrNext(e - 1, -1) && isPointOrNext(e + 1, 1);
}

/** Of the angle between the outward normals of a path and of the straight line, up to which they clearly pass a body on
the same side. (2026-11-27: over the ellipsoid of a rib cage a search found another minimum at 0.85.) */
constexpr double kCosineOfSameSide = 0.9;
/** Of the angle between its ends' tangents, up to which an arc turns little: beyond that an ellipsoid has three minima
about the straight line, and which of them a search finds its lowest place does not tell. */
constexpr double kCosineOfShortArc = 0.3;

/** Whether the path passes a body where a search would have it, clearly: near the edge of that side there may be
another minimum, which the search prefers, as there may be beside another obstacle that the path touches, since then the
straight line does not tell how it comes from there. (2026-11-27: over the cylinder and the ellipsoid of an
infraspinatus two minima touch both.) */
bool isOnSideOfRoute(const PosedProblem& scene, const PathSolution& path, int e, int in, int out,
                     const RoutePlace& route) {
    const ObstacleContact& contact = path.contacts[e];
    if (contact.isTouched && !(calcTurn(contact) < 2 * kPi)) return false;
    if (contact.getNumArcs() > 1) return false;  // there may be a minimum for every choice of places
    if (contact.isTouched && !scene.isBetweenPoints(path, in, out)) return false;
    const Vector3 N =
        contact.isTouched ? calcMiddleNormal(scene.getSurface(e), contact).normalized() : contact.clearance.N;
    const bool isShort =
        !contact.isTouched || contact.geodesic.P.t.dot(contact.getLastArc().geodesic.Q.t) > kCosineOfShortArc;
    return isShort && N.dot(calcDefaultSide(scene, e, route.waypoints, route.from_G, route.to_G)) > kCosineOfSameSide;
}

/** A string through a ring whose ends pull it to one side lies on the tube there; on the far side there is another
minimum, and there may be one more where it lies round most of the tube. */
bool liesWhereEndsPull(const PosedProblem& scene, int e, const ObstacleContact& contact, const RoutePlace& route) {
    if (!contact.isTouched) return true;
    if (contact.getNumArcs() > 1 || !(calcTurn(contact) < kPi)) return false;
    const Vector3 axis = scene.getSurface(e).getHole()->getAxis();
    const Pose& X_GS = scene.getPose(e);
    const auto calcAside = [&](const Vector3& v) { return Vector3(v - axis.dot(v) * axis).normalized(); };
    const Vector3 pull = X_GS.shiftBack(route.from_G).normalized() + X_GS.shiftBack(route.to_G).normalized();
    return calcAside(pull).dot(calcAside(contact.geodesic.P.x + contact.getLastArc().geodesic.Q.x)) > kCosineOfNear;
}

}  // namespace

bool isOnDefaultCourse(const PosedProblem& scene, const PathSolution& path, Route& laid) {
    bool isOnCourse = true, isLaid = false;  // laid where it is needed: that costs as much as to continue a path
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        const ObstacleContact& contact = path.contacts[e];
        if (!isOnCourse || contact.isSwitchedOff) return;
        isOnCourse = !contact.yields;
        if (isAloneWithSide(scene, e)) {
            const Pose& X_GS = scene.getPose(e);
            const double asked = calcAskedTurn(scene.problem.getElement(e), X_GS.shiftBack(path.segments[in].A),
                                               X_GS.shiftBack(path.segments[out].B));
            isOnCourse = isOnCourse && turnsAsRoute(scene, path, e, in, out, asked);
            return;
        }
        if (!isLaid) calcAskedRoute(scene, laid);
        isLaid = true;
        int last = e - 1, next = e + 1;
        while (laid.waypoints[last].empty()) --last;
        while (laid.waypoints[next].empty()) ++next;
        const RoutePlace route{laid.waypoints[e], laid.waypoints[last].back(), laid.waypoints[next].front()};
        const int count = laid.threading.counts[e];
        if (count != PassageRule::kAny)
            isOnCourse = isOnCourse && contact.passage.isKnown() && contact.passage.count == count;
        if (!isOnCourse) return;
        if (scene.problem.getElement(e).isEndless)
            isOnCourse = turnsAsRoute(scene, path, e, in, out,
                                      calcRouteTurning(scene.getPose(e), route.from_G, route.waypoints, route.to_G));
        else if (count == PassageRule::kAny || (count == 0 && route.waypoints.empty()))
            isOnCourse = isOnSideOfRoute(scene, path, e, in, out, route);
        else  // more often, or round the ring, in several ways
            isOnCourse = std::abs(count) == 1 && liesWhereEndsPull(scene, e, contact, route);
    });
    return isOnCourse;
}

}  // namespace tautline
