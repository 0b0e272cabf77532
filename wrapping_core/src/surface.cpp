#include "tautline/surface.h"

#include <Eigen/LU>
#include <algorithm>

#include "tautline/error.h"

namespace tautline {

/** Thesis Sec. 7.6: unknowns w = (s_0, s_1, s_2), the places of D on the line and of C on two orthogonal
geodesics; here the basis e_1 = t, e_2 = B of a Darboux frame at C with t nearest the line. */
void Surface::findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const {
    constexpr int kMaxIterations = 50;
    const double size = getSize(), tolerance = 1e-12 * (size + (clearance.C.p - A_S).norm());
    clearance.found = false;
    SurfacePoint C = clearance.C;
    double s0 = (C.p - A_S).dot(e_S);
    for (int i = 0; i < kMaxIterations; ++i) {
        const DarbouxFrame frame = calcFrame(C, std::abs(e_S.dot(clearance.N)) < 0.99 ? e_S : e_S.unitOrthogonal());
        const Vec3 dr = A_S + s0 * e_S - C.p;
        const double d = frame.N.dot(dr), e1 = e_S.dot(frame.t), e2 = e_S.dot(frame.B);
        const Vec3 g(e_S.dot(dr), frame.t.dot(dr), frame.B.dot(dr));  // Eqn. 7.28
        // Eqn. 7.33; B = t x N turns the sign of the mixed term against the printed e_2 = N x e_1.
        Mat3 J;
        J << 1, -e1, -e2,                                              //
            e1, frame.kappaN * d - 1, -frame.tauG * d,                 //
            e2, -frame.tauG * d, frame.kappaB * d - 1;
        const Vec3 step = -J.fullPivLu().solve(g);
        if (!step.allFinite()) return;
        const double limit = size / std::max(size, step.tail<2>().norm());  // no farther on the surface than its size
        s0 += limit * step[0];
        C = calcDisplacedPoint(C, limit * (step[1] * frame.t + step[2] * frame.B));
        if (step.norm() > tolerance) continue;  // quadratic: what is left is its square, rounding
        const DarbouxFrame end = calcFrame(C, e_S);
        const Vec3 r = A_S + s0 * e_S - C.p;
        if (!(end.N.dot(clearance.N) > 0)) return;  // slid to another critical point
        clearance = {C, end.N, s0, r.dot(end.N), std::max(std::abs(end.kappaN), 1 / size), true};
        return;
    }
}

double Surface::findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const {
    constexpr int kLeastSamples = 16, kMostSamples = 400, kRefinements = 30;
    const int count = std::clamp(static_cast<int>(4 * length / getSize()), kLeastSamples, kMostSamples);
    Vec3 N;
    const auto height = [&](double s) { return calcHeight(A_S + s * e_S, N); };
    const double spacing = length / count;
    double lowest = 0, least = height(0);
    for (int i = 1; i <= count; ++i) {
        const double h = height(i * spacing);
        if (h < least) least = h, lowest = i * spacing;
    }
    // Ternary search between the neighbours: the height is convex there for all but contrived surfaces.
    double a = std::max(0.0, lowest - spacing), b = std::min(length, lowest + spacing);
    for (int i = 0; i < kRefinements; ++i) {
        const double left = a + (b - a) / 3, right = b - (b - a) / 3;
        (height(left) < height(right) ? b : a) = height(left) < height(right) ? right : left;
    }
    return 0.5 * (a + b);
}

void sampleGeodesic(const Surface& surface, const GeodesicStart& start, const GeodesicOptions& options, int count,
                    std::vector<Vec3>& points_S) {
    require(count >= 2, "sampleGeodesic: needs at least 2 points, got ", count);
    points_S.resize(count);
    GeodesicStart from = start;
    from.length = start.length / (count - 1);
    points_S[0] = surface.findSurfacePoint(start.point.p).p;
    Geodesic piece;
    for (int i = 1; i < count; ++i) {
        surface.shootGeodesic(from, options, piece);
        points_S[i] = piece.Q.x;
        from.point = piece.endPoint;
        from.tangent = piece.Q.t;
    }
}

}  // namespace tautline
