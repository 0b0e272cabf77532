// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "tautline/types.h"

namespace tautline::models {

/** The shortest way from A to B, in the frame of an ellipsoid, over the ellipse in which a plane cuts it: the plane
through A, B and the point of the surface nearest to the middle of the line's chord. OpenSim's wraps over ellipsoids lie
in such planes. Nothing if the line misses the ellipsoid, or has no direction. */
std::optional<double> calcSectionLength(const Vector3& semiAxes, const Vector3& A, const Vector3& B);

}  // namespace tautline::models
