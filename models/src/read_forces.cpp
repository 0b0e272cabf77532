// SPDX-License-Identifier: Apache-2.0
#include "read_forces.h"

#include <map>

#include "read_muscle_models.h"
#include "read_muscles.h"
#include "read_path_forces.h"

namespace tautline::models {
namespace {

using ForceReader = void (*)(Element&, const FrameTable&);

void skipUncontrolled(Element& element, const FrameTable&) {
    element.skipThis("ForceSet", "gives no force while no controller drives it");
}

const std::map<std::string, ForceReader>& getForceReaders() {
    static const std::map<std::string, ForceReader> kReaders{{"PathSpring", readPathSpring},
                                                             {"CoordinateActuator", skipUncontrolled},
                                                             {"PointActuator", skipUncontrolled},
                                                             {"TorqueActuator", skipUncontrolled}};
    return kReaders;
}

/** Null for a force of no known type. */
ForceReader findForceReader(const std::string& tag) {
    if (isMuscleType(tag)) return readMuscle;
    const auto found = getForceReaders().find(tag);
    return found == getForceReaders().end() ? nullptr : found->second;
}

}  // namespace

bool readAppliesForce(Element& element) {
    const bool disabled = element.getBoolOr("isDisabled", false);
    return element.getBoolOr("appliesForce", true) && !disabled;
}

void requireUniqueForceName(const Element& element, const std::string& name) {
    const auto& model = element.updReading().model;
    if (findMuscle(model, name)) element.fail("a second muscle '" + name + "'");
    if (findSpring(model, name)) element.fail("a second path spring '" + name + "'");
}

void readForces(Element& model, const FrameTable& frames) {
    Element set = model.find("ForceSet");
    if (!set) return;
    for (Element force : set.getSetMembers()) {
        const ForceReader read = findForceReader(force.getTag());
        if (!read) force.fail("unknown force " + force.describe());
        read(force, frames);
    }
}

}  // namespace tautline::models
