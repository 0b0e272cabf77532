// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Private: the uniform cubic B-splines behind patches and solids. */
#include "tautline/types.h"

namespace tautline {

/** Row k: k-th derivatives of the four B-splines that live on a cell, by t. */
using CubicBSplines = Eigen::Matrix<double, 3, 4>;

/** @param t   place in the cell, in [0, 1] */
inline CubicBSplines calcCubicBSplines(double t) {
    const double w = 1 - t;
    CubicBSplines splines;
    splines.row(0) << w * w * w / 6, ((3 * t - 6) * t * t + 4) / 6, ((3 * w - 6) * w * w + 4) / 6, t * t * t / 6;
    splines.row(1) << -0.5 * w * w, (1.5 * t - 2) * t, -(1.5 * w - 2) * w, 0.5 * t * t;
    splines.row(2) << w, 3 * t - 2, 3 * w - 2, t;
    return splines;
}

}  // namespace tautline
