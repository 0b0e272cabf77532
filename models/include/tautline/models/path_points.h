// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/models/model_builder.h"

namespace tautline::models {

/** Whether the point belongs to the path in this state; true but for conditional points. */
bool isPointActive(const PathPoint& point, const BuiltModel& model, const SimTK::State& state);

/** The point's coordinates in its body. */
SimTK::Vec3 calcPointStation(const PathPoint& point, const BuiltModel& model, const SimTK::State& state);

/** The length of the straight segments through the active points. Needs Stage::Position. */
double calcPolygonLength(const MusclePath& path, const BuiltModel& model, const SimTK::State& state);

}  // namespace tautline::models
