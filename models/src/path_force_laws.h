// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

#include "tautline/models/model_description.h"
#include "tautline/simbody/cable_force_law.h"

namespace tautline::models {

/** The control of an actuator as a function of time. */
using Control = std::function<double(double)>;

/** A force element that pulls at a cable as a model's PathForce does.
@param control   of an actuator; null: 0 */
CableForce makePathForce(SimTK::GeneralForceSubsystem& forces, const Cable& cable, const PathForce& force,
                         const Control& control);

}  // namespace tautline::models
