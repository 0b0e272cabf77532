// SPDX-License-Identifier: Apache-2.0
#include "read_muscles.h"

#include "read_forces.h"
#include "read_muscle_models.h"
#include "read_paths.h"

namespace tautline::models {

void readMuscle(Element& element, const FrameTable& frames) {
    Muscle muscle;
    muscle.name = element.getRequiredName();
    muscle.type = element.getTag();
    muscle.line = element.findLine();
    requireUniqueForceName(element, muscle.name);
    muscle.appliesForce = readAppliesForce(element);
    muscle.path = readOwnedPath(element, frames);
    readMuscleModel(element, muscle);
    element.refuseUnknown();
    element.updReading().model.muscles.push_back(std::move(muscle));
}

}  // namespace tautline::models
