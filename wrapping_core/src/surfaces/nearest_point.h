// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

/** The point of a surface nearest to D, from a point near it: Newton's method on the squared distance. */
SurfacePoint findNearestPoint(const Surface& surface, const Vector3& D, const SurfacePoint& near);

/** The signed distance of a point [m], its gradient, which is the normal at the nearest point, and its Hessian,
W (1 + d W)^-1 with the shape operator W there. Exact but near the medial axis inside, where it is finite. */
ImplicitValue calcSignedDistance(const Surface& surface, const Vector3& p);

}  // namespace tautline
