// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "element.h"

namespace tautline::models {

/** Whether an element is a muscle whose model is known, by any of the names that it had. */
bool isMuscleType(const std::string& tag);

/** Reads the parameters of a muscle, of the type that its tag names, and everything that is no path. What the file
leaves out is as in OpenSim; where that is a dimension of the muscle, a note says so. */
void readMuscleModel(Element& element, Muscle& muscle);

}  // namespace tautline::models
