// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Length of a chain as a function of the natural corrections xi of its geodesics, and its derivatives. */
#include <vector>

#include "paths/equations/path_error.h"

namespace tautline {

/** dL/dxi, 4 per contact in the order of xi (ds, dbeta, dtheta, dl):

    (e^i.t_P - e^(i+1).t_Q,   e^i.B_P - a e^(i+1).B_Q,   -r e^(i+1).B_Q,   1 - e^(i+1).t_Q).

@param gradient   resized */
void calcLengthGradient(const Chain& chain, std::vector<double>& gradient);

/** Blocks of the symmetric block-tridiagonal second derivative of L at one contact, 4 x 4, rows and columns in the
order of xi. What is left out carries a factor e.B (derivatives of a and r along xi): exact where the path error
vanishes.

    own: d2L/(dxi^i dxi^i),     next: d2L/(dxi^i dxi^(i+1)), zero after the last contact and before a fixed point */
struct LengthHessianBlocks {
    Matrix4 own, next;
};
void calcLengthHessian(const Chain& chain, std::vector<LengthHessianBlocks>& hessian);

}  // namespace tautline
