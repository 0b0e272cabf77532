// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_measures.h"

#include <functional>
#include <utility>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;
using SimTK::Stage;
using SimTK::State;

namespace {

using Query = std::function<Real(const State&)>;

/** A number that is computed from a State, and its first derivative if there is one. */
class QueryMeasure : public SimTK::Measure::Implementation {
public:
    QueryMeasure(Stage stage, Query value, Query derivative = nullptr)
        : SimTK::Measure::Implementation(Real(0), derivative ? 2 : 1),
          m_stage(stage),
          m_value(std::move(value)),
          m_derivative(std::move(derivative)) {}

    SimTK::AbstractMeasure::Implementation* cloneVirtual() const override { return new QueryMeasure(*this); }
    int getNumTimeDerivativesVirtual() const override { return m_derivative ? 1 : 0; }
    Stage getDependsOnStageVirtual(int order) const override { return order == 0 ? m_stage : m_stage.next(); }
    void calcCachedValueVirtual(const State& state, int order, Real& value) const override {
        value = order == 0 ? m_value(state) : m_derivative(state);
    }

private:
    Stage m_stage;
    Query m_value, m_derivative;
};

const Cable& requireCable(const Cable& cable) {
    require(!cable.isEmptyHandle(), "cable measure: the cable is an empty handle");
    return cable;
}

const CableForce& requireForce(const CableForce& force) {
    require(!force.isEmptyHandle(), "cable measure: the force is an empty handle");
    return force;
}

QueryMeasure* makeLengthMeasure(const Cable& cable) {
    return new QueryMeasure(
        Stage::Position, [cable](const State& state) { return cable.getLength(state); },
        [cable](const State& state) { return cable.getLengthRate(state); });
}

QueryMeasure* makeRateMeasure(const Cable& cable) {
    return new QueryMeasure(Stage::Velocity, [cable](const State& state) { return cable.getLengthRate(state); });
}

QueryMeasure* makeTensionMeasure(const CableForce& force) {
    return new QueryMeasure(Stage::Velocity, [force](const State& state) { return force.getTension(state); });
}

}  // namespace

CableLengthMeasure::CableLengthMeasure(SimTK::Subsystem& subsystem, const Cable& cable)
    : SimTK::Measure_<Real>(subsystem, makeLengthMeasure(requireCable(cable)), SetHandle()) {}

CableRateMeasure::CableRateMeasure(SimTK::Subsystem& subsystem, const Cable& cable)
    : SimTK::Measure_<Real>(subsystem, makeRateMeasure(requireCable(cable)), SetHandle()) {}

CableTensionMeasure::CableTensionMeasure(SimTK::Subsystem& subsystem, const CableForce& force)
    : SimTK::Measure_<Real>(subsystem, makeTensionMeasure(requireForce(force)), SetHandle()) {}

}  // namespace tautline
