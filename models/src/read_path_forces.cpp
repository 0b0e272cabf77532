// SPDX-License-Identifier: Apache-2.0
#include "read_path_forces.h"

#include "read_forces.h"
#include "read_paths.h"

namespace tautline::models {

void readPathSpring(Element& element, const FrameTable& frames) {
    PathSpring spring;
    spring.name = element.getRequiredName();
    spring.line = element.findLine();
    requireUniqueForceName(element, spring.name);
    spring.appliesForce = readAppliesForce(element);
    spring.path = readOwnedPath(element, frames);
    spring.restingLength = element.requirePositive("resting_length");
    spring.stiffness = element.requirePositive("stiffness");
    const Element dissipation = element.require("dissipation");
    spring.dissipation = dissipation.getNumber();
    if (spring.dissipation < 0.0)
        dissipation.fail("negative dissipation " + dissipation.getText() + " of " + element.describe());
    element.skip({"optimal_force", "min_control", "max_control"}, "of a spring without meaning");
    element.refuseUnknown();
    element.updReading().model.springs.push_back(std::move(spring));
}

}  // namespace tautline::models
