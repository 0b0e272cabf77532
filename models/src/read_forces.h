// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** Reads the members of ForceSet, each by the reader of its tag. */
void readForces(Element& model, const FrameTable& frames);

/** Whether a tag is that of a force which needs no extension. */
bool isForceType(const std::string& tag);

/** Whether a force acts, in the spelling of either layout. */
bool readAppliesForce(Element& element);

/** The least and the greatest control of an actuator, unbounded where the file gives none. */
std::array<double, 2> readControlRange(Element& element);

/** Results name all forces with paths alike: no two may share a name. */
void requireUniqueForceName(const Element& element, const std::string& name);

}  // namespace tautline::models
