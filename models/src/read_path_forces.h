// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads an elastic string with its path. */
void readPathSpring(Element& element, const FrameTable& frames);

}  // namespace tautline::models
