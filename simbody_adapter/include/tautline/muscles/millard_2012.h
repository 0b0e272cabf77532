// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "tautline/muscles/muscle_model.h"
#include "tautline/muscles/smooth_curve.h"

namespace tautline {

// The four curves of Millard et al. 2013 (J. Biomech. Eng. 135:021005, Fig. 3 and appendix). Defaults and names are
// those of OpenSim's classes of the same names, in their words for the file.

struct ActiveForceLengthCurve {
    double minNormActiveFiberLength = 0.4441;
    double transitionNormFiberLength = 0.73;
    double maxNormActiveFiberLength = 1.8123;
    double shallowAscendingSlope = 0.8616;
    double minimumValue = 0.1;

    /** Rises from the least length over the transition to 1 at length 1, and falls to the largest. */
    SmoothCurve makeCurve() const;
};

struct ForceVelocityCurve {
    double concentricSlopeAtVmax = 0;
    double concentricSlopeNearVmax = 0.25;
    double isometricSlope = 5;
    double eccentricSlopeAtVmax = 0;
    double eccentricSlopeNearVmax = 0.15;
    double maxEccentricVelocityForceMultiplier = 1.4;
    double concentricCurviness = 0.6;
    double eccentricCurviness = 0.9;

    /** 0 at -V_max, 1 at rest, the multiplier at V_max; ascending. */
    SmoothCurve makeCurve() const;
};

struct FiberForceLengthCurve {
    double strainAtZeroForce = 0;
    double strainAtOneNormForce = 0.7;
    // All three are given, or none; then they follow from the strains.
    std::optional<double> stiffnessAtLowForce, stiffnessAtOneNormForce, curviness;

    SmoothCurve makeCurve() const;
};

struct TendonForceLengthCurve {
    double strainAtOneNormForce = 0.049;
    // All three are given, or none; then they follow from the strain.
    std::optional<double> stiffnessAtOneNormForce, normForceAtToeEnd, curviness;

    SmoothCurve makeCurve() const;
};

/** Defaults are those of OpenSim's Millard2012EquilibriumMuscle. */
struct Millard2012Parameters : MuscleParameters {
    Millard2012Parameters() { fiberDamping = 0.1; }
    ActiveForceLengthCurve activeForceLength;
    ForceVelocityCurve forceVelocity;
    FiberForceLengthCurve fiberForceLength;
    TendonForceLengthCurve tendonForceLength;
};

/** The equilibrium muscle of Millard et al. (2013), OpenSim's Millard2012EquilibriumMuscle. With damping, or with a
rigid tendon, f_L falls to 0 and f_V is flat at +-V_max, whatever the file says; the fiber's velocity solves

    (a f_L f_V(v) + f_P + beta v) cos(alpha) = f_T                (Eqn. 8).

Without (damping below 0.001, compliant tendon: the "classic" muscle, Eqn. 6) f_V is inverted, with slopes at +-V_max
of half those near it, f_L and the activation are kept off zero (0.1 and 0.01). The fiber gets no shorter than where
f_L begins. */
class Millard2012 : public MuscleModel {
public:
    /** @throws InvalidInput naming the parameter or the curve */
    explicit Millard2012(const Millard2012Parameters& parameters);

    const Millard2012Parameters& getParameters() const override { return m_parameters; }
    std::string getDescription() const override { return "Millard et al. (2013)"; }

    double calcActiveForceLength(double fiberLength) const override { return m_active.calcValue(fiberLength); }
    double calcPassiveForceLength(double fiberLength) const override { return m_passive.calcValue(fiberLength); }
    double calcTendonForceLength(double tendonLength) const override { return m_tendon.calcValue(tendonLength); }
    double calcForceVelocity(double velocity, double) const override { return m_forceVelocity.calcValue(velocity); }
    double calcPassiveEnergy(double fiberLength) const override { return m_passive.calcIntegral(fiberLength); }
    double calcTendonEnergy(double tendonLength) const override { return m_tendon.calcIntegral(tendonLength); }
    double calcFiberVelocity(double force, double activation, double activeForceLength) const override;
    double calcMinimumFiberLength() const override;

private:
    Millard2012Parameters m_parameters;  ///< as adjusted
    SmoothCurve m_active, m_forceVelocity, m_passive, m_tendon;
};

}  // namespace tautline
