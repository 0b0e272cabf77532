// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the members of ContactGeometrySet. */
void readContactGeometries(Element& model, const FrameTable& frames);

/** The index of the contact geometry that an element names, by itself or as the last step of a path; nothing if there
is none that is known. */
std::optional<std::size_t> findContactGeometry(const ModelDescription& model, const std::string& path);

}  // namespace tautline::models
