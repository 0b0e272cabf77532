// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The tables that OpenSim's muscles of SIMM (Schutte 1993, Delp 1990, RigidTendonMuscle) have where a file gives none.
 */
#include "tautline/models/scalar_function.h"

namespace tautline::models {

/** Active force [F_0] over fiber length [l_0]. */
ScalarFunction makeSimmActiveCurve();
/** Passive force [F_0] over fiber length [l_0]. */
ScalarFunction makeSimmPassiveCurve();
/** Force [F_0] over strain of the tendon. */
ScalarFunction makeSimmTendonCurve();
/** Factor of the active force over fiber velocity [V_max], positive in lengthening. */
ScalarFunction makeSimmVelocityCurve();

}  // namespace tautline::models
