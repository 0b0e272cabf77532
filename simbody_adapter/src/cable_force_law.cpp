// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_force_law.h"

#include "cable_force_impl.h"
#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::State;

CableForceLaw::CableForceLaw(const Cable& cable) : m_cable(cable) {
    require(!cable.isEmptyHandle(), "cable force: the cable is an empty handle");
}

void CableForceLaw::ensureTopology(const State& state, const char* method) {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), SimTK::Stage(SimTK::Stage::Topology), method);
}

CableForce::CableForce(SimTK::GeneralForceSubsystem& forces, std::unique_ptr<CableForceLaw> law)
    : Custom(forces, new CableForceImpl(forces, std::move(law))) {}

const CableForceLaw& CableForce::getLaw() const {
    return dynamic_cast<const CableForceImpl&>(getImplementation()).getLaw();
}

CableForceLaw& CableForce::updLaw() {
    return dynamic_cast<CableForceImpl&>(updImplementation()).updLaw();
}

Real CableForce::getTension(const State& state) const {
    CableForceLaw::ensureTopology(state, "CableForce::getTension()");
    SimTK_STAGECHECK_GE_ALWAYS(getCable().getMatterSubsystem().getStage(state), SimTK::Stage(SimTK::Stage::Velocity),
                               "CableForce::getTension()");
    if (isDisabled(state)) return 0;
    return dynamic_cast<const CableForceImpl&>(getImplementation()).calcTension(state);
}

Real CableForce::calcPower(const State& state) const {
    const Real tension = getTension(state);
    return tension == 0 ? 0 : -tension * getCable().getLengthRate(state);
}

CableForceImpl::CableForceImpl(const SimTK::GeneralForceSubsystem& forces, std::unique_ptr<CableForceLaw> law)
    : m_forces(forces), m_law(std::move(law)) {
    require(m_law != nullptr, "cable force: the law is null");
}

Real CableForceImpl::calcTension(const State& state) const {
    if (m_law->getCable().isDisabled(state)) return 0;
    const Real tension = m_law->calcTension(state);
    return tension < 0 ? 0 : tension;  // a law that gives NaN is to be seen, not to go slack
}

void CableForceImpl::calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>& bodyForces,
                               SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobilityForces) const {
    const Real tension = calcTension(state);
    if (tension == 0) return;
    m_law->getCable().applyBodyForces(state, tension, bodyForces);
    m_law->getCable().applyMobilityForces(state, tension, mobilityForces);
}

Real CableForceImpl::calcPotentialEnergy(const State& state) const {
    return m_law->getCable().isDisabled(state) ? 0 : m_law->calcPotentialEnergy(state);
}

}  // namespace tautline
