// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/path_points.h"

#include <algorithm>

#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

/** The room at both ends of a conditional point's range, as in the program the files come from. */
constexpr double kRangeTolerance = 1e-5;

SimTK::Vec3 calcMovingStation(const MovingLocation& moving, const BuiltModel& model, const SimTK::State& state) {
    const auto& range = model.getCoordinateSlot(moving.coordinate).range;
    const double q = std::clamp(model.getCoordinate(state, moving.coordinate), range[0], range[1]);
    Vec3 location_F;
    for (int i = 0; i < 3; ++i) location_F[i] = moving.location_F[i].calcValue(q);
    return toSimTK(moving.X_BF * location_F);
}

}  // namespace

bool isPointActive(const PathPoint& point, const BuiltModel& model, const SimTK::State& state) {
    const auto* condition = std::get_if<ConditionalLocation>(&point.kind);
    if (!condition) return true;
    const double q = model.getCoordinate(state, condition->coordinate);
    return q >= condition->range[0] - kRangeTolerance && q <= condition->range[1] + kRangeTolerance;
}

SimTK::Vec3 calcPointStation(const PathPoint& point, const BuiltModel& model, const SimTK::State& state) {
    const auto* moving = std::get_if<MovingLocation>(&point.kind);
    return moving ? calcMovingStation(*moving, model, state) : toSimTK(point.location);
}

double calcPolygonLength(const MusclePath& path, const BuiltModel& model, const SimTK::State& state) {
    double length = 0.0;
    bool started = false;
    SimTK::Vec3 previous_G(0);
    for (const PathPoint& point : path.points) {
        if (!isPointActive(point, model, state)) continue;
        const SimTK::Vec3 point_G = model.calcStationLocation(state, point.body, calcPointStation(point, model, state));
        if (started) length += (point_G - previous_G).norm();
        previous_G = point_G;
        started = true;
    }
    return length;
}

}  // namespace tautline::models
