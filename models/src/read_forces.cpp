// SPDX-License-Identifier: Apache-2.0
#include "read_forces.h"

#include <limits>
#include <map>

#include "read_body_forces.h"
#include "read_muscle_models.h"
#include "read_muscles.h"
#include "read_path_forces.h"
#include "tautline/models/extensions.h"

namespace tautline::models {
namespace {

using ForceReader = void (*)(Element&, const FrameTable&);

void skipUncontrolled(Element& element, const FrameTable&) {
    element.skipThis("ForceSet", "gives no force while no controller drives it", Effect::Forces);
}

const std::map<std::string, ForceReader>& getForceReaders() {
    static const std::map<std::string, ForceReader> kReaders{{"Millard2012AccelerationMuscle", readPathOnly},
                                                             {"ContDerivMuscle_Deprecated", readPathOnly},
                                                             {"SimpleMuscle", readPathOnly},
                                                             {"PathSpring", readPathSpring},
                                                             {"Ligament", readLigament},
                                                             {"Blankevoort1991Ligament", readBlankevoortLigament},
                                                             {"PathActuator", readPathActuator},
                                                             {"TautlinePrescribedTension", readPrescribedTension},
                                                             {"CoordinateLimitForce", readCoordinateLimitForce},
                                                             {"SpringGeneralizedForce", readCoordinateSpring},
                                                             {"BushingForce", readBushing},
                                                             {"PointToPointSpring", readPointToPointSpring},
                                                             {"CoordinateActuator", readCoordinateActuator},
                                                             {"ActivationCoordinateActuator", readCoordinateActuator},
                                                             {"HuntCrossleyForce", readHuntCrossley},
                                                             {"SmoothSphereHalfSpaceForce", readSmoothSphere},
                                                             {"PointActuator", skipUncontrolled},
                                                             {"TorqueActuator", skipUncontrolled}};
    return kReaders;
}

/** Null for a force of no known type. */
ForceReader findForceReader(const std::string& tag) {
    if (isMuscleType(tag)) return readMuscle;
    const auto found = getForceReaders().find(tag);
    if (found != getForceReaders().end()) return found->second;
    return updExtensions().findForceLaw(tag) ? readExtensionForce : nullptr;
}

/** Whether an element has what only an owner of a path has. */
bool hasPath(Element& element) {
    return static_cast<bool>(element.findAny({"GeometryPath", "Scholz2015GeometryPath", "FunctionBasedPath"}));
}

}  // namespace

bool isForceType(const std::string& tag) {
    return isMuscleType(tag) || getForceReaders().count(tag) > 0;
}

bool readAppliesForce(Element& element) {
    const bool disabled = element.getBoolOr("isDisabled", false);
    return element.getBoolOr("appliesForce", true) && !disabled;
}

std::array<double, 2> readControlRange(Element& element) {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto readEnd = [&](const std::string& tag, double fallback) {
        const Element child = element.find(tag);
        const std::string text = child ? child.getText() : "";
        if (text.empty() || text == "Inf" || text == "-Inf") return fallback;
        return child.getNumber();
    };
    const std::array<double, 2> range{readEnd("min_control", -infinity), readEnd("max_control", infinity)};
    if (range[0] > range[1]) element.fail(element.describe() + " has a min_control above its max_control");
    return range;
}

void requireUniqueForceName(const Element& element, const std::string& name) {
    const auto& model = element.updReading().model;
    if (findMuscle(model, name)) element.fail("a second muscle '" + name + "'");
    if (findSpring(model, name)) element.fail("a second path spring '" + name + "'");
    if (findPathForce(model, name)) element.fail("a second force '" + name + "' with a path");
}

void readForces(Element& model, const FrameTable& frames) {
    Element set = model.findAny({"ForceSet", "ActuatorSet"});
    if (!set) return;
    set.skip({"datafile", "external_loads_model_kinematics_file", "lowpass_cutoff_frequency_for_load_kinematics"},
             "names files of external loads, which a model does not apply by itself");
    for (Element force : set.getSetMembers()) {
        if (const ForceReader read = findForceReader(force.getTag()))
            read(force, frames);
        else if (hasPath(force))
            force.refuse("force", Effect::Motion);
        else
            force.refuse("force", Effect::Forces);
    }
}

}  // namespace tautline::models
