// SPDX-License-Identifier: Apache-2.0
#include "paths/arc_course.h"

#include <algorithm>
#include <cmath>

#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

/** The frame in the middle of an arc, shot to no more accuracy than a side needs. */
DarbouxFrame shootToMiddle(const Surface& surface, const ObstacleContact& contact) {
    GeodesicStart half = contact.start;
    half.length *= 0.5;
    Geodesic geodesic;
    surface.shootGeodesic(half, kRoughlyAlong, geodesic);
    return geodesic.Q;
}

}  // namespace

double calcShortTurning(const Vec3& from_S, const Vec3& to_S) {
    return std::atan2(from_S.x() * to_S.y() - from_S.y() * to_S.x(), from_S.head<2>().dot(to_S.head<2>()));
}

double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S) {
    constexpr double kMostPieces = 2000, kQuarterTurn = 0.5 * kPi;
    double turning = 0;
    Vec3 last = A_S;
    const auto goTo = [&](const Vec3& p) {
        turning += calcShortTurning(last, p);
        last = p;
    };
    if (contact.isTouched) {
        const Geodesic& arc = contact.geodesic;
        const double curvature = std::max({std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN), 1 / surface.getSize()});
        const double turn = std::abs(contact.start.length) * curvature;
        const int pieces = static_cast<int>(std::min(kMostPieces, 2 + 2 * turn));
        goTo(arc.P.x);
        if (turn < kQuarterTurn) {
            goTo(arc.Q.x);
        } else {
            ArcWalker walker(surface, contact.start, kRoughlyAlong, pieces);
            for (int i = 0; i < pieces; ++i) goTo(walker.next().Q.x);
        }
    }
    goTo(B_S);
    return turning;
}

double calcTurn(const ObstacleContact& contact) {
    const Geodesic& arc = contact.geodesic;
    return contact.start.length * std::max(std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN));
}

Vec3 calcMiddleNormal(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kFullTurn = 6;  // [rad], less than 2 pi since curvatures vary
    const Geodesic& arc = contact.geodesic;
    if (calcTurn(contact) > kFullTurn) return shootToMiddle(surface, contact).N;
    return arc.P.t.dot(arc.Q.t) > 0 ? Vec3(arc.P.N + arc.Q.N) : Vec3(arc.P.t - arc.Q.t);
}

double calcMiddleAlong(const Surface& surface, const ObstacleContact& contact, const Vec3& direction_S) {
    constexpr double kHalfTurn = 2.5;     // [rad], less than pi since curvatures vary
    constexpr double kNearTheEdge = 0.3;  // in sizes
    const Geodesic& arc = contact.geodesic;
    const double ofChord = 0.5 * direction_S.dot(arc.P.x + arc.Q.x);
    if (calcTurn(contact) <= kHalfTurn && std::abs(ofChord) >= kNearTheEdge * surface.getSize()) return ofChord;
    return direction_S.dot(shootToMiddle(surface, contact).x);
}

}  // namespace tautline
