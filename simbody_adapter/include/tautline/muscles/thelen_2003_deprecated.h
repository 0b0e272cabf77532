// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/muscles/muscle_model.h"

namespace tautline {

/** Defaults are those of OpenSim's Thelen2003Muscle_Deprecated. maxContractionVelocity is its Vmax. */
struct Thelen2003DeprecatedParameters : MuscleParameters {
    Thelen2003DeprecatedParameters() {
        minimumActivation = 1e-6;
        defaultActivation = 0;
    }
    double velocityAtRest = 5;      ///< Vmax0: the maximal contraction velocity at activation 0 [l_0/s]
    double tendonStrain = 0.033;    ///< FmaxTendonStrain
    double passiveStrain = 0.6;     ///< FmaxMuscleStrain
    double activeWidth = 0.5;       ///< KshapeActive
    double passiveShape = 4;        ///< KshapePassive
    double damping = 0.05;          ///< of the fiber, in the equation of its velocity
    double velocityShape = 0.3;     ///< Af
    double lengtheningForce = 1.8;  ///< Flen

    /** @throws InvalidInput naming the parameter and its value */
    void validate() const;
};

/** Thelen's muscle as OpenSim had it before it was adjusted, Thelen2003Muscle_Deprecated. Other than in Thelen2003:

    f_P = exp(k ((l - 1)/passiveStrain - 1), from l = 1 + passiveStrain on straight
    f_T = (exp(3 e/e_toe) - 1)/(exp(3) - 1)/3 up to e_toe = 0.609 tendonStrain, then straight with slope
          1.712/tendonStrain, and 0.001 l_T more, so that the tendon is never slack
    v   = V(a) (f - a f_L)/(b + damping),  V(a) = Vmax0 + a (Vmax - Vmax0),  f the force of active and damping part
    da/dt = (u - a)/tau with the two time constants as they are

The part of the force that the damping takes counts as active. */
class Thelen2003Deprecated : public MuscleModel {
public:
    /** @throws InvalidInput as Thelen2003DeprecatedParameters::validate() */
    explicit Thelen2003Deprecated(const Thelen2003DeprecatedParameters& parameters);

    const Thelen2003DeprecatedParameters& getParameters() const override { return m_parameters; }
    std::string getDescription() const override { return "Thelen (2003), in OpenSim's deprecated form"; }

    double calcActiveForceLength(double fiberLength) const override;
    double calcPassiveForceLength(double fiberLength) const override;
    double calcTendonForceLength(double tendonLength) const override;
    /** For a rigid tendon only; without the damping. */
    double calcForceVelocity(double velocity, double activation) const override;
    double calcPassiveEnergy(double fiberLength) const override;
    double calcTendonEnergy(double tendonLength) const override;
    double calcFiberVelocity(double force, double activation, double activeForceLength) const override;
    double calcActivationRate(double excitation, double activation) const override;

private:
    double calcSpeedShare(double activation) const;
    double calcHillVelocity(double force, double peak) const;

    Thelen2003DeprecatedParameters m_parameters;
};

}  // namespace tautline
