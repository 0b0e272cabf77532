// SPDX-License-Identifier: Apache-2.0
#include "paths/contacts/touching_arcs.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kMostHalf = 2;  ///< half of a new arc where the surface hardly curves, in sizes

/** From the top of a circle to where the line from a point touches it, as an angle at its center: positive towards the
point. The chord's half angle where the point lies in the circle.
@param along, above   of the point, from the top [m]
@param depth          of the line to be bent, below the top [m] */
double calcTangentAngle(double radius, double along, double above, double depth) {
    const double distance = std::hypot(along, radius + above);
    if (!(distance > radius)) return std::sqrt(2 * std::max(0.0, depth) / radius);
    return std::atan2(along, radius + above) - std::acos(radius / distance);
}

/** The start of an arc for Newton's method: that of the string from A to B, both in S, over the osculating circle at
the place where the clearance was measured. Of length zero where the line just touches. */
GeodesicStart calcTouchingArc(const Surface& surface, const Vector3& A_S, const Vector3& B_S,
                              const LineClearance& clearance) {
    const DarbouxFrame frame = surface.calcFrame(clearance.C, B_S - A_S);
    const double radius = 1 / std::max(std::abs(frame.kappaN), 1e-3 * clearance.scale);
    const double most = std::min(radius, kMostHalf * surface.getSize());
    const auto calcHalf = [&](const Vector3& end_S, double sign) {
        const Vector3 from = end_S - clearance.C.p;
        const double angle = calcTangentAngle(radius, sign * frame.t.dot(from), frame.N.dot(from), -clearance.distance);
        return std::clamp(radius * angle, 0.0, most);
    };
    const double before = calcHalf(A_S, -1), after = calcHalf(B_S, 1);
    GeodesicStart arc;
    arc.point = surface.calcDisplacedPoint(clearance.C, -before * frame.t);
    arc.tangent = surface.calcFrame(arc.point, frame.t).t;
    arc.length = before + after;
    return arc;
}

/** The section of a surface by the plane through a segment and a direction N out of it, over where the segment is below
the surface: points of it in order, and first and last the segment's ends. */
std::vector<Vector3> calcSection(const Surface& surface, const Vector3& A_S, const Vector3& B_S, const Vector3& N_S) {
    constexpr int kSamples = 96, kMaxMarches = 100;
    const double atSurface = 1e-6 * surface.getSize();
    std::vector<Vector3> section{A_S};
    for (int i = 1; i < kSamples; ++i) {
        Vector3 p = A_S + i * (B_S - A_S) / kSamples;
        double height = surface.calcHeight(p);
        if (height > 0) continue;
        // Outwards by the depth, which is no more than the way to the surface.
        for (int k = 0; k < kMaxMarches && height < -atSurface; ++k) {
            p -= height * N_S;
            height = surface.calcHeight(p);
        }
        if (height >= -atSurface) section.push_back(p);
    }
    section.push_back(B_S);
    return section;
}

/** Indices of the hull of a plane polyline on the side of N, first and last included. */
std::vector<int> findHull(const std::vector<Vector3>& points, const Vector3& along, const Vector3& N_S) {
    std::vector<int> hull;
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
        const auto isBelow = [&] {
            const Vector3& a = points[hull[hull.size() - 2]];
            const Vector3 toLast = points[hull.back()] - a, toNext = points[k] - a;
            return along.dot(toLast) * N_S.dot(toNext) >= N_S.dot(toLast) * along.dot(toNext);
        };
        while (hull.size() >= 2 && isBelow()) hull.pop_back();
        hull.push_back(k);
    }
    return hull;
}

/** An arc over each run of neighbors that are on the hull of the section. */
std::vector<GeodesicStart> calcArcsOfHull(const Surface& surface, const Vector3& A_S, const Vector3& B_S,
                                          const Vector3& N_S) {
    const Vector3 along = (B_S - A_S).normalized();
    const std::vector<Vector3> section = calcSection(surface, A_S, B_S, N_S);
    const std::vector<int> hull = findHull(section, along, N_S);
    std::vector<GeodesicStart> arcs;
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
        const Vector3& p = section[hull[i]];
        if (i > 1 && hull[i] == hull[i - 1] + 1) {
            arcs.back().length += (p - section[hull[i - 1]]).norm();
            continue;
        }
        GeodesicStart arc;
        arc.point = surface.findSurfacePoint(p);
        arc.tangent = surface.calcFrame(arc.point, section[hull[i] + 1] - section[hull[i] - 1]).t;
        arcs.push_back(arc);
    }
    return arcs;
}

}  // namespace

GeodesicStart calcTouchingArcs(const Surface& surface, const Vector3& A_S, const Vector3& B_S,
                               const LineClearance& clearance, std::vector<GeodesicStart>& further) {
    further.clear();
    if (surface.isConvex() || !(surface.calcFrame(clearance.C, B_S - A_S).kappaN > 0))
        return calcTouchingArc(surface, A_S, B_S, clearance);
    const std::vector<GeodesicStart> arcs = calcArcsOfHull(surface, A_S, B_S, clearance.N);
    if (arcs.empty()) return calcTouchingArc(surface, A_S, B_S, clearance);
    further.assign(arcs.begin() + 1, arcs.end());
    return arcs.front();
}

}  // namespace tautline
