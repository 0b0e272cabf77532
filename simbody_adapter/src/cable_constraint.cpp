// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_constraint.h"

#include <cmath>
#include <set>

#include "cable_path_subsystem_impl.h"
#include "tautline/error.h"

namespace tautline {

using SimTK::Array_;
using SimTK::ConstrainedBodyIndex;
using SimTK::ConstrainedQIndex;
using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::State;

namespace {

class FixedLength : public SimTK::Constraint::Custom::Implementation {
public:
    FixedLength(SimTK::SimbodyMatterSubsystem& matter, const Cable& cable, Real length)
        : Implementation(matter, 1, 0, 0), m_cable(cable), m_length(length), m_numElements(cable.getNumElements()) {
        addConstrainedBody(matter.Ground());  // so that what is called the ancestor is ground
        std::set<SimTK::MobilizedBodyIndex> bodies{SimTK::GroundIndex};
        for (CableElementIndex e(0); e < m_numElements; ++e) {
            const SimTK::MobilizedBodyIndex body = cable.getElementBody(e);
            if (bodies.insert(body).second) addConstrainedBody(matter.updMobilizedBody(body));
        }
    }

    const Cable& getCable() const { return m_cable; }
    Real getLength() const { return m_length; }

    Implementation* clone() const override { return new FixedLength(*this); }

    void realizeTopology(State&) const override {
        require(m_cable.getNumElements() == m_numElements, "cable constraint on cable '", m_cable.getName(),
                "': ", m_cable.getNumElements() - m_numElements, " elements were added after it");
    }

    /** The path is solved for the poses of the State, which are those given. */
    void calcPositionErrors(const State& state, const Array_<SimTK::Transform, ConstrainedBodyIndex>&,
                            const Array_<Real, ConstrainedQIndex>&, Array_<Real>& perr) const override {
        SimTK_ERRCHK1_ALWAYS(
            !m_cable.isDisabled(state), "CableConstraint",
            "the constraint on cable '%s' is enabled, but the cable is disabled in this State: disable "
            "the constraint too",
            m_cable.getName().c_str());
        dynamic_cast<const CablePathSubsystemImpl&>(m_cable.getSubsystem().getSubsystemGuts())
            .realizePositionOfPlacedBodies(state);
        perr[0] = m_cable.getLength(state) - m_length;
    }

    void calcPositionDotErrors(const State& state, const Array_<SpatialVec, ConstrainedBodyIndex>& V_GB,
                               const Array_<Real, ConstrainedQIndex>&, Array_<Real>& pverr) const override {
        pverr[0] = -calcUnitPower(state, V_GB);
    }

    void calcPositionDotDotErrors(const State& state, const Array_<SpatialVec, ConstrainedBodyIndex>& A_GB,
                                  const Array_<Real, ConstrainedQIndex>&, Array_<Real>& paerr) const override {
        paerr[0] = m_cable.getLengthAccelerationBias(state) - calcUnitPower(state, A_GB);
    }

    /** Simbody subtracts what is added here: the error's derivative is minus the unit forces. */
    void addInPositionConstraintForces(const State& state, const Array_<Real>& multipliers,
                                       Array_<SpatialVec, ConstrainedBodyIndex>& bodyForces_G,
                                       Array_<Real, ConstrainedQIndex>&) const override {
        SimTK::Vector_<SpatialVec> F_G;
        m_cable.calcUnitBodyForces(state, F_G);
        for (ConstrainedBodyIndex b(0); b < bodyForces_G.size(); ++b)
            bodyForces_G[b] -= multipliers[0] * F_G[getMobilizedBodyIndexOfConstrainedBody(b)];
    }

private:
    /** Product of the unit forces with velocities or accelerations. */
    Real calcUnitPower(const State& state, const Array_<SpatialVec, ConstrainedBodyIndex>& V_GB) const {
        SimTK::Vector_<SpatialVec> F_G;
        m_cable.calcUnitBodyForces(state, F_G);
        Real power = 0;
        for (ConstrainedBodyIndex b(0); b < V_GB.size(); ++b)
            power += ~F_G[getMobilizedBodyIndexOfConstrainedBody(b)] * V_GB[b];
        return power;
    }

    Cable m_cable;
    Real m_length;
    int m_numElements;
};

FixedLength* makeFixedLength(SimTK::SimbodyMatterSubsystem& matter, const Cable& cable, Real length) {
    require(!cable.isEmptyHandle(), "cable constraint: the cable is an empty handle");
    require(matter.isSameSubsystem(cable.getMatterSubsystem()), "cable constraint on cable '", cable.getName(),
            "': the cable's bodies belong to another matter subsystem");
    require(std::isfinite(length) && length > 0, "cable constraint on cable '", cable.getName(),
            "': the length must be positive and finite, but is ", length);
    require(!cable.hasMovingPoints(), "cable constraint on cable '", cable.getName(),
            "': moving and conditional points are not supported");
    return new FixedLength(matter, cable, length);
}

}  // namespace

CableConstraint::CableConstraint(SimTK::SimbodyMatterSubsystem& matter, const Cable& cable, Real length)
    : Custom(makeFixedLength(matter, cable, length)) {}

const Cable& CableConstraint::getCable() const {
    return dynamic_cast<const FixedLength&>(getImplementation()).getCable();
}

Real CableConstraint::getLength() const {
    return dynamic_cast<const FixedLength&>(getImplementation()).getLength();
}

Real CableConstraint::getTension(const State& state) const {
    SimTK_STAGECHECK_GE_ALWAYS(state.getSystemStage(), SimTK::Stage(SimTK::Stage::Topology),
                               "CableConstraint::getTension()");
    // A host that was built for Release checks no stage by itself.
    SimTK_STAGECHECK_GE_ALWAYS(getMatterSubsystem().getStage(state), SimTK::Stage(SimTK::Stage::Acceleration),
                               "CableConstraint::getTension()");
    return isDisabled(state) ? 0 : getMultipliersAsVector(state)[0];
}

}  // namespace tautline
