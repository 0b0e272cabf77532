// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tautline/models/model_description.h"

namespace tautline::models {

/** The coordinates that can change the length of a path, in the order of the file: of the joints between the bodies of
its points and of its active wrap objects, those that move its points, those of its functions, and all that constraints
make move along with one of these. */
std::vector<std::string> findCrossedCoordinates(const ModelDescription& description, const MusclePath& path);

}  // namespace tautline::models
