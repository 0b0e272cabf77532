// SPDX-License-Identifier: Apache-2.0
/** Muscles of files: which model each type is, with which parameters, and the forces that come of it. */
#include <algorithm>
#include <cmath>

#include "model_test_support.h"
#include "support/shared_data.h"
#include "tautline/models/model_system.h"
#include "tautline/muscles/curve_muscles.h"
#include "tautline/muscles/de_groote_fregly_2016.h"
#include "tautline/muscles/millard_2012.h"
#include "tautline/muscles/thelen_2003.h"
#include "tautline/muscles/thelen_2003_deprecated.h"

namespace tautline::models::testing {
namespace {

const std::string kModels = std::string(TAUTLINE_SOURCE_DIR) + "/models/";

/** A pendulum with one muscle of a type. */
ModelDescription readMuscle(const std::string& tag, const std::string& properties,
                            const std::string& version = "40000") {
    return readOsimText(
        "<OpenSimDocument Version=\"" + version +
            "\"><Model name=\"m\"><BodySet><objects><Body name=\"b\"><mass>1</mass><mass_center>0 0 0</mass_center>"
            "<inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet><JointSet><objects><PinJoint name=\"j\">"
            "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b</socket_child_frame>"
            "<coordinates><Coordinate name=\"q\"/></coordinates></PinJoint></objects></JointSet><ForceSet><objects><" +
            tag +
            " name=\"mus\"><GeometryPath><PathPointSet><objects><PathPoint name=\"a\"><socket_parent_frame>/ground"
            "</socket_parent_frame><location>0 0.4 0</location></PathPoint><PathPoint name=\"b\"><socket_parent_frame>"
            "/bodyset/b</socket_parent_frame><location>0.1 0 0</location></PathPoint></objects></PathPointSet>"
            "</GeometryPath>" +
            properties + "</" + tag + "></objects></ForceSet></Model></OpenSimDocument>",
        "m.osim");
}

template <class Model>
const auto& getParameters(const ModelDescription& description) {
    return dynamic_cast<const Model&>(*description.muscles.at(0).model).getParameters();
}

bool isSkipped(const ModelDescription& model, const std::string& tag) {
    return std::any_of(model.skipped.begin(), model.skipped.end(),
                       [&](const SkippedElements& skipped) { return skipped.element == tag; });
}

TEST(MuscleReading, ThelenHasTheFilesParametersAndOpenSimsDefaults) {
    const ModelDescription given = readMuscle(
        "Thelen2003Muscle",
        "<max_isometric_force>12</max_isometric_force><optimal_fiber_length>0.3</optimal_fiber_length>"
        "<tendon_slack_length>0.1</tendon_slack_length><pennation_angle>0.2</pennation_angle>"
        "<max_contraction_velocity>8</max_contraction_velocity><FmaxTendonStrain>0.033</FmaxTendonStrain>"
        "<FmaxMuscleStrain>0.5</FmaxMuscleStrain><KshapeActive>0.4</KshapeActive><KshapePassive>3</KshapePassive>"
        "<Af>0.3</Af><Flen>1.8</Flen><fv_linear_extrap_threshold>0.9</fv_linear_extrap_threshold>"
        "<activation_time_constant>0.02</activation_time_constant><deactivation_time_constant>0.03"
        "</deactivation_time_constant><default_activation>0.2</default_activation><minimum_activation>0.02"
        "</minimum_activation><maximum_pennation_angle>1.4</maximum_pennation_angle>");
    const Thelen2003Parameters& p = getParameters<Thelen2003>(given);
    EXPECT_EQ(p.maxIsometricForce, 12);
    EXPECT_EQ(p.optimalFiberLength, 0.3);
    EXPECT_EQ(p.tendonSlackLength, 0.1);
    EXPECT_EQ(p.pennationAtOptimal, 0.2);
    EXPECT_EQ(p.maxContractionVelocity, 8);
    EXPECT_EQ(p.tendonStrain, 0.033);
    EXPECT_EQ(p.passiveStrain, 0.5);
    EXPECT_EQ(p.activeWidth, 0.4);
    EXPECT_EQ(p.passiveShape, 3);
    EXPECT_EQ(p.velocityShape, 0.3);
    EXPECT_EQ(p.lengtheningForce, 1.8);
    EXPECT_EQ(p.linearThreshold, 0.9);
    EXPECT_EQ(p.activationTime, 0.02);
    EXPECT_EQ(p.deactivationTime, 0.03);
    EXPECT_EQ(p.defaultActivation, 0.2);
    EXPECT_EQ(p.minimumActivation, 0.02);
    EXPECT_EQ(p.maximumPennation, 1.4);
    EXPECT_TRUE(given.muscles[0].notes.empty());

    const ModelDescription bare = readMuscle("Thelen2003Muscle", "");
    const Thelen2003Parameters& q = getParameters<Thelen2003>(bare);
    EXPECT_EQ(q.maxIsometricForce, 1000);
    EXPECT_EQ(q.tendonStrain, 0.04);
    EXPECT_EQ(q.lengtheningForce, 1.4);
    EXPECT_EQ(q.activationTime, 0.015);
    EXPECT_EQ(q.deactivationTime, 0.05);
    EXPECT_EQ(q.defaultActivation, 0.05);
    EXPECT_NEAR(q.maximumPennation, std::acos(0.1), 1e-15);
    ASSERT_EQ(bare.muscles[0].notes.size(), 3u);
    EXPECT_EQ(bare.muscles[0].notes[1], "optimal_fiber_length is not given: OpenSim's 0.1");
}

TEST(MuscleReading, MillardHasTheFilesCurves) {
    const ModelDescription given = readMuscle(
        "Millard2012EquilibriumMuscle",
        "<fiber_damping>0.01</fiber_damping><ActiveForceLengthCurve><min_norm_active_fiber_length>0.25"
        "</min_norm_active_fiber_length><transition_norm_fiber_length>0.77</transition_norm_fiber_length>"
        "<max_norm_active_fiber_length>1.9</max_norm_active_fiber_length><shallow_ascending_slope>0.75"
        "</shallow_ascending_slope><minimum_value>0</minimum_value></ActiveForceLengthCurve><ForceVelocityCurve>"
        "<isometric_slope>6</isometric_slope><concentric_curviness>0.5</concentric_curviness></ForceVelocityCurve>"
        "<FiberForceLengthCurve><strain_at_zero_force>-0.18</strain_at_zero_force><strain_at_one_norm_force>0.5"
        "</strain_at_one_norm_force><stiffness_at_low_force>0.2</stiffness_at_low_force><stiffness_at_one_norm_force>"
        "2.9</stiffness_at_one_norm_force><curviness>0.75</curviness></FiberForceLengthCurve><TendonForceLengthCurve>"
        "<strain_at_one_norm_force>0.1</strain_at_one_norm_force><curviness></curviness></TendonForceLengthCurve>"
        "<Af>0.3</Af><FmaxTendonStrain>0.033</FmaxTendonStrain>");
    const Millard2012Parameters& p = getParameters<Millard2012>(given);
    EXPECT_EQ(p.fiberDamping, 0.01);
    EXPECT_EQ(p.activeForceLength.minNormActiveFiberLength, 0.25);
    EXPECT_EQ(p.activeForceLength.maxNormActiveFiberLength, 1.9);
    EXPECT_EQ(p.forceVelocity.isometricSlope, 6);
    EXPECT_EQ(p.forceVelocity.concentricCurviness, 0.5);
    EXPECT_EQ(p.fiberForceLength.strainAtZeroForce, -0.18);
    EXPECT_EQ(p.fiberForceLength.stiffnessAtOneNormForce, 2.9);
    EXPECT_FALSE(p.tendonForceLength.curviness.has_value());
    const MuscleModel& model = *given.muscles[0].model;
    EXPECT_NEAR(model.calcTendonForceLength(1.1), 1, 1e-14);
    EXPECT_NEAR(model.calcPassiveForceLength(1.5), 1, 1e-14);
    EXPECT_EQ(model.calcMinimumFiberLength(), 0.25);
    EXPECT_TRUE(isSkipped(given, "Af"));  // of Thelen's muscle, left behind
    EXPECT_TRUE(isSkipped(given, "FmaxTendonStrain"));
    try {
        readMuscle("Millard2012EquilibriumMuscle",
                   "<FiberForceLengthCurve><curviness>0.5</curviness></FiberForceLengthCurve>");
        ADD_FAILURE() << "a curve with one of its three parameters is read";
    } catch (const ModelError& error) {
        EXPECT_STREQ(error.what(),
                     "m.osim:1: Millard2012EquilibriumMuscle 'mus': FiberForceLengthCurve: of its three optional "
                     "parameters 1 are given, but it must be all or none");
    }
}

TEST(MuscleReading, OldNamesAndCurvesOfSimmsMuscles) {
    const std::string curve =
        "<SimmSpline name=\"active_force_length_curve\"><x>0 0.5 1 1.5 2</x><y>0 0.6 0.9 0.6 0</y></SimmSpline>";
    const ModelDescription schutte = readMuscle(
        "Schutte1993Muscle", "<time_scale>0.2</time_scale><damping>0.05</damping><activation1>7</activation1>" + curve);
    const auto& model = dynamic_cast<const Schutte1993&>(*schutte.muscles.at(0).model);
    EXPECT_EQ(model.getParameters().maxContractionVelocity, 5);
    EXPECT_EQ(model.getParameters().fiberDamping, 0.05);
    EXPECT_EQ(model.getParameters().activation1, 7);
    EXPECT_NEAR(model.calcActiveForceLength(1), 0.9, 1e-15);
    EXPECT_NEAR(model.calcPassiveForceLength(1.5), 1, 1e-15);
    EXPECT_NEAR(model.calcTendonForceLength(1.0123), 0.227, 1e-15);
    EXPECT_NO_THROW(readMuscle("Delp1990Muscle", "<mass>0.003</mass>"));
    const ModelDescription rigid = readMuscle("RigidTendonMuscle", "");
    EXPECT_NEAR(rigid.muscles.at(0).model->calcActiveForceLength(1.045), 0.993333, 1e-15);
    EXPECT_TRUE(rigid.muscles.at(0).model->hasRigidTendon());
}

double calcForce(const ModelSystem& system, const SimTK::State& state, const std::string& name) {
    for (const auto& slot : system.getMuscles())
        if (slot.name == name) return slot.muscle.getTension(state);
    ADD_FAILURE() << "no muscle " << name;
    return 0;
}

TEST(MuscleReading, FullyActiveMusclesOfTheFilePullAsTheirEquationsSay) {
    const ModelDescription description = readOsimFile(kModels + "muscles.osim");
    ModelSystem system(description);
    SimTK::State state = system.makeDefaultState();
    for (auto& slot : system.updMuscles())
        if (slot.muscle.getParameters().ignoresActivationDynamics)
            slot.muscle.setExcitation(state, 1);
        else
            slot.muscle.setActivation(state, 1);
    const auto found = system.equilibrateMuscles(state);
    for (const MuscleEquilibrium& equilibrium : found) EXPECT_EQ(equilibrium.status, EquilibriumStatus::Found);
    system.getSystem().realize(state, SimTK::Stage::Velocity);
    for (const char* name :
         {"thelen_exact", "tendonless_exact", "millard_exact", "millard_classic_exact", "millard_rigid_exact", "de_groote_exact"})
        EXPECT_NEAR(calcForce(system, state, name), 100, 1e-5) << name;
    EXPECT_NEAR(calcForce(system, state, "rigid"), 80, 1e-9);
    // The others by bisection of their statics, fiber of length l, tendon of 0.3 - l.
    const auto bisect = [](const auto& excess) {
        long double low = 0.05L, high = 0.1L;
        for (int i = 0; i < 100; ++i) (excess((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
        return low;
    };
    const auto deGrooteTendon = [](long double l) {
        return 0.2L * (std::exp(std::log(6.0L) / 0.049L * ((0.3L - l) / 0.2L - 1)) - 1);
    };
    const auto deGroote = bisect([&](long double length) {
        const long double l = length / 0.1L, offset = std::exp(4 * -0.8L / 0.6L);
        const auto bell = [l](long double a, long double b, long double c, long double d) {
            return a * std::exp(-0.5L * (l - b) * (l - b) / ((c + d * l) * (c + d * l)));
        };
        const long double active =
            bell(0.8150671134243542L, 1.055033428970575L, 0.162384573599574L, 0.063303448465465L) +
            bell(0.433004984392647L, 0.716775413397760L, -0.029947116970696L, 0.200356847296188L) +
            bell(0.1L, 1, 0.353553390593274L, 0);
        return active + (std::exp(4 * (l - 1) / 0.6L) - offset) / (std::exp(4.0L) - offset) - deGrooteTendon(length);
    });
    EXPECT_NEAR(calcForce(system, state, "de_groote"), static_cast<double>(100 * deGrooteTendon(deGroote)), 1e-6);
    const auto oldTendon = [](long double l) {
        const long double strain = (0.3L - l) / 0.2L - 1, toe = 0.609L * 0.033L;
        return 0.001L * (1 + strain) + (strain > toe ? 1.712L / 0.033L * (strain - toe) + 0.333333L
                                                     : 0.333333L * std::expm1(3 * strain / toe) / std::expm1(3.0L));
    };
    const auto deprecated = bisect([&](long double length) {
        const long double l = length / 0.1L;
        return std::exp(-(l - 1) * (l - 1) / 0.5L) + std::exp(4 * (l - 1) / 0.6L - 4) - oldTendon(length);
    });
    EXPECT_NEAR(calcForce(system, state, "thelen_deprecated"), static_cast<double>(100 * oldTendon(deprecated)), 1e-6);
}

TEST(DataMuscleReading, ASampleMuscleThatIsFarTooShortIsFiniteAndSaysSo) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    ModelSystem system(readOsimFile((shared / "inputs" / "stretched.osim").string()));
    SimTK::State state = system.makeDefaultState();
    const MuscleEquilibrium found = system.equilibrateMuscles(state).at(0);
    EXPECT_EQ(found.status, EquilibriumStatus::Found);
    // The tendon of 1 cm takes what the fiber leaves of 20.1 cm, on its straight part: klin (strain - toe) + 0.33.
    const double path = std::hypot(0.02, 0.2), strain = (path - found.fiberLength) / 0.01 - 1, e = std::exp(3.0);
    const double toe = 99 * 0.04 * e / (166 * e - 67);
    EXPECT_NEAR(found.tendonForce, 100 * (0.33 + 0.67 * (strain - toe) / (0.04 - toe)), 1e-6 * found.tendonForce);
    EXPECT_NEAR(found.tendonForce,
                100 * (std::exp(-std::pow(found.fiberLength / 0.05 - 1, 2) / 0.45) * 0.05 +
                       std::expm1(5 * (found.fiberLength / 0.05 - 1) / 0.6) / std::expm1(5.0)),
                1e-6 * found.tendonForce);
}

TEST(DataMuscleReading, ATendonlessMuscleIsRead) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription description = readOsimFile((shared / "inputs" / "tendonless.osim").string());
    EXPECT_EQ(description.muscles.at(0).notes.at(0), "has no tendon: the fiber is as long as the path");
    ModelSystem system(description);
    SimTK::State state = system.makeDefaultState();
    const MuscleEquilibrium found = system.equilibrateMuscles(state).at(0);
    const double l = std::hypot(0.02, 0.2) / 0.2;
    EXPECT_NEAR(found.fiberLength, 0.2 * l, 1e-14);
    EXPECT_NEAR(found.tendonForce,
                100 * (0.05 * std::exp(-(l - 1) * (l - 1) / 0.45) + std::expm1(5 * (l - 1) / 0.6) / std::expm1(5.0)),
                1e-9);
}

}  // namespace
}  // namespace tautline::models::testing
