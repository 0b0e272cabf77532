// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** What a HillMuscle is made of. Defaults are typical (see there for their sources); isometric force, fiber and tendon
 * lengths are not. */
struct HillMuscleParameters {
    SimTK::Real maxIsometricForce = 1000;     ///< F_0 [N]
    SimTK::Real optimalFiberLength = 0.1;     ///< l_0 [m]
    SimTK::Real tendonSlackLength = 0.2;      ///< l_T [m]: of the rigid tendon
    SimTK::Real pennationAtOptimal = 0;       ///< of the fiber at its optimal length [rad], in [0, pi/2)
    SimTK::Real maxContractionVelocity = 10;  ///< in optimal fiber lengths per second
    SimTK::Real activationTime = 0.01;        ///< time constant while excitation > activation [s]
    SimTK::Real deactivationTime = 0.04;      ///< time constant else [s]
    SimTK::Real activeWidth = 0.45;           ///< gamma of the active force-length curve
    SimTK::Real passiveStrain = 0.6;          ///< fiber strain at which the passive force is F_0
    SimTK::Real passiveShape = 4;             ///< k of the exponential passive curve
    SimTK::Real concentricShape = 0.25;       ///< a of Hill's hyperbola, in F_0
    SimTK::Real eccentricForce = 1.4;         ///< limit of the force-velocity curve in lengthening
    SimTK::Real defaultExcitation = 0;        ///< in [0, 1]
    SimTK::Real defaultActivation = 0;        ///< in [0, 1]

    /** @throws InvalidInput naming the parameter and its value */
    void validate() const;
};

/** Characteristic curves, all dimensionless. */
SimTK::Real calcActiveForceLength(const HillMuscleParameters& parameters, SimTK::Real fiberLength);
SimTK::Real calcPassiveForceLength(const HillMuscleParameters& parameters, SimTK::Real fiberLength);
/** @param velocity   of the fiber in maximal contraction velocities, positive in lengthening */
SimTK::Real calcForceVelocity(const HillMuscleParameters& parameters, SimTK::Real velocity);

/** A muscle of Hill's type with a rigid tendon along a cable. With fiber length l and velocity v (both
normalized), pennation alpha and activation a, thickness l sin(alpha) being constant:

    l_0 l cos(alpha) = cable length - l_T,   tension = F_0 (a f_L(l) f_V(v) + f_P(l)) cos(alpha),
    da/dt = (u - a)/tau,   tau = activation time if u > a, else deactivation time.

    f_L = exp(-(l - 1)^2 / gamma)
    f_P = (exp(k (l - 1)/strain) - 1)/(exp(k) - 1) for l > 1, else 0
    f_V = (1 + v)/(1 - v/a_H) for -1 <= v <= 0 (0 below), 1 + (f_max - 1) v/(v + c) above 0, with the
          same slope on both sides of 0.

Where this is from: the model is of Zajac's kind (1989, Crit. Rev. Biomed. Eng. 17:359) with a rigid tendon. f_L and its
gamma, the form of f_P, its strain and f_max are Thelen's (2003, J. Biomech. Eng. 125:70, Eqns. 3 and 4, young adults);
k = 4 is that of De Groote et al. (2016, Ann. Biomed. Eng. 44:2922), where Thelen has 5. f_V in shortening is Hill's
hyperbola (1938) with Thelen's A_f = 0.25 for a_H, which is his curve at full activation; here it does not depend on
activation, and it goes on in lengthening as the hyperbola of equal slope. The activation obeys a plain first-order law
with two time constants, 10 ms and 40 ms as is customary (Thelen: 15 ms and 50 ms, and dependent on activation). There
is no damping of the fiber and no curve of the tendon: this is not OpenSim's Thelen2003Muscle.

A cable shorter than the tendon is slack. One z (the activation); the excitation u is a discrete variable
of the State or a function. */
class HillMuscle : public CableForce {
public:
    HillMuscle() = default;
    /** @throws InvalidInput as HillMuscleParameters::validate() */
    HillMuscle(SimTK::GeneralForceSubsystem& forces, const Cable& cable, const HillMuscleParameters& parameters);

    const HillMuscleParameters& getParameters() const;

    /** Excitation as a function of a State realized to Time, clipped to [0, 1], in place of the State's
    own. Before realizeTopology(). */
    void setExcitationFunction(std::function<SimTK::Real(const SimTK::State&)> calcExcitation);

    /** @throws InvalidInput unless in [0, 1], or if there is a function. Stage: Topology; invalidates Dynamics. */
    void setExcitation(SimTK::State& state, SimTK::Real excitation) const;
    /** Stage: Time. */
    SimTK::Real getExcitation(const SimTK::State& state) const;

    /** @throws InvalidInput unless in [0, 1]. Stage: Model. */
    void setActivation(SimTK::State& state, SimTK::Real activation) const;
    /** Stage: Model. */
    SimTK::Real getActivation(const SimTK::State& state) const;

    /** [m]. Stage: Position. */
    SimTK::Real getFiberLength(const SimTK::State& state) const;
    /** [rad]. Stage: Position. */
    SimTK::Real getPennation(const SimTK::State& state) const;
    /** [m/s], positive in lengthening. Stage: Velocity. */
    SimTK::Real getFiberVelocity(const SimTK::State& state) const;
};

}  // namespace tautline
