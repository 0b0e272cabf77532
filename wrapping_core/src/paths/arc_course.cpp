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

double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vec3& A_S, const Vec3& B_S) {
    constexpr double kMostPieces = 2000, kQuarterTurn = 0.5 * kPi;
    double turning = 0;
    Vec3 last = A_S;
    const auto goTo = [&](const Vec3& p) {
        turning += std::atan2(last.x() * p.y() - last.y() * p.x(), last.head<2>().dot(p.head<2>()));
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

Vec3 calcMiddlePoint(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kHalfTurn = 2.5;  // [rad], less than pi since curvatures vary
    const Geodesic& arc = contact.geodesic;
    if (calcTurn(contact) > kHalfTurn) return shootToMiddle(surface, contact).x;
    return 0.5 * (arc.P.x + arc.Q.x);
}

Vec3 findMiddlePoint(const Surface& surface, const ObstacleContact& contact) {
    return shootToMiddle(surface, contact).x;
}

}  // namespace tautline
