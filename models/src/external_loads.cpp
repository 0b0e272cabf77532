// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/external_loads.h"

#include <algorithm>
#include <optional>

namespace tautline::models {
namespace {

using SimTK::State;
using SimTK::Vec3;

/** A vector over time, held at its ends. */
class VectorOfTime {
public:
    VectorOfTime(const TimeSeries& data, const std::vector<std::size_t>& columns) {
        std::vector<double> times;
        for (const std::vector<double>& row : data.rows) times.push_back(row[0]);
        m_begin = times.front();
        m_end = times.back();
        for (std::size_t i = 0; i < 3; ++i) {
            std::vector<double> values;
            for (const std::vector<double>& row : data.rows) values.push_back(row[columns[i]]);
            m_components[i] = interpolate(times, std::move(values));
        }
    }

    Vec3 calcValue(double time) const {
        const double t = std::clamp(time, m_begin, m_end);
        return {m_components[0].calcValue(t), m_components[1].calcValue(t), m_components[2].calcValue(t)};
    }

private:
    static ScalarFunction interpolate(const std::vector<double>& times, std::vector<double> values) {
        if (times.size() == 1) return ScalarFunction::constant(values[0]);
        return times.size() < 4 ? ScalarFunction::piecewiseLinear(times, std::move(values))
                                : ScalarFunction::simmSpline(times, std::move(values));
    }

    double m_begin = 0.0, m_end = 0.0;
    std::array<ScalarFunction, 3> m_components;
};

/** The three columns whose labels begin with an identifier; none for an empty one. */
std::optional<VectorOfTime> findVector(const ExternalLoads& loads, const ExternalForce& force, const TimeSeries& data,
                                       const std::string& identifier) {
    if (identifier.empty()) return std::nullopt;
    std::vector<std::size_t> columns;
    for (std::size_t i = 1; i < data.labels.size(); ++i)
        if (data.labels[i].rfind(identifier, 0) == 0) columns.push_back(i);
    if (columns.size() != 3) {
        throw ModelError(loads.fileName, force.line,
                         "ExternalForce '" + force.name + "': " + std::to_string(columns.size()) +
                             " columns begin with '" + identifier + "' instead of 3");
    }
    return VectorOfTime(data, columns);
}

/** Force at a point and torque on one body. */
class MeasuredForce : public SimTK::Force::Custom::Implementation {
public:
    MeasuredForce(const ExternalLoads& loads, const ExternalForce& force, const TimeSeries& data,
                  const BuiltModel& model)
        : m_model(model),
          m_given(force),
          m_force(findVector(loads, force, data, force.forceIdentifier)),
          m_point(findVector(loads, force, data, force.pointIdentifier)),
          m_torque(findVector(loads, force, data, force.torqueIdentifier)) {}

    void calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>& bodyForces, SimTK::Vector_<Vec3>&,
                   SimTK::Vector&) const override {
        const SimTK::MobilizedBody& body = m_model.getBody(m_given.body);
        const SimTK::Rotation& R_GF = m_model.getBody(m_given.forceFrame).getBodyRotation(state);
        const double time = state.getTime();
        if (m_force) {
            const Vec3 station_B = m_point ? body.findStationAtGroundPoint(state, calcPoint_G(state)) : Vec3(0);
            body.applyForceToBodyPoint(state, station_B, R_GF * m_force->calcValue(time), bodyForces);
        }
        if (m_torque) body.applyBodyTorque(state, R_GF * m_torque->calcValue(time), bodyForces);
    }
    SimTK::Real calcPotentialEnergy(const State&) const override { return 0; }

private:
    Vec3 calcPoint_G(const State& state) const {
        return m_model.calcStationLocation(state, m_given.pointFrame, m_point->calcValue(state.getTime()));
    }

    BuiltModel m_model;
    ExternalForce m_given;
    std::optional<VectorOfTime> m_force, m_point, m_torque;
};

}  // namespace

void addExternalLoads(const ExternalLoads& loads, const TimeSeries& data, const BuiltModel& model,
                      SimTK::GeneralForceSubsystem& forces) {
    if (data.rows.empty()) throw ModelError(loads.fileName + ": its table '" + loads.dataFile + "' has no rows");
    for (const ExternalForce& force : loads.forces) {
        SimTK::Force::Custom added(forces, new MeasuredForce(loads, force, data, model));
        if (!force.appliesForce) added.setDisabledByDefault(true);
    }
}

}  // namespace tautline::models
