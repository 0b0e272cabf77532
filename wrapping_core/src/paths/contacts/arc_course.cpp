// SPDX-License-Identifier: Apache-2.0
#include "paths/contacts/arc_course.h"

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

namespace {

constexpr double kQuarterTurn = 0.5 * kPi;

/** By how much an arc turns if it curves nowhere more than at its ends or than a sphere of the surface's size [rad]. */
double calcLargestTurn(const Surface& surface, const ContactArc& arc) {
    const double atEnds = std::max(std::abs(arc.geodesic.P.kappaN), std::abs(arc.geodesic.Q.kappaN));
    return std::abs(arc.start.length) * std::max(atEnds, 1 / surface.getSize());
}

/** By how much an arc turns about the z axis of S, walked in pieces of less than a quarter turn each; in more of them
where one turns farther than was expected.
@param expected   of the whole arc [rad] */
double calcTurningAlong(const Surface& surface, const ContactArc& arc, double expected) {
    constexpr int kMostPieces = 2000;
    constexpr double kPiece = 1.3;  // [rad]
    int pieces = static_cast<int>(std::min<double>(kMostPieces, std::ceil(expected / kPiece)));
    for (;; pieces *= 4) {
        ArcWalker walker(surface, arc.start, kRoughlyAlong, pieces);
        double turning = 0;
        bool isShort = true;
        for (int k = 0; k < pieces && isShort; ++k) {
            const ShotGeodesic& piece = walker.next();
            turning += calcShortTurning(piece.P.x, piece.Q.x);
            isShort = piece.P.t.dot(piece.Q.t) > 0;
        }
        if (isShort || pieces >= kMostPieces) return turning;
    }
}

}  // namespace

double calcTurning(const Surface& surface, const ObstacleContact& contact, const Vector3& A_S, const Vector3& B_S) {
    double turning = 0;
    Vector3 last = A_S;
    const auto goTo = [&](const Vector3& p) {
        turning += calcShortTurning(last, p);
        last = p;
    };
    for (int i = 0; i < contact.getNumArcs(); ++i) {
        const ContactArc& arc = contact.getArc(i);
        goTo(arc.geodesic.P.x);
        const double expected = calcLargestTurn(surface, arc);
        if (expected < kQuarterTurn)
            goTo(arc.geodesic.Q.x);
        else
            turning += calcTurningAlong(surface, arc, expected);
        last = arc.geodesic.Q.x;
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
