// SPDX-License-Identifier: Apache-2.0
#include "read_muscle_models.h"

#include <map>
#include <sstream>

#include "read_functions.h"
#include "simm_curves.h"
#include "tautline/error.h"
#include "tautline/muscles/curve_muscles.h"
#include "tautline/muscles/de_groote_fregly_2016.h"
#include "tautline/muscles/millard_2012.h"
#include "tautline/muscles/thelen_2003.h"
#include "tautline/muscles/thelen_2003_deprecated.h"

namespace tautline::models {
namespace {

using ModelPointer = std::shared_ptr<const MuscleModel>;
using ModelReader = ModelPointer (*)(Element&, Muscle&);

std::string toText(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void take(Element& element, const char* tag, double& value) {
    value = element.getNumberOr(tag, value);
}

void take(Element& element, const char* tag, std::optional<double>& value) {
    // OpenSim writes an optional number that is not set as an empty element.
    if (const Element child = element.find(tag); child && !child.getText().empty()) value = child.getNumber();
}

/** Dimensions of the muscle, whose defaults say nothing of it. */
void noteDefault(const char* tag, double value, Muscle& muscle) {
    muscle.notes.push_back(std::string(tag) + " is not given: OpenSim's " + toText(value));
}

void takeSize(Element& element, const char* tag, double& value, Muscle& muscle) {
    if (element.find(tag))
        value = element.requirePositive(tag);
    else
        noteDefault(tag, value, muscle);
}

void takeSlackLength(Element& element, double& value, Muscle& muscle) {
    const char* tag = "tendon_slack_length";
    const Element child = element.find(tag);
    take(element, tag, value);
    if (value < 0) child.fail(std::string(tag) + " of " + element.describe() + " is " + child.getText() + ", negative");
    if (!child) noteDefault(tag, value, muscle);
    if (value == 0) muscle.notes.push_back("has no tendon: the fiber is as long as the path");
}

void readCommon(Element& element, MuscleParameters& p, Muscle& muscle) {
    takeSize(element, "max_isometric_force", p.maxIsometricForce, muscle);
    takeSize(element, "optimal_fiber_length", p.optimalFiberLength, muscle);
    takeSlackLength(element, p.tendonSlackLength, muscle);
    if (const Element angle = element.findAny({"pennation_angle_at_optimal", "pennation_angle"}))
        p.pennationAtOptimal = angle.getNumber();
    take(element, "max_contraction_velocity", p.maxContractionVelocity);
    p.ignoresTendonCompliance = element.getBoolOr("ignore_tendon_compliance", false);
    p.ignoresActivationDynamics = element.getBoolOr("ignore_activation_dynamics", false);
}

/** What the muscles of OpenSim 3 and later share. */
void readActivation(Element& element, MuscleParameters& p) {
    take(element, "activation_time_constant", p.activationTime);
    take(element, "deactivation_time_constant", p.deactivationTime);
    take(element, "default_activation", p.defaultActivation);
}

ModelPointer readThelen(Element& element, Muscle& muscle) {
    Thelen2003Parameters p;
    readCommon(element, p, muscle);
    readActivation(element, p);
    take(element, "minimum_activation", p.minimumActivation);
    take(element, "maximum_pennation_angle", p.maximumPennation);
    take(element, "FmaxTendonStrain", p.tendonStrain);
    take(element, "FmaxMuscleStrain", p.passiveStrain);
    take(element, "KshapeActive", p.activeWidth);
    take(element, "KshapePassive", p.passiveShape);
    take(element, "Af", p.velocityShape);
    take(element, "Flen", p.lengtheningForce);
    take(element, "fv_linear_extrap_threshold", p.linearThreshold);
    return std::make_shared<Thelen2003>(p);
}

ModelPointer readThelenDeprecated(Element& element, Muscle& muscle) {
    Thelen2003DeprecatedParameters p;
    readCommon(element, p, muscle);
    take(element, "activation_time_constant", p.activationTime);
    take(element, "deactivation_time_constant", p.deactivationTime);
    take(element, "Vmax", p.maxContractionVelocity);
    take(element, "Vmax0", p.velocityAtRest);
    take(element, "FmaxTendonStrain", p.tendonStrain);
    take(element, "FmaxMuscleStrain", p.passiveStrain);
    take(element, "KshapeActive", p.activeWidth);
    take(element, "KshapePassive", p.passiveShape);
    take(element, "damping", p.damping);
    take(element, "Af", p.velocityShape);
    take(element, "Flen", p.lengtheningForce);
    return std::make_shared<Thelen2003Deprecated>(p);
}

ModelPointer readDeGrooteFregly(Element& element, Muscle& muscle) {
    DeGrooteFregly2016Parameters p;
    readCommon(element, p, muscle);
    readActivation(element, p);
    take(element, "active_force_width_scale", p.activeForceWidthScale);
    take(element, "fiber_damping", p.fiberDamping);
    take(element, "passive_fiber_strain_at_one_norm_force", p.passiveFiberStrain);
    take(element, "tendon_strain_at_one_norm_force", p.tendonStrain);
    p.ignoresPassiveFiberForce = element.getBoolOr("ignore_passive_fiber_force", false);
    element.skip({"default_normalized_tendon_force"}, "a run starts from equilibrium");
    element.skip({"tendon_compliance_dynamics_mode"}, "both ways move the fiber alike");
    return std::make_shared<DeGrooteFregly2016>(p);
}

using Fields = std::initializer_list<std::pair<const char*, double*>>;
using OptionalFields = std::initializer_list<std::pair<const char*, std::optional<double>*>>;

/** A curve, if the file has it. Of those of older versions OpenSim ignores what has since been renamed. */
void readCurve(Element& muscle, const char* name, const Fields& fields, const OptionalFields& optionals = {}) {
    Element curve = muscle.find(name);
    if (!curve) return;
    for (const auto& [tag, value] : fields) take(curve, tag, *value);
    for (const auto& [tag, value] : optionals) take(curve, tag, *value);
    curve.skip({"min_concentric_slope", "min_eccentric_slope"}, "OpenSim ignores it");
    curve.refuseUnknown();
}

void readCurves(Element& element, Millard2012Parameters& p) {
    ActiveForceLengthCurve& a = p.activeForceLength;
    readCurve(element, "ActiveForceLengthCurve",
              {{"min_norm_active_fiber_length", &a.minNormActiveFiberLength},
               {"transition_norm_fiber_length", &a.transitionNormFiberLength},
               {"max_norm_active_fiber_length", &a.maxNormActiveFiberLength},
               {"shallow_ascending_slope", &a.shallowAscendingSlope},
               {"minimum_value", &a.minimumValue}});
    ForceVelocityCurve& v = p.forceVelocity;
    readCurve(element, "ForceVelocityCurve",
              {{"concentric_slope_at_vmax", &v.concentricSlopeAtVmax},
               {"concentric_slope_near_vmax", &v.concentricSlopeNearVmax},
               {"isometric_slope", &v.isometricSlope},
               {"eccentric_slope_at_vmax", &v.eccentricSlopeAtVmax},
               {"eccentric_slope_near_vmax", &v.eccentricSlopeNearVmax},
               {"max_eccentric_velocity_force_multiplier", &v.maxEccentricVelocityForceMultiplier},
               {"concentric_curviness", &v.concentricCurviness},
               {"eccentric_curviness", &v.eccentricCurviness}});
    FiberForceLengthCurve& f = p.fiberForceLength;
    readCurve(element, "FiberForceLengthCurve",
              {{"strain_at_zero_force", &f.strainAtZeroForce}, {"strain_at_one_norm_force", &f.strainAtOneNormForce}},
              {{"stiffness_at_low_force", &f.stiffnessAtLowForce},
               {"stiffness_at_one_norm_force", &f.stiffnessAtOneNormForce},
               {"curviness", &f.curviness}});
    TendonForceLengthCurve& t = p.tendonForceLength;
    readCurve(element, "TendonForceLengthCurve", {{"strain_at_one_norm_force", &t.strainAtOneNormForce}},
              {{"stiffness_at_one_norm_force", &t.stiffnessAtOneNormForce},
               {"norm_force_at_toe_end", &t.normForceAtToeEnd},
               {"curviness", &t.curviness}});
}

ModelPointer readMillard(Element& element, Muscle& muscle) {
    Millard2012Parameters p;
    readCommon(element, p, muscle);
    readActivation(element, p);
    take(element, "minimum_activation", p.minimumActivation);
    take(element, "maximum_pennation_angle", p.maximumPennation);
    take(element, "fiber_damping", p.fiberDamping);
    readCurves(element, p);
    return std::make_shared<Millard2012>(p);
}

/** A function property, written either inside an element of its name or as a function that bears it. */
std::optional<ScalarFunction> findFunction(Element& element, const std::string& name) {
    if (const Element wrapper = element.find(name)) return readWrappedFunction(wrapper);
    for (const Element& child : element.getChildren()) {
        if (child.getName() != name) continue;
        element.acceptTag(child.getTag());
        return readFunction(child, 1).asScalar();
    }
    return std::nullopt;
}

MuscleCurve toCurve(const ScalarFunction& function) {
    return [function](double x) { return function.calcValue(x); };
}

MuscleCurve readTable(Element& element, const std::string& name, const ScalarFunction& otherwise) {
    return toCurve(findFunction(element, name).value_or(otherwise));
}

void readSimmActivation(Element& element, CurveMuscleParameters& p) {
    take(element, "time_scale", p.timeScale);
    take(element, "activation1", p.activation1);
    take(element, "activation2", p.activation2);
}

ModelPointer readSchutte(Element& element, Muscle& muscle) {
    CurveMuscleParameters p;
    readCommon(element, p, muscle);
    readSimmActivation(element, p);
    p.fiberDamping = 0.1;
    take(element, "damping", p.fiberDamping);
    p.activeForceLength = readTable(element, "active_force_length_curve", makeSimmActiveCurve());
    p.tendonForceStrain = readTable(element, "tendon_force_length_curve", makeSimmTendonCurve());
    if (const auto passive = findFunction(element, "passive_force_length_curve"))
        p.passiveForceLength = toCurve(*passive);
    element.skip({"force_velocity_curve"}, "OpenSim ignores it");
    return std::make_shared<Schutte1993>(p);
}

ModelPointer readDelp(Element& element, Muscle& muscle) {
    CurveMuscleParameters p;
    readCommon(element, p, muscle);
    readSimmActivation(element, p);
    p.activeForceLength = readTable(element, "active_force_length_curve", makeSimmActiveCurve());
    p.passiveForceLength = readTable(element, "passive_force_length_curve", makeSimmPassiveCurve());
    p.tendonForceStrain = readTable(element, "tendon_force_length_curve", makeSimmTendonCurve());
    const MuscleCurve forceVelocity = readTable(element, "force_velocity_curve", makeSimmVelocityCurve());
    if (element.find("mass")) muscle.notes.push_back("the mass between its fiber and tendon is left out");
    return std::make_shared<Delp1990>(p, forceVelocity);
}

ModelPointer readRigidTendon(Element& element, Muscle& muscle) {
    CurveMuscleParameters p;
    readCommon(element, p, muscle);
    p.activeForceLength = readTable(element, "active_force_length_curve", makeSimmActiveCurve());
    p.passiveForceLength = readTable(element, "passive_force_length_curve", makeSimmPassiveCurve());
    const MuscleCurve forceVelocity = readTable(element, "force_velocity_curve", makeSimmVelocityCurve());
    return std::make_shared<RigidTendonMuscle>(p, forceVelocity);
}

const std::map<std::string, ModelReader>& getModelReaders() {
    static const std::map<std::string, ModelReader> kReaders{{"Thelen2003Muscle", readThelen},
                                                             {"Thelen2003Muscle_Deprecated", readThelenDeprecated},
                                                             {"Millard2012EquilibriumMuscle", readMillard},
                                                             {"DeGrooteFregly2016Muscle", readDeGrooteFregly},
                                                             {"Schutte1993Muscle", readSchutte},
                                                             {"Schutte1993Muscle_Deprecated", readSchutte},
                                                             {"Delp1990Muscle", readDelp},
                                                             {"Delp1990Muscle_Deprecated", readDelp},
                                                             {"RigidTendonMuscle", readRigidTendon}};
    return kReaders;
}

/** What OpenSim's tools alone use, and what only another type of muscle has, left behind where a muscle's type was
 * changed. */
void skipRest(Element& element) {
    element.skip({"optimal_force"}, "of a muscle without meaning");
    element.skip({"min_control", "max_control"}, "excitations have their own limits");
    element.skip({"default_fiber_length"}, "a run starts from equilibrium");
    element.skipUnread({"activation_time_constant",
                        "deactivation_time_constant",
                        "default_activation",
                        "minimum_activation",
                        "maximum_pennation_angle",
                        "fiber_damping",
                        "FmaxTendonStrain",
                        "FmaxMuscleStrain",
                        "KshapeActive",
                        "KshapePassive",
                        "Af",
                        "Flen",
                        "fv_linear_extrap_threshold",
                        "Vmax",
                        "Vmax0",
                        "damping",
                        "time_scale",
                        "activation1",
                        "activation2",
                        "mass",
                        "ActiveForceLengthCurve",
                        "ForceVelocityCurve",
                        "ForceVelocityInverseCurve",
                        "FiberForceLengthCurve",
                        "TendonForceLengthCurve",
                        "FiberCompressiveForceCosPennationCurve",
                        "FiberCompressiveForceLengthCurve",
                        "MuscleFixedWidthPennationModel",
                        "MuscleFirstOrderActivationDynamicModel",
                        "tendon_force_length_curve",
                        "active_force_length_curve",
                        "passive_force_length_curve",
                        "force_velocity_curve",
                        "default_normalized_tendon_force",
                        "active_force_width_scale",
                        "ignore_passive_fiber_force",
                        "passive_fiber_strain_at_one_norm_force",
                        "tendon_strain_at_one_norm_force",
                        "tendon_compliance_dynamics_mode"},
                       "a muscle of this type has no such property: OpenSim ignores it");
}

}  // namespace

bool isMuscleType(const std::string& tag) {
    return getModelReaders().count(tag) > 0;
}

void readMuscleModel(Element& element, Muscle& muscle) {
    try {
        muscle.model = getModelReaders().at(element.getTag())(element, muscle);
    } catch (const InvalidInput& error) {
        element.fail(element.describe() + ": " + error.what());
    }
    skipRest(element);
}

}  // namespace tautline::models
