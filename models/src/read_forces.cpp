// SPDX-License-Identifier: Apache-2.0
#include "read_forces.h"

#include <map>

#include "read_muscles.h"
#include "read_path_forces.h"

namespace tautline::models {
namespace {

using ForceReader = void (*)(Element&, const FrameTable&);

void skipUncontrolled(Element& element, const FrameTable&) {
    element.skipThis("ForceSet", "gives no force while no controller drives it");
}

const std::map<std::string, ForceReader>& getForceReaders() {
    static const std::map<std::string, ForceReader> kReaders{
        {"Thelen2003Muscle", readMuscle},    {"Millard2012EquilibriumMuscle", readMuscle},
        {"PathSpring", readPathSpring},      {"CoordinateActuator", skipUncontrolled},
        {"PointActuator", skipUncontrolled}, {"TorqueActuator", skipUncontrolled}};
    return kReaders;
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
        const auto reader = getForceReaders().find(force.getTag());
        if (reader == getForceReaders().end()) force.fail("unknown force " + force.describe());
        reader->second(force, frames);
    }
}

}  // namespace tautline::models
