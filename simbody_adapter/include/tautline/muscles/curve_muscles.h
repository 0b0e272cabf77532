// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

#include "tautline/muscles/muscle_model.h"

namespace tautline {

/** A muscle curve that its user brings, defined for every finite argument. */
using MuscleCurve = std::function<double(double)>;

/** Muscles of SIMM, whose curves are tables: parameters that they share. Defaults are OpenSim's. */
struct CurveMuscleParameters : MuscleParameters {
    CurveMuscleParameters() {
        minimumActivation = 0;
        defaultActivation = 0;
    }
    MuscleCurve activeForceLength;                       ///< f_L; below 0 it counts as 0
    MuscleCurve passiveForceLength;                      ///< f_P; below 0 it counts as 0
    MuscleCurve tendonForceStrain;                       ///< of the tendon's strain; not asked where that is negative
    double timeScale = 0.1;                              ///< [s]; the maximal contraction velocity is l_0 in this time
    double activation1 = 7.667, activation2 = 1.459854;  ///< da/dt = (u - a)(activation1 u + activation2)/timeScale

    /** Sets the maximal contraction velocity to what the time scale says. @throws InvalidInput */
    void adopt();
};

/** What the muscles below have in common: three curves, and for u < a activation1 = 0 in da/dt (Zajac 1989, Crit. Rev.
Biomed. Eng. 17:359). Energies are integrated numerically. */
class CurveMuscle : public MuscleModel {
public:
    const CurveMuscleParameters& getParameters() const override { return m_parameters; }

    double calcActiveForceLength(double fiberLength) const override;
    double calcPassiveForceLength(double fiberLength) const override;
    double calcTendonForceLength(double tendonLength) const override;
    double calcPassiveEnergy(double fiberLength) const override;
    double calcTendonEnergy(double tendonLength) const override;
    double calcActivationRate(double excitation, double activation) const override;

protected:
    explicit CurveMuscle(const CurveMuscleParameters& parameters) : m_parameters(parameters) {}

private:
    CurveMuscleParameters m_parameters;
};

/** OpenSim's Schutte1993Muscle_Deprecated (Schutte 1992, Stanford; Schutte et al. 1993, IEEE Trans. Rehab. Eng. 1:109).
Hill's hyperbola in shortening, (1 + v)/(1 - v/0.15), in lengthening (m + 1.4 v)/(m + v) with m = 0.13 0.15/1.15, and a
damping beside it. Without a passive curve f_P = exp(8 (l - 1) - 4). */
class Schutte1993 : public CurveMuscle {
public:
    /** @throws InvalidInput naming what is missing or wrong */
    explicit Schutte1993(CurveMuscleParameters parameters);
    std::string getDescription() const override { return "Schutte (1993)"; }
    double calcForceVelocity(double velocity, double activation) const override;
};

/** OpenSim's Delp1990Muscle_Deprecated (Delp 1990, Stanford), but without the mass of 0.003 between fiber and tendon,
which takes no part in its equilibrium: fiber and tendon pull alike at any time. For a force below 0 f_V goes on
straight below -V_max. */
class Delp1990 : public CurveMuscle {
public:
    /** @param forceVelocity   f_V, ascending @throws InvalidInput naming what is missing or wrong */
    Delp1990(CurveMuscleParameters parameters, MuscleCurve forceVelocity);
    std::string getDescription() const override { return "Delp (1990), massless"; }
    double calcForceVelocity(double velocity, double activation) const override;

private:
    MuscleCurve m_forceVelocity;
};

/** OpenSim's RigidTendonMuscle: the activation is the excitation, f_P is kept at 10 or below. Its fiber's velocity is
the path's rate times the cosine of the pennation, where OpenSim leaves out the cosine. */
class RigidTendonMuscle : public CurveMuscle {
public:
    /** @param forceVelocity   f_V, ascending @throws InvalidInput naming what is missing or wrong */
    RigidTendonMuscle(CurveMuscleParameters parameters, MuscleCurve forceVelocity);
    std::string getDescription() const override { return "OpenSim's RigidTendonMuscle"; }
    double calcForceVelocity(double velocity, double activation) const override;
    double calcPassiveForceLength(double fiberLength) const override;

private:
    MuscleCurve m_forceVelocity;
};

}  // namespace tautline
