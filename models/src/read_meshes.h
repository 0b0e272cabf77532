// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "read_bodies.h"

namespace tautline::models {

/** Enters the meshes that the bodies and frames look like, in all the layouts that documents have had. Since they are
only drawn, one that cannot be understood is left out with a note. */
void readMeshes(const BodyParts& parts);

}  // namespace tautline::models
