// SPDX-License-Identifier: Apache-2.0
#include "read_path_forces.h"

#include "read_forces.h"
#include "read_functions.h"
#include "read_paths.h"
#include "tautline/error.h"
#include "tautline/models/extensions.h"

namespace tautline::models {
namespace {

PathForce readCommon(Element& element, const FrameTable& frames) {
    PathForce force;
    force.name = element.getRequiredName();
    force.type = element.getTag();
    force.line = element.findLine();
    requireUniqueForceName(element, force.name);
    force.appliesForce = readAppliesForce(element);
    force.path = readOwnedPath(element, frames);
    return force;
}

double requireNotNegative(Element& element, const std::string& tag, double fallback) {
    const Element child = element.find(tag);
    const double value = child ? child.getNumber() : fallback;
    if (value < 0.0) child.fail("negative " + child.describeField() + ": " + child.getText());
    return value;
}

void keep(Element& element, PathForce&& force) {
    element.refuseUnknown();
    element.updReading().model.pathForces.push_back(std::move(force));
}

/** The curve that OpenSim gives a ligament which has none of its own. */
ScalarFunction makeDefaultLigamentCurve() {
    return ScalarFunction::simmSpline({-5, 0.998, 0.999, 1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.601, 1.602, 5},
                                      {0, 0, 0, 0, 0.035, 0.12, 0.26, 0.55, 1.17, 2, 2, 2, 2});
}

}  // namespace

void readLigament(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    LigamentTension tension;
    tension.restingLength = element.requirePositive("resting_length");
    tension.maxForce = requireNotNegative(element, "pcsa_force", 0.0);
    const Element curve = element.findAny({"force_length_curve", "ForceLengthCurve"});
    tension.curve = curve ? requireWrappedFunction(curve) : makeDefaultLigamentCurve();
    force.tension = tension;
    keep(element, std::move(force));
}

void readBlankevoortLigament(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    BlankevoortTension tension;
    tension.slackLength = element.requirePositive("slack_length");
    tension.stiffness = requireNotNegative(element, "linear_stiffness", 1.0);
    tension.transitionStrain = requireNotNegative(element, "transition_strain", 0.06);
    tension.damping = requireNotNegative(element, "damping_coefficient", 0.003);
    force.tension = tension;
    keep(element, std::move(force));
}

void readPathActuator(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    ControlledTension tension;
    tension.optimalForce = element.getNumberOr("optimal_force", 1.0);
    tension.controlRange = readControlRange(element);
    force.tension = tension;
    keep(element, std::move(force));
}

void readPrescribedTension(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    force.tension = PrescribedTension{requireNotNegative(element, "tension", 0.0)};
    keep(element, std::move(force));
}

void readExtensionForce(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    ElementProperties properties(element);
    try {
        const ForceLawMaker make = (*updExtensions().findForceLaw(element.getTag()))(properties);
        require(make != nullptr, "its extension has made no force law");
        force.tension = ExtensionTension{make};
    } catch (const InvalidInput& refused) {
        properties.fail(refused.what());
    }
    keep(element, std::move(force));
}

void readPathOnly(Element& element, const FrameTable& frames) {
    PathForce force = readCommon(element, frames);
    element.skipThis("ForceSet", "its length is known, but not its force", Effect::Forces);
    element.updReading().model.pathForces.push_back(std::move(force));
}

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
