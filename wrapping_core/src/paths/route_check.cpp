// SPDX-License-Identifier: Apache-2.0
#include "paths/route_check.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

using Kind = RouteDeviation::Kind;

constexpr double kOnTheEdge = 1e-9;  ///< of a unit vector or a size, by which a side may be missed in rounding

/** By how much a path turns about the z axis of S between the far ends of the segments beside its arc, positive from x
to y [rad]: pieces of the arc turn by so little that the way round is plain. */
double calcTurning(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact, const StraightSegment& in,
                   const StraightSegment& out) {
    constexpr double kMostPieces = 2000;
    double turning = 0;
    Vec3 last = X_GS.shiftBack(in.A);
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
    goTo(X_GS.shiftBack(out.B));
    return turning;
}

/** A place on a surface and the normal there, both in S. */
struct Place {
    Vec3 p, N;
};

/** The middle of an arc. Of one that turns by less than half a circle the middle of its ends tells the side. */
Place findMiddle(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kHalfCircle = 2.5;  // [rad], less than pi since curvatures vary
    const Geodesic& arc = contact.geodesic;
    const double curvature = std::max(std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN));
    if (contact.start.length * curvature < kHalfCircle) return {0.5 * (arc.P.x + arc.Q.x), arc.P.N + arc.Q.N};
    GeodesicStart half = contact.start;
    half.length *= 0.5;
    Geodesic geodesic;
    surface.shootGeodesic(half, kRoughlyAlong, geodesic);
    return {geodesic.Q.x, geodesic.Q.N};
}

/** Of bodies without end the side is that of their axis; of others, of the origin of S (PassOnSide) or of the surface
itself (PassNear), as that of the tube of a ring. */
bool isOnSide(const PathElement& element, const ObstacleContact& contact) {
    const Place place =
        contact.isTouched ? findMiddle(*element.surface, contact) : Place{contact.clearance.C.p, contact.clearance.N};
    if (std::holds_alternative<PassNear>(element.hint) && !element.isEndless)
        return !(element.side_S.dot(place.N) < -kOnTheEdge);
    return !(element.side_S.dot(place.p) < -kOnTheEdge * element.surface->getSize());
}

/** The angle nearest to the hint's is off by half a turn at most; by a little more where the path's neighbors may stand
elsewhere than those that the hint was laid between. */
bool turnsAsOften(const WindAround& hint, double turning, bool isBetweenPoints) {
    constexpr double kRounding = 1e-6, kElsewhere = 0.2;
    return std::abs(turning / (2 * kPi) - hint.turns) < 0.5 * (1 + (isBetweenPoints ? kRounding : kElsewhere));
}

}  // namespace

RouteDeviation findSideDeviation(const PosedProblem& scene, const PathSolution& path) {
    RouteDeviation deviation;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        const PathElement& element = scene.problem.getElement(e);
        const ObstacleContact& contact = path.contacts[e];
        if (deviation.kind != Kind::None || contact.isSwitchedOff) return;
        if (const auto* winding = std::get_if<WindAround>(&element.hint)) {
            const double turning =
                calcTurning(*element.surface, scene.getPose(e), contact, path.segments[in], path.segments[out]);
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

}  // namespace tautline
