// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The four natural variations of a geodesic (thesis Sec. 4.3): of its start point along t and B, of its direction, of
its length: xi = (s_P [m], beta_P [m], theta [rad], l [m]). */
#include "tautline/surfaces/surface.h"

namespace tautline {

inline constexpr int kVariations = 4;  ///< thesis Eqn. 4.8

/** Derivatives of a trihedron {x, t, N, B} under the four natural variations, one column per variation. */
struct FrameVariations {
    Eigen::Matrix<double, 3, kVariations> x, N, B;
};
FrameVariations calcStartVariations(const DarbouxFrame& P);
FrameVariations calcEndVariations(const DarbouxFrame& Q, const ShotGeodesic& geodesic);

/** The start corrected by finite natural corrections (thesis Sec. 4.5, 7.5). */
GeodesicStart calcCorrectedStart(const Surface& surface, const GeodesicStart& start, const DarbouxFrame& P_S,
                                 const Vector4& correction);

}  // namespace tautline
