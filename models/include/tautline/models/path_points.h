// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "tautline/models/model_builder.h"

namespace tautline::models {

/** A point of a path in a built model, which is found there by its indices: asking where it is looks up no names. The
matter subsystem must outlive it. */
class PlacedPoint {
public:
    /** @throws ModelError if the model has not its body or its coordinate */
    PlacedPoint(const PathPoint& point, const BuiltModel& model);

    bool isConditional() const { return m_isConditional; }
    /** Whether the point belongs to the path in this state; true but for conditional points. */
    bool isActive(const SimTK::State& state) const { return !m_isConditional || isInRange(state); }
    /** The point's coordinates in its body. */
    SimTK::Vec3 calcStation(const SimTK::State& state) const { return m_moving ? calcMoved(state) : m_station_B; }
    /** In ground. Stage: Position, of the matter subsystem. */
    SimTK::Vec3 calcLocation(const SimTK::State& state) const;

private:
    bool isInRange(const SimTK::State& state) const;
    SimTK::Vec3 calcMoved(const SimTK::State& state) const;
    double getCoordinate(const SimTK::State& state) const;

    const SimTK::MobilizedBody* m_body;
    SimTK::Vec3 m_station_B;
    bool m_isConditional = false;
    std::shared_ptr<const MovingLocation> m_moving;  ///< null: it stands at m_station_B
    // The coordinate that moves it or decides about it.
    const SimTK::MobilizedBody* m_coordinateBody = nullptr;
    SimTK::MobilizerQIndex m_q;
    double m_low = 0, m_high = 0;  ///< of its range, or of the point's
};

/** The length of the straight segments through the active points. Needs Stage::Position. */
double calcPolygonLength(const MusclePath& path, const BuiltModel& model, const SimTK::State& state);

}  // namespace tautline::models
