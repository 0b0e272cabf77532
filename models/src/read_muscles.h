// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the members of ForceSet: muscles with their paths. */
void readForces(Element& model, const FrameTable& frames);

}  // namespace tautline::models
