// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "read_bodies.h"

namespace tautline::models {

/** Enters the members of JointSet and the frames of all joints. */
void collectJoints(Element& model, BodyParts& parts);

/** Reads the collected joints, in either layout. */
void readJoints(const BodyParts& parts);

}  // namespace tautline::models
