// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/muscles/muscle_model.h"

namespace tautline {

/** Defaults are those of OpenSim's DeGrooteFregly2016Muscle. */
struct DeGrooteFregly2016Parameters : MuscleParameters {
    DeGrooteFregly2016Parameters() {
        activationTime = 0.015;
        deactivationTime = 0.060;
        defaultActivation = 0.5;
    }
    double activeForceWidthScale = 1;  ///< stretches f_L about its optimum, >= 1
    double passiveFiberStrain = 0.6;   ///< of the fiber at passive force F_0
    double tendonStrain = 0.049;       ///< of the tendon at F_0
    bool ignoresPassiveFiberForce = false;

    /** @throws InvalidInput naming the parameter and its value */
    void validate() const;
};

/** The muscle of De Groote, Kinney, Rao and Fregly (2016, Ann. Biomed. Eng. 44:2922, supplement), with the constants of
OpenSim's DeGrooteFregly2016Muscle, which send f_L and f_V through (1, 1), (0, 1) and (-1, 0) and f_T through (1, 0):

    f_L = sum of b1 exp(-(l - b2)^2/(2 (b3 + b4 l)^2))
    f_P = (exp(4 (l - 1)/e_0) - exp(4 (l_min - 1)/e_0))/(exp(4) - exp(4 (l_min - 1)/e_0)),  l_min = 0.2
    f_V = d1 asinh(d2 v + d3) + d4
    f_T = 0.2 (exp(k_T (l_T - 1)) - 1), 0 for a slack tendon
    da/dt = (u - a)((f + 1/2)/(tau_a z) + (1/2 - f) z/tau_d),  z = 0.5 + 1.5 a,  f = tanh(0.1 (u - a))/2

The paper integrates the tendon's force. Here the state is the length of the fiber, of which that force is a function:
the motion is the same. Unlike OpenSim's explicit form the fiber's damping takes part in the equilibrium, and the
activation is kept at 0.01 or above. Forces beyond lengths of 0.2 to 1.8 and velocities of -1 to 1 follow from the same
formulas. */
class DeGrooteFregly2016 : public MuscleModel {
public:
    /** @throws InvalidInput as DeGrooteFregly2016Parameters::validate() */
    explicit DeGrooteFregly2016(const DeGrooteFregly2016Parameters& parameters);

    const DeGrooteFregly2016Parameters& getParameters() const override { return m_parameters; }
    std::string getDescription() const override { return "De Groote, Fregly et al. (2016)"; }

    double calcActiveForceLength(double fiberLength) const override;
    double calcPassiveForceLength(double fiberLength) const override;
    double calcTendonForceLength(double tendonLength) const override;
    double calcForceVelocity(double velocity, double activation) const override;
    double calcPassiveEnergy(double fiberLength) const override;
    double calcTendonEnergy(double tendonLength) const override;
    double calcFiberVelocity(double force, double activation, double activeForceLength) const override;
    double calcActivationRate(double excitation, double activation) const override;
    double calcMinimumFiberLength() const override;

private:
    DeGrooteFregly2016Parameters m_parameters;
    double m_tendonShape;    ///< k_T
    double m_passiveOffset;  ///< of the exponential at l_min
};

}  // namespace tautline
