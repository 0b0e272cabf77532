// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "tautline/types.h"

namespace tautline {

/** Darboux trihedron {t, N, B} of a unit-speed geodesic at a surface point (thesis Sec. 3.4), with the
second fundamental form in the basis {t, B}. N points outward and B = t x N. Signs (thesis-wide):

    t' = kappaN N,   N' = -kappaN t + tauG B,   B' = -tauG N      along the geodesic,

so that kappaN < 0 where a string presses on a convex surface. All vectors in one frame, which the
owner names (S in surfaces and geodesics, G in path segments). Curvatures in 1/m. */
struct DarbouxFrame {
    Vector3 x = Vector3::Constant(kNaN);  ///< the point
    Vector3 t = Vector3::Constant(kNaN);  ///< unit tangent
    Vector3 N = Vector3::Constant(kNaN);  ///< unit outward normal
    Vector3 B = Vector3::Constant(kNaN);  ///< unit binormal t x N
    double kappaN = kNaN;                 ///< normal curvature along t: -t . dN(t)
    double tauG = kNaN;                   ///< geodesic torsion along t: B . dN(t)
    double kappaB = kNaN;                 ///< normal curvature along B: -B . dN(B)

    /** Gaussian curvature [1/m^2] (determinant of the second fundamental form). */
    double calcGaussianCurvature() const { return kappaN * kappaB - tauG * tauG; }

    /** The same frame seen from the frame in which its own basis has pose X. */
    DarbouxFrame reexpressedBy(const Pose& X) const {
        return {X * x, X.rotate(t), X.rotate(N), X.rotate(B), kappaN, tauG, kappaB};
    }
};

/** The unit tangent nearest a direction; any tangent for a direction along the normal. */
inline Vector3 makeTangent(const Vector3& direction, const Vector3& N) {
    const Vector3 tangent = direction - direction.dot(N) * N;
    const double square = tangent.squaredNorm();
    if (square <= 1e-24 * direction.squaredNorm()) return N.unitOrthogonal();
    return tangent / std::sqrt(square);  // NaN stays NaN
}

}  // namespace tautline
