// SPDX-License-Identifier: Apache-2.0
#include "read_muscles.h"

#include "read_forces.h"
#include "read_paths.h"

namespace tautline::models {
namespace {

void readFibers(Element& element, Muscle& muscle) {
    muscle.maxIsometricForce = element.requirePositive("max_isometric_force");
    muscle.optimalFiberLength = element.requirePositive("optimal_fiber_length");
    muscle.tendonSlackLength = element.requirePositive("tendon_slack_length");
    muscle.pennationAngleAtOptimal = element.getNumberOr("pennation_angle_at_optimal", 0.0);
    if (element.find("max_contraction_velocity"))
        muscle.maxContractionVelocity = element.requirePositive("max_contraction_velocity");
    muscle.ignoresTendonCompliance = element.getBoolOr("ignore_tendon_compliance", false);
    muscle.ignoresActivationDynamics = element.getBoolOr("ignore_activation_dynamics", false);
}

void readShapeFactors(Element& element, Muscle& muscle) {
    muscle.activationTimeConstant = element.findNumber("activation_time_constant");
    muscle.deactivationTimeConstant = element.findNumber("deactivation_time_constant");
    muscle.tendonStrainAtMaxForce = element.findNumber("FmaxTendonStrain");
    muscle.fiberStrainAtMaxForce = element.findNumber("FmaxMuscleStrain");
    muscle.activeShape = element.findNumber("KshapeActive");
    muscle.passiveShape = element.findNumber("KshapePassive");
    muscle.velocityShape = element.findNumber("Af");
    muscle.maxLengtheningForce = element.findNumber("Flen");
}

void skipMuscleDetails(Element& element) {
    element.skip({"optimal_force"}, "of a muscle without meaning");
    element.skip({"min_control", "max_control", "default_activation", "default_fiber_length", "minimum_activation",
                  "fiber_damping", "fiber_damping", "maximum_pennation_angle"},
                 "left to the muscle model");
    element.skip({"ActiveForceLengthCurve", "ForceVelocityCurve", "FiberForceLengthCurve", "TendonForceLengthCurve"},
                 "the muscle model has its own curves: forces will differ");
}

}  // namespace

void readMuscle(Element& element, const FrameTable& frames) {
    Muscle muscle;
    muscle.name = element.getRequiredName();
    muscle.type = element.getTag();
    muscle.line = element.findLine();
    auto& model = element.updReading().model;
    requireUniqueForceName(element, muscle.name);
    muscle.appliesForce = readAppliesForce(element);
    muscle.path = readOwnedPath(element, frames);
    readFibers(element, muscle);
    readShapeFactors(element, muscle);
    skipMuscleDetails(element);
    element.refuseUnknown();
    model.muscles.push_back(std::move(muscle));
}

}  // namespace tautline::models
