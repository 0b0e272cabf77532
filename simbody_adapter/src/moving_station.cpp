// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/moving_station.h"

#include "tautline/error.h"

namespace tautline {

using SimTK::State;
using SimTK::Vec3;

CoordinateStation::CoordinateStation(const SimTK::MobilizedBody& body, SimTK::MobilizerQIndex q,
                                     SimTK::MobilizerUIndex u, Curve calcCurve, Curve calcSlope)
    : m_body(body), m_q(q), m_u(u), m_calcCurve(std::move(calcCurve)), m_calcSlope(std::move(calcSlope)) {
    require(m_calcCurve && m_calcSlope, "coordinate station: a function is empty");
    require(m_q.isValid() && m_u.isValid(), "coordinate station: the coordinate is not valid");
}

Vec3 CoordinateStation::calcStation(const State& state) const {
    return m_calcCurve(m_body.getOneQ(state, m_q));
}

Vec3 CoordinateStation::calcVelocity(const State& state) const {
    return m_calcSlope(m_body.getOneQ(state, m_q)) * m_body.getOneU(state, m_u);
}

void CoordinateStation::addMobilityForces(const State& state, const Vec3& force_B,
                                          SimTK::Vector& mobilityForces) const {
    mobilityForces[m_body.getFirstUIndex(state) + m_u] += ~force_B * m_calcSlope(m_body.getOneQ(state, m_q));
}

}  // namespace tautline
