// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/muscles/muscle_model.h"

namespace tautline {

/** Defaults are those of OpenSim's Thelen2003Muscle, young adults but for `lengtheningForce` and `tendonStrain`. */
struct Thelen2003Parameters : MuscleParameters {
    Thelen2003Parameters() {
        activationTime = 0.015;
        deactivationTime = 0.050;
    }
    double tendonStrain = 0.04;     ///< FmaxTendonStrain: of the tendon at F_0
    double passiveStrain = 0.6;     ///< FmaxMuscleStrain: of the fiber at passive force F_0
    double activeWidth = 0.45;      ///< KshapeActive
    double passiveShape = 5;        ///< KshapePassive
    double velocityShape = 0.25;    ///< Af
    double lengtheningForce = 1.4;  ///< Flen: limit of f_V in lengthening
    double linearThreshold = 0.95;  ///< fv_linear_extrap_threshold: f_V goes on straight from there [Flen]

    /** @throws InvalidInput naming the parameter and its value */
    void validate() const;
};

/** The muscle of Thelen (2003, J. Biomech. Eng. 125:70), as adjusted in OpenSim's Thelen2003Muscle (Millard et al.
2013, J. Biomech. Eng. 135:021005, Sec. 2, and its documentation):

    f_L = exp(-(l - 1)^2/activeWidth)                                                               (Eqn. 4)
    f_P = (exp(k (l - 1)/passiveStrain) - 1)/(exp(k) - 1) for l > 1, else 0                         (Eqn. 3)
    f_T = 0.33 (exp(3 e/e_toe) - 1)/(exp(3) - 1) up to e_toe, then straight to 1 at tendonStrain    (Eqn. 5)
    v   = (0.25 + 0.75 a)(f_V - 1)/b,  b = 1 + f_V/Af in shortening,                                (Eqns. 6, 7)
          (2 + 2/Af)(Flen - f_V)/(Flen - 1) in lengthening, on straight below f_V = 0 and above 0.95 Flen

e_toe = 99 e^3 tendonStrain/(166 e^3 - 67) makes f_T smooth, where the paper rounds to 0.609 tendonStrain. f_P is not
bounded, as it is not in the paper. */
class Thelen2003 : public MuscleModel {
public:
    /** @throws InvalidInput as Thelen2003Parameters::validate() */
    explicit Thelen2003(const Thelen2003Parameters& parameters);

    const Thelen2003Parameters& getParameters() const override { return m_parameters; }
    std::string getDescription() const override { return "Thelen (2003)"; }

    double calcActiveForceLength(double fiberLength) const override;
    double calcPassiveForceLength(double fiberLength) const override;
    double calcTendonForceLength(double tendonLength) const override;
    double calcForceVelocity(double velocity, double activation) const override;
    double calcPassiveEnergy(double fiberLength) const override;
    double calcTendonEnergy(double tendonLength) const override;
    double calcFiberVelocity(double force, double activation, double activeForceLength) const override;

private:
    Thelen2003Parameters m_parameters;
    double m_toeStrain, m_stiffness;  ///< where the tendon's curve becomes straight, and its slope there
};

}  // namespace tautline
