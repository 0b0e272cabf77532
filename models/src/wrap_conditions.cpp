// SPDX-License-Identifier: Apache-2.0
#include "wrap_conditions.h"

#include <algorithm>
#include <cmath>

#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"
#include "wrap_engagement.h"

namespace tautline::models {
namespace {

/** A segment of a path seen from a wrap object, or what it is part of while points beside it are passed over. */
class PlacedSegment {
public:
    PlacedSegment(const WrapObject& object, const MusclePath& path, std::size_t segment, const BuiltModel& model)
        : m_body(&model.getBody(object.body)), m_X_BW(toTransform(object.X_BW)) {
        std::size_t before = segment, after = segment + 1;
        while (addPoint(path.points[before], model, m_before) && before > 0) --before;
        while (addPoint(path.points[after], model, m_after) && after + 1 < path.points.size()) ++after;
    }

    /** Its ends in the frame of the object. */
    std::pair<Vector3, Vector3> locate(const SimTK::State& state) const {
        const SimTK::Transform X_GW = m_body->getBodyTransform(state) * m_X_BW;
        const auto locateNearest = [&](const std::vector<PlacedPoint>& points) {
            std::size_t p = 0;
            while (p + 1 < points.size() && !points[p].isActive(state)) ++p;
            return toEigen(X_GW.shiftBaseStationToFrame(points[p].calcLocation(state)));
        };
        return {locateNearest(m_before), locateNearest(m_after)};
    }

private:
    /** @return whether the point may be passed over, so that the next one counts too */
    static bool addPoint(const PathPoint& point, const BuiltModel& model, std::vector<PlacedPoint>& points) {
        points.emplace_back(point, model);
        return points.back().isConditional();
    }

    const SimTK::MobilizedBody* m_body;
    SimTK::Transform m_X_BW;
    std::vector<PlacedPoint> m_before, m_after;  ///< from the segment on, up to one that is always there
};

/** Whether the string over a cylinder touches it within its length, as far as the points beside it decide. */
std::function<bool(const SimTK::State&)> makeLengthCondition(const WrapObject& object, const MusclePath& path,
                                                             std::size_t segment, const BuiltModel& model) {
    return [cylinder = std::get<CylinderShape>(object.shape), side = getActiveSide(object.quadrant),
            placed = PlacedSegment(object, path, segment, model)](const SimTK::State& state) {
        const auto [A, B] = placed.locate(state);
        return touchesWithinLength(cylinder, side, A, B);
    };
}

/** Whether OpenSim would let a one-sided object engage on this one of several segments. */
std::function<bool(const SimTK::State&)> makeChoiceCondition(const WrapObject& object, const MusclePath& path,
                                                             const BoundWrap& wrap, const BuiltModel& model) {
    std::vector<PlacedSegment> alternatives;
    for (const std::size_t segment : wrap.alternatives) alternatives.emplace_back(object, path, segment, model);
    const auto at = std::find(wrap.alternatives.begin(), wrap.alternatives.end(), wrap.segment);
    const auto own = static_cast<std::size_t>(at - wrap.alternatives.begin());
    return [object, wrap, alternatives, own](const SimTK::State& state) {
        const auto look = [&](std::size_t i) {
            const auto [A, B] = alternatives[i].locate(state);
            return SegmentInObject(*wrap.surface, A, B);
        };
        if (!isEngaged(object, look(own))) return false;  // most are not
        std::vector<SegmentInObject> segments;
        for (std::size_t i = 0; i < alternatives.size(); ++i) segments.push_back(look(i));
        return findEngagedSegment(object, segments) == own;
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
