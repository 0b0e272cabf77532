// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/millard_2012.h"

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"

namespace tautline {
namespace {

constexpr double kLeastDamping = 0.001;  ///< OpenSim: less is none
constexpr double kLeastClassicActivation = 0.01, kLeastClassicActiveForce = 0.1;

/** The share of a corner's sides that the control points take: neither quite sharp nor quite straight. */
double scaleCurviness(double curviness) {
    return 0.1 + 0.8 * curviness;
}

/** @return whether the muscle is the classic one, which divides by a f_L and by the slope of f_V */
bool isClassic(const Millard2012Parameters& p) {
    const bool isRigid = p.ignoresTendonCompliance || p.tendonSlackLength == 0;
    return !isRigid && p.fiberDamping < kLeastDamping;
}

/** What OpenSim makes of a file's parameters before it builds the curves. */
Millard2012Parameters adjust(Millard2012Parameters p) {
    p.validate();
    if (p.fiberDamping < kLeastDamping) p.fiberDamping = 0;
    ForceVelocityCurve& f = p.forceVelocity;
    if (isClassic(p)) {
        p.minimumActivation = std::max(p.minimumActivation, kLeastClassicActivation);
        p.activeForceLength.minimumValue = std::max(p.activeForceLength.minimumValue, kLeastClassicActiveForce);
        f.concentricSlopeAtVmax = 0.5 * f.concentricSlopeNearVmax;
        f.eccentricSlopeAtVmax = 0.5 * f.eccentricSlopeNearVmax;
    } else {
        p.activeForceLength.minimumValue = 0;
        f.concentricSlopeAtVmax = f.eccentricSlopeAtVmax = 0;
    }
    return p;
}

/** @throws InvalidInput unless all or none is given. @return whether all are */
bool areGiven(const char* curve, const std::optional<double>& a, const std::optional<double>& b,
              const std::optional<double>& c) {
    const int given = a.has_value() + b.has_value() + c.has_value();
    require(given == 0 || given == 3, curve, ": of its three optional parameters ", given,
            " are given, but it must be all or none");
    return given == 3;
}

}  // namespace

SmoothCurve ActiveForceLengthCurve::makeCurve() const {
    const double x0 = minNormActiveFiberLength, x1 = transitionNormFiberLength, x3 = maxNormActiveFiberLength;
    require(x0 >= 0 && x1 > x0 && x1 < 0.95 && x3 > 1.05, "ActiveForceLengthCurve: the lengths must be 0 <= ", x0,
            " < ", x1, " < 0.95 and ", x3, " > 1.05");
    // The plateau's shoulder is 0.05 wide on either side of the optimum.
    const double shoulder = 0.95, slope = shallowAscendingSlope;
    const double y1 = 1 - slope * (shoulder - x1);
    const CurvePoint steep{0.5 * (x0 + x1), 0.5 * y1, 1.25 * y1 / (x1 - x0)};
    const CurvePoint shallow{0.5 * (x1 + shoulder), 0.5 * (1 + y1), slope};
    const CurvePoint falling{0.5 * (1.05 + x3), 0.5, -1 / (x3 - 1.1)};
    const double c = scaleCurviness(1);
    return SmoothCurve({{x0, minimumValue, 0}, steep, shallow, {1, 1, 0}, falling, {x3, minimumValue, 0}},
                       {c, c, c, c, c}, "ActiveForceLengthCurve");
}

SmoothCurve ForceVelocityCurve::makeCurve() const {
    const double fmax = maxEccentricVelocityForceMultiplier;
    requireAboveOne(fmax, "ForceVelocityCurve: max_eccentric_velocity_force_multiplier");
    // The near points lie 0.1 V_max from the ends, each on the mean of the two slopes.
    const double nearC = 0.05 * (concentricSlopeNearVmax + concentricSlopeAtVmax);
    const double nearE = fmax - 0.05 * (eccentricSlopeNearVmax + eccentricSlopeAtVmax);
    const double cC = scaleCurviness(concentricCurviness), cE = scaleCurviness(eccentricCurviness);
    return SmoothCurve({{-1, 0, concentricSlopeAtVmax},
                        {-0.9, nearC, concentricSlopeNearVmax},
                        {0, 1, isometricSlope},
                        {0.9, nearE, eccentricSlopeNearVmax},
                        {1, fmax, eccentricSlopeAtVmax}},
                       {cC, cC, cE, cE}, "ForceVelocityCurve");
}

SmoothCurve FiberForceLengthCurve::makeCurve() const {
    const bool given = areGiven("FiberForceLengthCurve", stiffnessAtLowForce, stiffnessAtOneNormForce, curviness);
    const double span = strainAtOneNormForce - strainAtZeroForce;
    requirePositive(span, "FiberForceLengthCurve: strain_at_one_norm_force - strain_at_zero_force");
    const double low = given ? *stiffnessAtLowForce : 0.2;
    const double stiffness = given ? *stiffnessAtOneNormForce : 2 / span;
    const double c = scaleCurviness(given ? *curviness : 0.75);
    const double foot = std::min(0.1 / stiffness, 0.1 * span), zero = 1 + strainAtZeroForce;
    return SmoothCurve({{zero, 0, 0}, {zero + foot, 0.5 * low * foot, low}, {1 + strainAtOneNormForce, 1, stiffness}},
                       {c, c}, "FiberForceLengthCurve");
}

SmoothCurve TendonForceLengthCurve::makeCurve() const {
    const bool given = areGiven("TendonForceLengthCurve", stiffnessAtOneNormForce, normForceAtToeEnd, curviness);
    requirePositive(strainAtOneNormForce, "TendonForceLengthCurve: strain_at_one_norm_force");
    const double stiffness = given ? *stiffnessAtOneNormForce : 1.375 / strainAtOneNormForce;
    const double toeForce = given ? *normForceAtToeEnd : 2.0 / 3;
    const double c = scaleCurviness(given ? *curviness : 0.5);
    const double one = 1 + strainAtOneNormForce;
    const double toe = one + (toeForce - 1) / stiffness, foot = 1 + (toe - 1) / 10;
    // The toe bends twice: towards the line from its foot to the middle of its straight continuation, then into this.
    const double middle = one + (0.5 * toeForce - 1) / stiffness;
    const double slope = 0.5 * toeForce / (middle - foot), between = 0.5 * (foot + middle);
    return SmoothCurve({{1, 0, 0}, {between, slope * (between - foot), slope}, {toe, toeForce, stiffness}}, {c, c},
                       "TendonForceLengthCurve");
}

Millard2012::Millard2012(const Millard2012Parameters& parameters)
    : m_parameters(adjust(parameters)),
      m_active(m_parameters.activeForceLength.makeCurve()),
      m_forceVelocity(m_parameters.forceVelocity.makeCurve()),
      m_passive(m_parameters.fiberForceLength.makeCurve()),
      m_tendon(m_parameters.tendonForceLength.makeCurve()) {}

double Millard2012::calcFiberVelocity(double force, double activation, double activeForceLength) const {
    return m_forceVelocity.findArgument(activation * activeForceLength, m_parameters.fiberDamping, force, kFastest);
}

double Millard2012::calcMinimumFiberLength() const {
    return std::max(m_parameters.activeForceLength.minNormActiveFiberLength, MuscleModel::calcMinimumFiberLength());
}

}  // namespace tautline
