// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the members of ConstraintSet that are enforced. */
void readConstraints(Element& model, const FrameTable& frames);

/** The coordinate that an element names, by itself or as the last step of a path. */
const Coordinate& resolveCoordinate(const Element& socket);
/** The same where the element lists several. */
const Coordinate& resolveCoordinate(const Element& socket, const std::string& path);

}  // namespace tautline::models
