// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/geodesics/darboux_frame.h"

namespace tautline {

/** A point on a surface. Implicit surfaces use p_S alone; parametric ones keep their coordinates (u, v)
too, so that charts with seams and several turns stay continuous. */
struct SurfacePoint {
    Vector3 p = Vector3::Constant(kNaN);  ///< position in the surface frame S [m]
    Vector2 uv = Vector2::Zero();         ///< surface coordinates of parametric surfaces
    int chart = 0;                        ///< which of its charts (u, v) belong to, where a surface has several
};

/** What defines a geodesic (thesis Sec. 3.3.3): start point, unit start direction, arc length, in S. */
struct GeodesicStart {
    SurfacePoint point;
    Vector3 tangent = Vector3::Constant(kNaN);
    double length = 0;  ///< arc length [m]; negative: shot backwards
};

/** A shot geodesic: its two end trihedra in S and the two scalar Jacobi fields at Q, which solve
y'' + K y = 0 (thesis Eqn. 4.19, 4.35) from a(0) = 1, a'(0) = 0 and r(0) = 0, r'(0) = 1. */
struct ShotGeodesic {
    DarbouxFrame P, Q;  ///< in S
    SurfacePoint endPoint;
    double length = 0;
    double a = 1, aDot = 0;          ///< dbeta_Q/dbeta_P and its arc derivative
    double r = 0, rDot = 1;          ///< dbeta_Q/dtheta [m] and its arc derivative
    int steps = 0;                   ///< accepted integration steps; 0 for closed forms, -1 if it gave up
    bool converged = true;           ///< false: the integrator gave up, Q is where it stopped
    bool hasConjugatePoint = false;  ///< r has a zero inside: not a shortest curve (where: geodesic_events.h)
    double maxKappaN = -kInfinity;   ///< largest kappaN met at the integrator's steps
};

/** Accuracy of shooting: local error per step, relative to the surface's size and to unit vectors. */
struct ShootingOptions {
    double accuracy = 1e-12;
    int maxSteps = 2000;
};

}  // namespace tautline
