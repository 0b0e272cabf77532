// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>

#include "tautline/simbody/cable.h"

namespace tautline {

/** How tense a cable is: derive from it to write a tension law and hand it to a CableForce. A law
that keeps variables of its own allocates them in the force subsystem in realizeTopology(). */
class CableForceLaw {
public:
    /** @throws InvalidInput for an empty handle */
    explicit CableForceLaw(const Cable& cable);
    virtual ~CableForceLaw() = default;

    const Cable& getCable() const { return m_cable; }

    /** Tension [N]; what is below zero counts as zero, for a string cannot push. Stage: Velocity. Not
    called while the cable is disabled. */
    virtual SimTK::Real calcTension(const SimTK::State& state) const = 0;

    /** Energy stored [J]. Stage: Position. Not called while the cable is disabled. */
    virtual SimTK::Real calcPotentialEnergy(const SimTK::State&) const { return 0; }

    /** Allocate discrete variables and z's here, with the methods of `forces`. */
    virtual void realizeTopology(SimTK::State&, const SimTK::Subsystem& /*forces*/) {}

    /** For methods that read or change the law's own variables. @throws Simbody's stage error unless the System has
    been realized to Topology in this State */
    static void ensureTopology(const SimTK::State& state, const char* method);

    /** Set the derivatives of the law's own z's: forces.updZDot(state)[...]. Stage: Dynamics. */
    virtual void realizeDerivatives(const SimTK::State&, const SimTK::Subsystem& /*forces*/) const {}

private:
    Cable m_cable;
};

/** A force element that pulls at a cable with the tension of a law. */
class CableForce : public SimTK::Force::Custom {
public:
    CableForce() = default;
    /** @throws InvalidInput for a null law */
    CableForce(SimTK::GeneralForceSubsystem& forces, std::unique_ptr<CableForceLaw> law);

    const Cable& getCable() const { return getLaw().getCable(); }
    const CableForceLaw& getLaw() const;

    /** Tension [N], never negative, 0 while cable or force is disabled. Stage: Velocity. */
    SimTK::Real getTension(const SimTK::State& state) const;
    /** Power that the force puts into the bodies [W]: -tension * length rate. Stage: Velocity. */
    SimTK::Real calcPower(const SimTK::State& state) const;

protected:
    CableForceLaw& updLaw();
};

}  // namespace tautline
