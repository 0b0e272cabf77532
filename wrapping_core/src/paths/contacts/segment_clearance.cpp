// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/segment_clearance.h"

#include <algorithm>
#include <cmath>

#include "surfaces/closest_approach.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

/** Whether the place of a clearance lies between the segment's ends: Eqn. 6.3 puts D on the infinite line. */
bool isOnSegment(const LineClearance& clearance, double length) {
    return clearance.lineCoordinate >= 0 && clearance.lineCoordinate <= length;
}

/** The clearance of a line of which nothing is known yet: Newton from the segment's lowest point, at s. */
void findFreshClearance(const Surface& surface, const Vector3& A_S, const Vector3& e_S, double length, double s,
                        LineClearance& clearance) {
    constexpr int kApproaches = 4;
    Vector3 D = A_S + s * e_S;
    const bool isOutside = surface.calcHeight(D) > 0;
    clearance.C = surface.findSurfacePoint(D);
    // From foot to foot: the lowest point of a line is far from the nearest one where a surface is thin.
    for (int i = 0; i < kApproaches && isOutside; ++i) {
        D = A_S + std::clamp(e_S.dot(clearance.C.p - A_S), 0.0, length) * e_S;
        clearance.C = surface.findSurfacePoint(D);
    }
    clearance.N = surface.calcFrame(clearance.C, e_S).N;
    surface.findLineClearance(A_S, e_S, clearance);
    if (isOutside != (clearance.distance > 0)) clearance.found = false;  // another side of the surface
    // A segment that is below the surface between its ends is not judged by a place beyond them.
    if (!isOutside && !isOnSegment(clearance, length)) clearance.found = false;
}

/** A line that has sunk so deep that it has no critical point on the kept side any longer, beyond the centres of
curvature, may show one on the far side, clear of it: the height over the tangent plane at the kept place tells, of the
line's point nearest to that place or of its lowest one (for a line along the normal the former is in the plane).
@param lowest    where the line is lowest [m] */
void staySunk(const Surface& surface, const Vector3& A_S, const Vector3& e_S, double length, double lowest,
              LineClearance& clearance) {
    if (!(clearance.distance > 0) || !(clearance.N.dot(clearance.keptN) < 0)) return;
    if (!surface.isInDomain(clearance.C)) return;  // beside the surface
    const auto calcHeightOverPlane = [&](double s) { return clearance.keptN.dot(A_S + s * e_S - clearance.keptC.p); };
    double s = std::clamp(e_S.dot(clearance.keptC.p - A_S), 0.0, length);
    if (calcHeightOverPlane(lowest) < calcHeightOverPlane(s)) s = lowest;
    const double height = calcHeightOverPlane(s);
    if (!(height < 0)) return;
    clearance.C = clearance.keptC, clearance.N = clearance.keptN;
    clearance.distance = height, clearance.scale = 1 / surface.getSize();
    clearance.lineCoordinate = s, clearance.found = true;
}

/** The height of one point of the line as its clearance. */
void takeHeight(const Surface& surface, const Vector3& A_S, const Vector3& e_S, double s, LineClearance& clearance) {
    const Vector3 D = A_S + s * e_S;
    clearance.C = surface.findSurfacePoint(D);
    clearance.distance = surface.calcHeightAndNormal(D, clearance.N);
    clearance.scale = 1 / surface.getSize();
    clearance.lineCoordinate = s;
}

/** Whether the line is in the surface beyond an end, which says nothing of the segment, and the segment dips below it
between its ends. */
bool isSunkElsewhere(const Surface& surface, const Vector3& A_S, const Vector3& e_S, double length,
                     const LineClearance& clearance) {
    if (clearance.distance > 0 || isOnSegment(clearance, length)) return false;
    const double lowest = surface.findLowestPoint(A_S, e_S, length);
    return surface.calcHeight(A_S + lowest * e_S) < 0;
}

}  // namespace

void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vector3& A_G, const Vector3& B_G,
                          LineClearance& clearance) {
    const Vector3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    const Vector3 e_S = length > 0 ? Vector3((B_S - A_S) / length) : Vector3(Vector3::UnitX());
    LineClearance kept = clearance;
    kept.found = false;
    kept.C = clearance.keptC, kept.N = clearance.keptN;
    const bool knowsSide = kept.N.allFinite() && kept.C.p.allFinite();
    if (knowsSide) surface.findLineClearance(A_S, e_S, kept);
    if (!kept.found || isSunkElsewhere(surface, A_S, e_S, length, kept)) {
        const double lowest = surface.findLowestPoint(A_S, e_S, length);
        findFreshClearance(surface, A_S, e_S, length, lowest, kept);
        if (knowsSide) staySunk(surface, A_S, e_S, length, lowest, kept);
        if (!kept.found) takeHeight(surface, A_S, e_S, lowest, kept);
    }
    if (kept.found && !isOnSegment(kept, length))  // past an end, the height of that end is what counts
        takeHeight(surface, A_S, e_S, std::clamp(kept.lineCoordinate, 0.0, length), kept);
    const bool isClear = kept.distance > 0 || !kept.keptN.allFinite();
    if (isClear) kept.keptC = kept.C, kept.keptN = kept.N;
    clearance = kept;
}

void takeNearerClearance(const Surface& surface, const Pose& X_GS, const Vector3& A_G, const Vector3& B_G,
                         LineClearance& clearance) {
    if (!(clearance.distance > 0) || surface.isConvex()) return;
    const Vector3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return;
    const Vector3 e_S = (B_S - A_S) / length;
    ClosestApproach lowest{kNaN, (1 - kSamePlace) * clearance.distance};
    for (const double s : {0.0, length})
        if (const double height = surface.calcHeight(A_S + s * e_S); height < lowest.height) lowest = {s, height};
    if (const auto place = findClosestApproach(surface, A_S, e_S, length, lowest.height)) lowest = *place;
    if (!std::isfinite(lowest.s)) return;
    LineClearance nearer = clearance;
    nearer.found = false;
    findFreshClearance(surface, A_S, e_S, length, lowest.s, nearer);
    if (!nearer.found || !isOnSegment(nearer, length)) takeHeight(surface, A_S, e_S, lowest.s, nearer);
    if (!(nearer.distance < clearance.distance)) return;
    if (nearer.distance > 0) nearer.keptC = nearer.C, nearer.keptN = nearer.N;
    clearance = nearer;
}

}  // namespace tautline
