// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "read_bodies.h"

namespace tautline::models {

/** Reads the wrap objects of all bodies and frames. */
void readWrapObjects(const BodyParts& parts);

/** Whether a tag is that of a wrap object which needs no extension. */
bool isWrapObjectType(const std::string& tag);

}  // namespace tautline::models
