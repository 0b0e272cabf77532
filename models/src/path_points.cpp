// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/path_points.h"

#include <algorithm>

#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

/** The room at both ends of a conditional point's range, as in the program the files come from. */
constexpr double kRangeTolerance = 1e-5;

}  // namespace

PlacedPoint::PlacedPoint(const PathPoint& point, const BuiltModel& model)
    : m_body(&model.getBody(point.body)), m_station_B(toSimTK(point.location)) {
    const auto setCoordinate = [&](const std::string& name) {
        const BuiltModel::CoordinateSlot& slot = model.getCoordinateSlot(name);
        m_coordinateBody = &model.getMatter().getMobilizedBody(slot.body), m_q = slot.q;
        m_low = slot.range[0], m_high = slot.range[1];
    };
    if (const auto* moving = std::get_if<MovingLocation>(&point.kind)) {
        m_moving = std::make_shared<const MovingLocation>(*moving);
        setCoordinate(moving->coordinate);
    } else if (const auto* condition = std::get_if<ConditionalLocation>(&point.kind)) {
        m_isConditional = true;
        setCoordinate(condition->coordinate);
        m_low = condition->range[0] - kRangeTolerance, m_high = condition->range[1] + kRangeTolerance;
    }
}

double PlacedPoint::getCoordinate(const SimTK::State& state) const {
    return m_coordinateBody->getOneQ(state, m_q);
}

bool PlacedPoint::isInRange(const SimTK::State& state) const {
    const double q = getCoordinate(state);
    return q >= m_low && q <= m_high;
}

/** Past the range of its coordinate a moving point rests. */
SimTK::Vec3 PlacedPoint::calcMoved(const SimTK::State& state) const {
    const double q = std::clamp(getCoordinate(state), m_low, m_high);
    Vector3 location_F;
    for (int i = 0; i < 3; ++i) location_F[i] = m_moving->location_F[i].calcValue(q);
    return toSimTK(m_moving->X_BF * location_F);
}

SimTK::Vec3 PlacedPoint::calcLocation(const SimTK::State& state) const {
    return m_body->findStationLocationInGround(state, calcStation(state));
}

double calcPolygonLength(const MusclePath& path, const BuiltModel& model, const SimTK::State& state) {
    double length = 0.0;
    bool started = false;
    SimTK::Vec3 previous_G(0);
    for (const PathPoint& given : path.points) {
        const PlacedPoint point(given, model);
        if (!point.isActive(state)) continue;
        const SimTK::Vec3 point_G = point.calcLocation(state);
        if (started) length += (point_G - previous_G).norm();
        previous_G = point_G;
        started = true;
    }
    return length;
}

}  // namespace tautline::models
