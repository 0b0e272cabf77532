// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Path error and its Jacobian (thesis Sec. 4.2 to 4.4) for one contact set.

Unknowns of contact i, in order: xi = (ds_P, dbeta_P, dtheta, dl), rows of its error: (e^i.N_P, e^i.B_P, e^(i+1).N_Q,
e^(i+1).B_Q). The Jacobian is block-tridiagonal with 4 x 4 blocks of which neighbours couple through one point each. */
#include <vector>

#include "paths/equations/chain.h"
#include "paths/equations/geodesic_variations.h"
#include "paths/equations/path_jacobian.h"

namespace tautline {

/** eps of all contacts, 4 per contact. @param eps   resized. @return max |eps|, 0 without contacts */
double calcPathError(const Chain& chain, std::vector<double>& eps);

/** d eps / d xi (thesis Eqn. 4.47 to 4.56). @param jacobian   resized */
void calcPathErrorJacobian(const Chain& chain, PathJacobian& jacobian);

}  // namespace tautline
