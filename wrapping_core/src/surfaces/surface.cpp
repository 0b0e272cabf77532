// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/surface.h"

#include <algorithm>
#include <atomic>

#include "surfaces/arc_walker.h"
#include "surfaces/closest_approach.h"
#include "tautline/error.h"

namespace tautline {

std::uint64_t Surface::makeId() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/** The critical point by Newton's method on two conditions for C alone,

    F1 = e . N = 0,     F2 = (e x N) . (A - C) / size = 0,

which hold exactly where the thesis's three do (Eqn. 7.28: D - C along N and orthogonal to the line) if d is
not 0. Those three have a Jacobian whose determinant is proportional to d, so that C is lost to rounding
where it matters most, at touchdown; these two stay regular there as long as kappa_n is not 0. */
void Surface::findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const {
    constexpr int kMaxIterations = 50;
    const double size = getSize(), tolerance = 1e-9 * size;  // of the step; what is left is its square
    clearance.found = false;
    SurfacePoint C = clearance.C;
    for (int i = 0; i < kMaxIterations; ++i) {
        const DarbouxFrame frame = calcFrame(C, e_S);  // t is e made tangent
        const double et = e_S.dot(frame.t);
        if (!(std::abs(et) > 1e-6)) return;  // the line runs along the normal: no start for Newton
        const Vector3 w = A_S - C.p;
        const Vector3 dN_t = -frame.kappaN * frame.t + frame.tauG * frame.B;
        const Vector3 dN_B = frame.tauG * frame.t - frame.kappaB * frame.B;
        const double F1 = e_S.dot(frame.N), F2 = et * frame.B.dot(w) / size;
        const double J11 = e_S.dot(dN_t), J12 = e_S.dot(dN_B);
        const double J21 = e_S.cross(dN_t).dot(w) / size, J22 = (e_S.cross(dN_B).dot(w) - et) / size;
        const double determinant = J11 * J22 - J12 * J21;
        Vector2 step((J12 * F2 - J22 * F1) / determinant, (J21 * F1 - J11 * F2) / determinant);
        if (!step.allFinite()) return;
        step *= size / std::max(size, step.norm());  // no farther in one step than the surface's size
        C = calcDisplacedPoint(C, step[0] * frame.t + step[1] * frame.B);
        if (step.norm() > tolerance) continue;
        const DarbouxFrame end = calcFrame(C, e_S);
        if (!(end.N.dot(clearance.N) > 0)) return;     // slid to another critical point
        if (!isInDomain(C)) return;                    // where the surface only goes on for the search
        const double distance = end.N.dot(A_S - C.p);  // e . N = 0: the same from any point of the line
        const double s0 = e_S.dot(C.p - A_S);
        clearance.C = C, clearance.N = end.N, clearance.lineCoordinate = s0, clearance.distance = distance;
        clearance.scale = std::max(std::abs(end.kappaN), 1 / size), clearance.found = true;
        return;
    }
}

double Surface::findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const {
    const double atA = calcHeight(A_S), atB = calcHeight(A_S + length * e_S);
    if (const auto place = findClosestApproach(*this, A_S, e_S, length, std::min(atA, atB))) return place->s;
    return atA <= atB ? 0 : length;
}

void sampleGeodesic(const Surface& surface, const GeodesicStart& start, const ShootingOptions& options, int count,
                    std::vector<Vector3>& points_S) {
    require(count >= 2, "sampleGeodesic: needs at least 2 points, got ", count);
    points_S.resize(count);
    ArcWalker walker(surface, start, options, count - 1);
    for (int i = 1; i < count; ++i) {
        const ShotGeodesic& piece = walker.next();
        if (i == 1) points_S[0] = piece.P.x;
        points_S[i] = piece.Q.x;
    }
}

}  // namespace tautline
