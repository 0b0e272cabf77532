// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the members of ConstraintSet that are enforced. */
void readConstraints(Element& model, const FrameTable& frames);

/** The coordinate that an element names, by itself or as the last step of a path. */
const Coordinate& resolveCoordinate(const Element& socket);

}  // namespace tautline::models
