// SPDX-License-Identifier: Apache-2.0
#include "read_controllers.h"

#include "read_functions.h"

namespace tautline::models {
namespace {

/** The names of the forces that a controller may act on. */
std::vector<std::string> getActuatorNames(const ModelDescription& model) {
    std::vector<std::string> names;
    for (const Muscle& muscle : model.muscles) names.push_back(muscle.name);
    for (const PathForce& force : model.pathForces)
        if (std::holds_alternative<ControlledTension>(force.tension)) names.push_back(force.name);
    for (const BodyForce& force : model.bodyForces)
        if (std::holds_alternative<CoordinateActuator>(force.law)) names.push_back(force.name);
    return names;
}

/** The actuators that a controller names: all for ALL, and each by itself or as the last step of a path. */
std::vector<std::string> readActuators(Element& controller) {
    Element list = controller.findAny({"actuator_list", "socket_actuators"});
    if (!list) return {};
    const std::vector<std::string> known = getActuatorNames(controller.updReading().model);
    std::vector<std::string> actuators;
    for (const std::string& path : list.getWords()) {
        if (path == "ALL") return known;
        actuators.push_back(path.substr(path.rfind('/') + 1));
    }
    return actuators;
}

void readPrescribedController(Element& controller) {
    const std::vector<std::string> actuators = readActuators(controller);
    Element set = controller.find("ControlFunctions");
    const std::vector<Element> functions = set ? set.getSetMembers() : std::vector<Element>();
    if (functions.size() != actuators.size()) {
        controller.fail(controller.describe() + " has " + std::to_string(functions.size()) + " functions for " +
                        std::to_string(actuators.size()) + " actuators");
    }
    controller.skip({"interpolation_method"}, "of a controller with functions without meaning");
    controller.skip({"controls_file"}, "the controls of a file are not read", Effect::Forces);
    controller.refuseUnknown();
    auto& controls = controller.updReading().model.controls;
    for (std::size_t i = 0; i < actuators.size(); ++i)
        controls.push_back({actuators[i], readFunction(functions[i], 1).asScalar(), functions[i].findLine()});
}

bool isEnabled(Element& controller) {
    const bool disabled = controller.getBoolOr("isDisabled", false);
    return controller.getBoolOr("enabled", true) && !disabled;
}

}  // namespace

void readControllers(Element& model) {
    Element set = model.find("ControllerSet");
    if (!set) return;
    const std::vector<Element> controllers = set.getSetMembers();
    if (controllers.empty()) set.skipThis("Model", "empty");
    for (Element controller : controllers) {
        if (!isEnabled(controller))
            controller.skipThis("ControllerSet", "not enabled");
        else if (controller.getTag() == "PrescribedController")
            readPrescribedController(controller);
        else
            controller.refuse("controller", Effect::Forces);
    }
}

}  // namespace tautline::models
