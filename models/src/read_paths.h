// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the path inside an element that owns one, such as a muscle. */
MusclePath readOwnedPath(Element& owner, const FrameTable& frames);

/** Reads an element that is a path.
@param owner   for messages */
MusclePath readPath(Element element, const std::string& owner, const FrameTable& frames);

}  // namespace tautline::models
