// SPDX-License-Identifier: Apache-2.0
#include "wrap_conditions.h"

#include <cmath>

#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"
#include "wrap_engagement.h"

namespace tautline::models {
namespace {

/** The ends of a segment of a path, or of what it is part of while points beside it are passed over, in the frame of a
wrap object. */
std::pair<Vec3, Vec3> locateSegment(const WrapObject& object, const std::vector<PathPoint>& points, std::size_t segment,
                                    const BuiltModel& model, const SimTK::State& state) {
    std::size_t before = segment, after = segment + 1;
    while (before > 0 && !isPointActive(points[before], model, state)) --before;
    while (after + 1 < points.size() && !isPointActive(points[after], model, state)) ++after;
    const SimTK::Transform X_GW = model.getBody(object.body).getBodyTransform(state) * toTransform(object.X_BW);
    const auto locate = [&](const PathPoint& point) {
        const SimTK::Transform& X_GB = model.getBody(point.body).getBodyTransform(state);
        return toEigen(X_GW.shiftBaseStationToFrame(X_GB * calcPointStation(point, model, state)));
    };
    return {locate(points[before]), locate(points[after])};
}

/** Whether the string over a cylinder touches it within its length, as far as the points beside it decide. */
std::function<bool(const SimTK::State&)> makeLengthCondition(const WrapObject& object, const MusclePath& path,
                                                             std::size_t segment, const BuiltModel& model) {
    return [object, model, points = path.points, segment](const SimTK::State& state) {
        const auto [A, B] = locateSegment(object, points, segment, model, state);
        return touchesWithinLength(std::get<CylinderShape>(object.shape), getActiveSide(object.quadrant), A, B);
    };
}

/** Whether OpenSim would let a one-sided object engage on this one of several segments. */
std::function<bool(const SimTK::State&)> makeChoiceCondition(const WrapObject& object, const MusclePath& path,
                                                             const BoundWrap& wrap, const BuiltModel& model) {
    return [object, model, points = path.points, wrap](const SimTK::State& state) {
        std::vector<SegmentInObject> segments;
        for (const std::size_t segment : wrap.alternatives) {
            const auto [A, B] = locateSegment(object, points, segment, model, state);
            segments.emplace_back(*wrap.surface, A, B);
        }
        const std::optional<std::size_t> engaged = findEngagedSegment(object, segments);
        return engaged && wrap.alternatives[*engaged] == wrap.segment;
    };
}

/** OpenSim lets paths wrap within the length of a wrap cylinder only; those of contact geometry have no end. */
bool hasEnds(const WrapObject& object) {
    const auto* cylinder = std::get_if<CylinderShape>(&object.shape);
    return cylinder && !object.isContactGeometry && std::isfinite(cylinder->length);
}

}  // namespace

std::function<bool(const SimTK::State&)> makeWrapCondition(const ModelDescription& description, const MusclePath& path,
                                                           const BoundWrap& wrap, const BuiltModel& model) {
    const WrapObject& object = description.wrapObjects[wrap.object];
    if (!wrap.alternatives.empty()) return makeChoiceCondition(object, path, wrap, model);
    if (hasEnds(object)) return makeLengthCondition(object, path, wrap.segment, model);
    return nullptr;
}

}  // namespace tautline::models
