// SPDX-License-Identifier: Apache-2.0
#include "surfaces/nearest_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tautline {

namespace {

/** A surface point, and the way from it to D in its tangent plane. */
struct Foot {
    SurfacePoint C;
    DarbouxFrame frame;
    Vector3 r;     ///< to D
    Vector2 r_tB;  ///< in components along t and B

    Foot(const Surface& surface, const Vector3& D, const SurfacePoint& at)
        : C(at), frame(surface.calcFrame(at, D - at.p)), r(D - at.p), r_tB(r.dot(frame.t), r.dot(frame.B)) {}
};

}  // namespace

SurfacePoint findNearestPoint(const Surface& surface, const Vector3& D, const SurfacePoint& near) {
    constexpr int kMaxSteps = 20;
    constexpr double kRounding = 1e-15;
    Foot foot(surface, D, near);
    for (int i = 0; i < kMaxSteps && foot.r_tB.norm() > kRounding * surface.getSize(); ++i) {
        // Of half the squared distance over the tangent plane (t, B): slope -r_tB, curvature 1 - h II.
        const DarbouxFrame& frame = foot.frame;
        const double h = foot.r.dot(frame.N);
        Eigen::Matrix2d M;
        M << 1 - h * frame.kappaN, h * frame.tauG, h * frame.tauG, 1 - h * frame.kappaB;
        if (!(M(0, 0) > 0 && M.determinant() > 0)) break;
        const Vector2 step = M.inverse() * foot.r_tB;
        const Foot next(surface, D, surface.calcDisplacedPoint(foot.C, step[0] * frame.t + step[1] * frame.B));
        // Near the end the distance hardly falls, what is left in the tangent plane does.
        if (!(next.r.norm() < foot.r.norm()) && !(next.r_tB.norm() < 0.5 * foot.r_tB.norm())) break;
        foot = next;
    }
    return foot.C;
}

ImplicitValue calcSignedDistance(const Surface& surface, const Vector3& p) {
    constexpr double kDeepest = 0.9;  // of the way to the nearer center of curvature
    const SurfacePoint C = findNearestPoint(surface, p, surface.findSurfacePoint(p));
    const DarbouxFrame frame = surface.calcFrame(C, Vector3(1, 2, 3));
    const double d = frame.N.dot(p - C.p);
    Eigen::Matrix2d W;
    W << -frame.kappaN, frame.tauG, frame.tauG, -frame.kappaB;
    const double mean = 0.5 * W.trace(), apart = std::sqrt(std::max(0.0, mean * mean - W.determinant()));
    const double largest = mean + apart, least = mean - apart;  // principal curvatures
    const double depth = largest > 0 ? std::max(d, -kDeepest / largest) : d;
    const double reach = least < 0 ? std::min(depth, -kDeepest / least) : depth;
    const Eigen::Matrix2d H = W * (Eigen::Matrix2d::Identity() + reach * W).inverse();
    Eigen::Matrix<double, 3, 2> tB;
    tB << frame.t, frame.B;
    return {d, frame.N, tB * H * tB.transpose()};
}

}  // namespace tautline
