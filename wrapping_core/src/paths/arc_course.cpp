// SPDX-License-Identifier: Apache-2.0
#include "paths/arc_course.h"

#include <algorithm>
#include <cmath>

#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

/** Normal and place in the middle of the arcs, shot to no more accuracy than a side needs. */
struct Middle {
    Vector3 N, x;  ///< in S
};

Middle findMiddle(const Surface& surface, const ObstacleContact& contact) {
    const int n = contact.getNumArcs();
    if (n % 2 == 0) {
        const DarbouxFrame &Q = contact.getArc(n / 2 - 1).geodesic.Q, &P = contact.getArc(n / 2).geodesic.P;
        return {Q.N + P.N, 0.5 * (Q.x + P.x)};
    }
    GeodesicStart half = contact.getArc(n / 2).start;
    half.length *= 0.5;
    ShotGeodesic geodesic;
    surface.shootGeodesic(half, kRoughlyAlong, geodesic);
    return {geodesic.Q.N, geodesic.Q.x};
}

}  // namespace

double calcShortTurning(const Vector3& from_S, const Vector3& to_S) {
    return std::atan2(from_S.x() * to_S.y() - from_S.y() * to_S.x(), from_S.head<2>().dot(to_S.head<2>()));
}

double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vector3& A_S, const Vector3& B_S) {
    constexpr double kMostPieces = 2000, kQuarterTurn = 0.5 * kPi;
    double turning = 0;
    Vector3 last = A_S;
    const auto goTo = [&](const Vector3& p) {
        turning += calcShortTurning(last, p);
        last = p;
    };
    for (int i = 0; i < contact.getNumArcs(); ++i) {
        const GeodesicStart& start = contact.getArc(i).start;
        const ShotGeodesic& arc = contact.getArc(i).geodesic;
        const double curvature = std::max({std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN), 1 / surface.getSize()});
        const double turn = std::abs(start.length) * curvature;
        const int pieces = static_cast<int>(std::min(kMostPieces, 2 + 2 * turn));
        goTo(arc.P.x);
        if (turn < kQuarterTurn) {
            goTo(arc.Q.x);
        } else {
            ArcWalker walker(surface, start, kRoughlyAlong, pieces);
            for (int k = 0; k < pieces; ++k) goTo(walker.next().Q.x);
        }
    }
    goTo(B_S);
    return turning;
}

double calcTurn(const ObstacleContact& contact) {
    double turn = 0;
    for (int i = 0; i < contact.getNumArcs(); ++i) {
        const ShotGeodesic& arc = contact.getArc(i).geodesic;
        turn += contact.getArc(i).start.length * std::max(std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN));
    }
    return turn;
}

Vector3 calcMiddleNormal(const Surface& surface, const ObstacleContact& contact) {
    constexpr double kFullTurn = 6;  // [rad], less than 2 pi since curvatures vary
    const DarbouxFrame &P = contact.geodesic.P, &Q = contact.getLastArc().geodesic.Q;
    if (calcTurn(contact) > kFullTurn) return findMiddle(surface, contact).N;
    return P.t.dot(Q.t) > 0 ? Vector3(P.N + Q.N) : Vector3(P.t - Q.t);
}

double calcMiddleAlong(const Surface& surface, const ObstacleContact& contact, const Vector3& direction_S) {
    constexpr double kHalfTurn = 2.5;     // [rad], less than pi since curvatures vary
    constexpr double kNearTheEdge = 0.3;  // in sizes
    const double ofChord = 0.5 * direction_S.dot(contact.geodesic.P.x + contact.getLastArc().geodesic.Q.x);
    if (calcTurn(contact) <= kHalfTurn && std::abs(ofChord) >= kNearTheEdge * surface.getSize()) return ofChord;
    return direction_S.dot(findMiddle(surface, contact).x);
}

}  // namespace tautline
