// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads a muscle with its path. */
void readMuscle(Element& element, const FrameTable& frames);

}  // namespace tautline::models
