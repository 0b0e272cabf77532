#pragma once
#include "read_bodies.h"

namespace tautline::models {

/** Reads the wrap objects of all bodies and frames. */
void readWrapObjects(const BodyParts& parts);

}  // namespace tautline::models
