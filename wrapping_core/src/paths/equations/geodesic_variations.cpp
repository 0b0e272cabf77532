// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/geodesic_variations.h"

#include <cmath>

namespace tautline {

FrameVariations calcStartVariations(const DarbouxFrame& P) {
    FrameVariations d;
    d.x << P.t, P.B, Vector3::Zero(), Vector3::Zero();
    // Eqn. 4.12, 4.13 (with tauG of B = -tauG of t), 4.30, 4.45
    d.N << -P.kappaN * P.t + P.tauG * P.B, P.tauG * P.t - P.kappaB * P.B, Vector3::Zero(), Vector3::Zero();
    d.B << -P.tauG * P.N, P.kappaB * P.N, -P.t, Vector3::Zero();
    return d;
}

FrameVariations calcEndVariations(const DarbouxFrame& Q, const ShotGeodesic& geodesic) {
    const double a = geodesic.a, aDot = geodesic.aDot, r = geodesic.r, rDot = geodesic.rDot;
    const Vector3 dN_t = -Q.kappaN * Q.t + Q.tauG * Q.B, dB_t = -Q.tauG * Q.N;
    const Vector3 dN_B = Q.tauG * Q.t - Q.kappaB * Q.B, dB_B = Q.kappaB * Q.N;
    FrameVariations d;
    d.x << Q.t, a * Q.B, r * Q.B, Q.t;
    d.N << dN_t, a * dN_B, r * dN_B, dN_t;  // Eqn. 4.12, 4.29, 4.44, 4.46
    d.B << dB_t, a * dB_B - aDot * Q.t, r * dB_B - rDot * Q.t, dB_t;
    return d;
}

GeodesicStart calcCorrectedStart(const Surface& surface, const GeodesicStart& start, const DarbouxFrame& P_S,
                                 const Vector4& correction) {
    GeodesicStart corrected;
    corrected.point =
        surface.calcDisplacedPoint(start.point, correction[0] * P_S.t + correction[1] * P_S.B);  // Eqn. 7.22
    corrected.tangent = std::cos(correction[2]) * P_S.t + std::sin(correction[2]) * P_S.B;       // Eqn. 4.62
    corrected.length = start.length + correction[3];                                             // Eqn. 4.67
    return corrected;  // the tangent is made tangent and unit at the new point when it is shot (Eqn. 7.26)
}

}  // namespace tautline
