// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "tautline/types.h"

namespace tautline {

/** Sines and cosines of two angles at once, within 2 units of the last place: what the charts of quadrics
and tori are made of, and most of their cost. The polynomials on [-pi/4, pi/4] are those of fdlibm (k_sin.c,
k_cos.c; S. Moshier's Cephes has the same scheme), here for both angles in step so that the compiler can pair them. */
struct SineCosine {
    Vector2 sine, cosine;

    explicit SineCosine(const Vector2& angles) {
        constexpr double kLimit = 1e5;  // beyond, reduction by two parts of pi/2 would cost digits
        if (!(std::abs(angles[0]) < kLimit && std::abs(angles[1]) < kLimit)) {
            sine = Vector2(std::sin(angles[0]), std::sin(angles[1]));
            cosine = Vector2(std::cos(angles[0]), std::cos(angles[1]));
            return;
        }
        // Round to the nearest multiple of pi/2 by adding 1.5 2^52: the integer lands in the last bits.
        constexpr double kShift = 6755399441055744.0;
        const Eigen::Array2d x = angles.array();
        const Eigen::Array2d turns = (x * 0.63661977236758134308 + kShift) - kShift;
        const Eigen::Array2d r = (x - turns * 1.57079632673412561417e+00) - turns * 6.07710050650619224932e-11;
        const Eigen::Array2d z = r * r;
        const Eigen::Array2d s =
            r + r * z *
                    (-1.66666666666666324348e-01 +
                     z * (8.33333333332248946124e-03 +
                          z * (-1.98412698298579493134e-04 +
                               z * (2.75573137070700676789e-06 +
                                    z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
        const Eigen::Array2d c =
            1 - (0.5 * z - z * z *
                               (4.16666666666666019037e-02 +
                                z * (-1.38888888888741095749e-03 +
                                     z * (2.48015872894767294178e-05 +
                                          z * (-2.75573143513906633035e-07 +
                                               z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))));
        for (int i = 0; i < 2; ++i) {
            const int quadrant = static_cast<int>(turns[i]) & 3;
            const double a = quadrant & 1 ? c[i] : s[i], b = quadrant & 1 ? s[i] : c[i];
            sine[i] = quadrant & 2 ? -a : a;
            cosine[i] = (quadrant + 1) & 2 ? -b : b;
        }
    }
};

}  // namespace tautline
