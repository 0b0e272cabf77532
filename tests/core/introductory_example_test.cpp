// SPDX-License-Identifier: Apache-2.0
/** The introductory example of thesis Sec. 2.3.1, iterated by the core's geodesics and natural variations. */
#include <gtest/gtest.h>

#include "paths/equations/path_error.h"
#include "tautline/surfaces/cylinder.h"

namespace tautline {
namespace {

/** Tab. 2.1: a string from O on the unit circle, phi_O = 8/9 pi, to I at (2, 0). The circle is a cylinder seen along
its axis; the geodesic from O has the length 8/9 pi - phi_Q. The thesis's path error is N_Q . (Q - I), not divided by
the length of the line (Eqn. 2.2); its derivative here is that of the end frame by the length, column 3 of Eqn. 4.47. */
TEST(IntroductoryExample, IteratesAsThesisTab2_1) {
    const double rows[7][3] = {{0.8000000000000000, 2.618033988749895, 1.175570504584947},
                               {0.091113465560706, -0.918623772225352, 0.564697105227005},
                               {0.608925626586802, 1.671120589930878, 1.884037460819405},
                               {0.326588244320030, -0.036475461311159, 1.710473214668917},
                               {0.333376131928492, 0.000232893232537, 1.732185247664296},
                               {0.333333334994133, 0.000000009037070, 1.732050812786432},
                               {0.3333333333333333, 0.000000000000000, 1.732050807568877}};
    constexpr double kPrinted = 2e-15;  // half a unit of the 15th decimal, and rounding of numbers of order one
    const double phiO = 8 * kPi / 9;
    const Vector3 I(2, 0, 0);
    const Cylinder circle(1);
    GeodesicStart start{{Vector3(std::cos(phiO), std::sin(phiO), 0)}, Vector3(std::sin(phiO), -std::cos(phiO), 0), 0};
    double phiQ = 0.8 * kPi;
    for (const auto& row : rows) {
        ShotGeodesic arc;
        start.length = phiO - phiQ;
        circle.shootGeodesic(start, {}, arc);
        const FrameVariations d = calcEndVariations(arc.Q, arc);
        const Vector3 line = arc.Q.x - I;
        const double error = arc.Q.N.dot(line);
        const double jacobian = -(d.N.col(3).dot(line) + arc.Q.N.dot(d.x.col(3)));  // by phi_Q = phi_O - length
        EXPECT_NEAR(phiQ / kPi, row[0], kPrinted);
        EXPECT_NEAR(error, row[1], kPrinted);
        EXPECT_NEAR(jacobian, row[2], kPrinted);
        phiQ -= error / jacobian;
    }
    EXPECT_NEAR(phiQ, kPi / 3, 1e-15);
}

}  // namespace
}  // namespace tautline
