// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Muscles without bodies: the laws of fiber, tendon and activation. No Simbody in here.

In these headers lengths of the fiber are in optimal fiber lengths l_0, of the tendon in its slack length l_S, forces in
the maximal isometric force F_0, velocities of the fiber in its maximal contraction velocity V_max (positive in
lengthening), energies in F_0 l_0 and F_0 l_S, except where a unit is given. */
#include <string>

namespace tautline {

/** What every muscle model has. */
struct MuscleParameters {
    double maxIsometricForce = 1000;               ///< F_0 [N]
    double optimalFiberLength = 0.1;               ///< l_0 [m]
    double tendonSlackLength = 0.2;                ///< l_S [m]; 0: no tendon
    double pennationAtOptimal = 0;                 ///< alpha_0 at fiber length l_0 [rad], in [0, pi/2)
    double maxContractionVelocity = 10;            ///< V_max [l_0/s]
    double maximumPennation = 1.4706289056333368;  ///< acos(0.1) [rad]; the fiber gets no shorter than there
    double activationTime = 0.010;                 ///< time constant while excitation > activation [s]
    double deactivationTime = 0.040;               ///< time constant else [s]
    double minimumActivation = 0.01;               ///< in [0, 1)
    double defaultActivation = 0.05;               ///< in [0, 1]
    double defaultExcitation = 0;                  ///< in [0, 1]
    double fiberDamping = 0;                       ///< beta: adds beta v to the force of the fiber
    bool ignoresTendonCompliance = false;
    bool ignoresActivationDynamics = false;  ///< the activation is the excitation

    /** @throws InvalidInput naming the parameter and its value */
    void validate() const;
};

/** Where fiber and tendon are. */
struct MuscleLengths {
    double fiberLength = 0;      ///< [m]
    double normFiberLength = 0;  ///< [l_0]
    double sinPennation = 0;
    double cosPennation = 1;
    double tendonLength = 0;  ///< [m]: what is left of the path; below the slack length the tendon is slack

    double calcPennation() const;  ///< [rad]
};

/** What a muscle does at one instant, in SI units. The forces of the fiber act along the fiber. Powers are positive
where a part gives energy to the path; fiber and tendon add up to the whole: fiberActivePower + fiberPassivePower +
fiberDampingPower + tendonPower = musclePower = -tendonForce * rate of the path's length. */
struct MuscleDynamics {
    MuscleLengths lengths;
    double activation = 0;
    double fiberVelocity = 0;                                                   ///< [m/s], positive in lengthening
    double normFiberVelocity = 0;                                               ///< [V_max]
    double tendonVelocity = 0;                                                  ///< [m/s]
    double activeFiberForce = 0, passiveFiberForce = 0, dampingFiberForce = 0;  ///< [N]
    double tendonForce = 0;                                                     ///< [N], never negative
    double fiberActivePower = 0, fiberPassivePower = 0, fiberDampingPower = 0;  ///< [W]
    double tendonPower = 0, musclePower = 0;                                    ///< [W]
    /** The fiber is as short as it can be and does not lengthen: its velocity is zero. */
    bool isFiberAtLimit = false;

    double calcFiberForce() const { return activeFiberForce + passiveFiberForce + dampingFiberForce; }
};

/** What is stored in the elasticity of a muscle [J]; its rates are -fiberPassivePower and -tendonPower. */
struct MuscleEnergy {
    double fiber = 0, tendon = 0;
};

enum class EquilibriumStatus {
    Found,             ///< fiber and tendon pull alike
    FiberAtLowerBound  ///< the fiber is as short as it can be and would be shorter still; the tendon may be slack
};
std::string getName(EquilibriumStatus status);

struct MuscleEquilibrium {
    double fiberLength = 0;  ///< [m]
    double tendonForce = 0;  ///< [N]
    EquilibriumStatus status = EquilibriumStatus::Found;
};

/** A muscle of Hill's type: a fiber (active, elastic and damping parts side by side) in line with a tendon,

    (a f_L(l) f_V(v) + f_P(l) + beta v) cos(alpha) = f_T(l_T),   path length = l_0 l cos(alpha) + l_S l_T,

with a pennation alpha that keeps the fiber's height, l sin(alpha) = sin(alpha_0) (Zajac 1989, Crit. Rev. Biomed. Eng.
17:359). The tendon is elastic or rigid (l_T = 1). Derive from it for a muscle of your own: the four curves and the two
integrals are required, what can be deduced from them is. All functions are defined for every finite argument, and none
gives NaN. */
class MuscleModel {
public:
    virtual ~MuscleModel() = default;

    virtual const MuscleParameters& getParameters() const = 0;
    /** By its authors and year, for tables and notes. */
    virtual std::string getDescription() const = 0;

    // The curves.
    virtual double calcActiveForceLength(double fiberLength) const = 0;   ///< f_L
    virtual double calcPassiveForceLength(double fiberLength) const = 0;  ///< f_P
    virtual double calcTendonForceLength(double tendonLength) const = 0;  ///< f_T, not below 0
    /** f_V. Of the others only Thelen's depends on activation. */
    virtual double calcForceVelocity(double velocity, double activation) const = 0;
    virtual double calcPassiveEnergy(double fiberLength) const = 0;  ///< integral of f_P from where it begins
    virtual double calcTendonEnergy(double tendonLength) const = 0;  ///< integral of f_T from 1

    /** v at which a f_L f_V(v) + beta v is `force`; by bracketing unless a model knows better. What would be beyond
    +-kFastest is that. */
    virtual double calcFiberVelocity(double force, double activation, double activeForceLength) const;
    /** da/dt [1/s]. By default (u - a)/tau with tau = activation time (0.5 + 1.5 a) if u > a, else deactivation time
    / (0.5 + 1.5 a) (Thelen 2003, J. Biomech. Eng. 125:70, Eqns. 1 and 2). */
    virtual double calcActivationRate(double excitation, double activation) const;
    /** The least fiber length [l_0]: by default that at the maximal pennation. */
    virtual double calcMinimumFiberLength() const;

    /** Whether the fiber is what the path leaves of it: compliance is ignored, or there is no tendon. */
    bool hasRigidTendon() const;
    /** Within [minimum activation, 1]. */
    double clampActivation(double activation) const;

    /** Lengths on a path. @param pathLength   [m] @param fiberLength   [m], of a compliant tendon; clamped */
    MuscleLengths calcLengths(double pathLength, double fiberLength) const;
    /** All that a muscle does. @param pathLength   [m] @param pathRate   [m/s] @param fiberLength   as above */
    MuscleDynamics calcDynamics(double pathLength, double pathRate, double activation, double fiberLength) const;
    MuscleEnergy calcEnergy(const MuscleLengths& lengths) const;
    /** At rest (f_V = 1): of several equilibria the one to which the fiber creeps from a tendon stretched by 1 %,
    which is where OpenSim's search begins, too. Found by bracketing, so that there always is an answer. */
    MuscleEquilibrium findEquilibrium(double pathLength, double activation) const;

    static constexpr double kFastest = 1e4;  ///< [V_max]

private:
    double calcSteepestSine() const;
    double calcExcessPull(double pathLength, double activation, double fiberLength) const;
    double settleFiber(double pathLength, double activation) const;
    void calcCompliant(double fiberLength, MuscleDynamics& dynamics) const;
    void calcRigid(double pathRate, MuscleDynamics& dynamics) const;
};

}  // namespace tautline
