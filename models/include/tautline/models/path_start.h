// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/models/wrap_binding.h"
#include "tautline/paths/path_iteration.h"
#include "tautline/simbody/cable.h"

namespace tautline::models {

/** The starts that a file gives for the wraps of a path; empty if it gives none. The points are put onto their surfaces
and the directions made tangent. */
PathStart makePathStart(const std::vector<BoundWrap>& wraps, const Cable& cable);

}  // namespace tautline::models
