// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What every Surface must obey, checked by differences and by independent routes, and whether two surfaces are the
same one: put your own through it. */
#include <string>
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** Where the laws are checked: near a point, along a direction, over a geodesic's length. */
struct SurfaceLawSample {
    Vector3 p_S = Vector3::Constant(kNaN);          ///< brought to the surface first
    Vector3 direction_S = Vector3::Constant(kNaN);  ///< not along the normal there
    double length = 1;                              ///< of the geodesic [m], positive
};

/** Tolerances, relative to the surface's size, to unit vectors, and to the largest of 1/size and the curvatures. */
struct SurfaceLawOptions {
    ShootingOptions geodesics;          ///< how geodesics are shot for the laws
    double exactTolerance = 1e-9;       ///< of what holds but for rounding and the integrator's accuracy
    double differenceTolerance = 1e-5;  ///< of what is compared with central differences
    double differenceStep = 3e-4;       ///< of those, over the local radius of curvature or the size if less
};

/** Checks the numbered laws at each sample:

1.  calcFrame is orthonormal, right-handed, at the point, its t along the direction given.
2.  findSurfacePoint is idempotent, and leaves no height; beside the domain none that is negative.
3.  calcHeightAndNormal in the domain: N_S of unit length, on the surface that of the frame; positive outside, negative
    inside; its slope along N is 1 on the surface.
4.  calcDisplacedPoint stays on the surface and is first-order correct: what it misses is a square.
5.  Curvatures are the derivatives of the normal: along t, dN = -kappaN t + tauG B; along B, dN = tauG t - kappaB B.
6.  shootGeodesic: converged; begins in the start's frame; its end is on the surface, with the frame there.
7.  Reversed: shot back from the end, or over the negative length, it returns to its start.
8.  Additive: two halves make the whole, Jacobi fields included.
9.  Jacobi fields have the Wronskian a r' - a' r = 1.
10. Jacobi fields are the differences of neighboring geodesics.
11. Zero length: end = start, a = 1, r = 0.
12. Any point in space has a finite height and a finite surface point.
13. Of an implicit form, gradient and Hessian are differences of f and of the gradient, the Hessian symmetric; of a
    parametric form, first and second derivatives are differences of x and of the first. The sentence names the entry:
    df/dy, d2f/dxdz, dx/du, d2x/dudv.

@return a sentence for each law broken, with sample, value and limit; empty: all hold */
std::vector<std::string> checkSurfaceLaws(const Surface& surface, const std::vector<SurfaceLawSample>& samples,
                                          const SurfaceLawOptions& options = {});

/** Checks that two surfaces are the same one, in two forms: implicit and parametric, yours and one of the library's, or
before and after a change. At each sample:

14. Points of each lie on the other.
15. Heights near the surface have one sign, and the same slope across it.
16. Outward normals are equal.
17. Curvatures kappaN, tauG and kappaB along the sample's direction are equal.
18. Geodesics from the same start end alike: place, frame, curvatures.
19. Their Jacobi fields are equal, and both or neither have a conjugate point.

Each may break its own laws and still agree: put one of them through checkSurfaceLaws() as well. Of a sample that breaks
14 to 16 no more is said: the later laws follow. Lengths are relative to the size of `first`; the sizes may differ.

@return a sentence for each law broken, with sample, value and limit; empty: all hold */
std::vector<std::string> checkSameSurface(const Surface& first, const Surface& second,
                                          const std::vector<SurfaceLawSample>& samples,
                                          const SurfaceLawOptions& options = {});

}  // namespace tautline
