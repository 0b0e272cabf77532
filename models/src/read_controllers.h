// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "element.h"

namespace tautline::models {

/** Reads the members of ControllerSet. Needs the forces. */
void readControllers(Element& model);

}  // namespace tautline::models
