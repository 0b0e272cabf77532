// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** Applies a law's tension to the bodies along its cable. */
class CableForceImpl : public SimTK::Force::Custom::Implementation {
public:
    CableForceImpl(const SimTK::GeneralForceSubsystem& forces, std::unique_ptr<CableForceLaw> law);

    const CableForceLaw& getLaw() const { return *m_law; }
    CableForceLaw& updLaw() { return *m_law; }
    SimTK::Real calcTension(const SimTK::State& state) const;

    void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& bodyForces,
                   SimTK::Vector_<SimTK::Vec3>& particleForces, SimTK::Vector& mobilityForces) const override;
    SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override;
    bool dependsOnlyOnPositions() const override { return false; }
    void realizeTopology(SimTK::State& state) const override { m_law->realizeTopology(state, m_forces); }
    void realizeAcceleration(const SimTK::State& state) const override { m_law->realizeDerivatives(state, m_forces); }

private:
    const SimTK::GeneralForceSubsystem& m_forces;
    std::unique_ptr<CableForceLaw> m_law;
};

}  // namespace tautline
