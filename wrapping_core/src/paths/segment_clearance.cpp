#include "tautline/paths/segment_clearance.h"

#include <algorithm>

namespace tautline {
namespace {

/** The clearance of a line of which nothing is known yet: Newton from the segment's lowest point. */
void findFreshClearance(const Surface& surface, const Vec3& A_S, const Vec3& e_S, double length,
                        LineClearance& clearance) {
    constexpr int kApproaches = 4;
    Vec3 D = A_S + surface.findLowestPoint(A_S, e_S, length) * e_S, N;
    const bool isOutside = surface.calcHeight(D, N) > 0;
    clearance.C = surface.findSurfacePoint(D);
    // From foot to foot: the lowest point of a line is far from the nearest one where a surface is thin.
    for (int i = 0; i < kApproaches && isOutside; ++i) {
        D = A_S + std::clamp(e_S.dot(clearance.C.p - A_S), 0.0, length) * e_S;
        clearance.C = surface.findSurfacePoint(D);
    }
    clearance.N = surface.calcFrame(clearance.C, e_S).N;
    surface.findLineClearance(A_S, e_S, clearance);
    if (isOutside && !(clearance.distance > 0)) clearance.found = false;  // the far side of the surface
}

/** The height of one point of the line as its clearance. */
void takeHeight(const Surface& surface, const Vec3& A_S, const Vec3& e_S, double s, LineClearance& clearance) {
    const Vec3 D = A_S + s * e_S;
    clearance.C = surface.findSurfacePoint(D);
    clearance.distance = surface.calcHeight(D, clearance.N);
    clearance.scale = 1 / surface.getSize();
    clearance.lineCoordinate = s;
}

}  // namespace

void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                          LineClearance& clearance) {
    const Vec3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    const Vec3 e_S = length > 0 ? Vec3((B_S - A_S) / length) : Vec3(Vec3::UnitX());
    LineClearance kept = clearance;
    kept.found = false;
    kept.C = clearance.keptC, kept.N = clearance.keptN;
    if (kept.N.allFinite() && kept.C.p.allFinite()) surface.findLineClearance(A_S, e_S, kept);
    if (!kept.found) findFreshClearance(surface, A_S, e_S, length, kept);
    // Eqn. 6.3 puts D on the infinite line: past an end, the height of that end is what counts.
    if (!kept.found)
        takeHeight(surface, A_S, e_S, surface.findLowestPoint(A_S, e_S, length), kept);
    else if (!(kept.lineCoordinate >= 0 && kept.lineCoordinate <= length))
        takeHeight(surface, A_S, e_S, kept.lineCoordinate < 0 ? 0 : length, kept);
    const bool isClear = kept.distance > 0 || !kept.keptN.allFinite();
    if (isClear) kept.keptC = kept.C, kept.keptN = kept.N;
    clearance = kept;
}

void takeNearerClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                         LineClearance& clearance) {
    if (!(clearance.distance > 0) || surface.isConvex()) return;
    const Vec3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return;
    const Vec3 e_S = (B_S - A_S) / length;
    // A few heights along the segment tell whether there is one.
    constexpr int kSamples = 16;
    bool isNearer = false;
    Vec3 N;
    for (int i = 0; i <= kSamples && !isNearer; ++i)
        isNearer = surface.calcHeight(A_S + (length * i / kSamples) * e_S, N) < (1 - 1e-9) * clearance.distance;
    if (!isNearer) return;
    LineClearance nearer = clearance;
    nearer.found = false;
    findFreshClearance(surface, A_S, e_S, length, nearer);
    const bool isOnSegment = nearer.lineCoordinate >= 0 && nearer.lineCoordinate <= length;
    if (!nearer.found || !isOnSegment || !(nearer.distance < clearance.distance)) return;
    if (nearer.distance > 0) nearer.keptC = nearer.C, nearer.keptN = nearer.N;
    clearance = nearer;
}

}  // namespace tautline
