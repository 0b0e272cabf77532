// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/wrap_binding.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"
#include "wrap_engagement.h"
#include "wrap_surface.h"

namespace tautline::models {
namespace {

/** Poses besides the default one at which engagement is looked at. */
constexpr int kNumSampledPoses = 60;
/** Of a coordinate without limits: as far as it is sampled to either side of its default. */
constexpr double kUnboundedRange = 1.0;
/** Of a driven coordinate, the time over which its motion is sampled [s]. */
constexpr double kSampledTime = 10.0;

SegmentInObject lookAtSegment(const Surface& surface, const SimTK::Transform& X_GW, const SimTK::Vec3& A_G,
                              const SimTK::Vec3& B_G) {
    return {surface, toEigen(X_GW.shiftBaseStationToFrame(A_G)), toEigen(X_GW.shiftBaseStationToFrame(B_G))};
}

/** First and last segment that the range of a wrap allows. */
std::pair<std::size_t, std::size_t> getAllowedSegments(const PathWrap& wrap, std::size_t numPoints) {
    const int last = static_cast<int>(numPoints);
    const int from = wrap.range[0] < 1 ? 1 : wrap.range[0], to = wrap.range[1] < 1 ? last : wrap.range[1];
    return {static_cast<std::size_t>(from - 1), static_cast<std::size_t>(to - 2)};
}

std::vector<SimTK::Vec3> calcPointLocations(const MusclePath& path, const BuiltModel& model,
                                            const SimTK::State& state) {
    std::vector<SimTK::Vec3> points_G;
    for (const PathPoint& point : path.points) points_G.push_back(PlacedPoint(point, model).calcLocation(state));
    return points_G;
}

/** Moves every free coordinate to a place in its range, a driven one to a place of its motion; the same sequence at
each call of bindWraps(). */
void setRandomPose(const BuiltModel& model, std::mt19937& random, SimTK::State& state) {
    for (const std::string& name : model.getCoordinateNames()) {
        const auto& slot = model.getCoordinateSlot(name);
        // mt19937's numbers are the same everywhere; those of standard distributions are not.
        const double share = random() / static_cast<double>(std::mt19937::max());
        const double low = std::isfinite(slot.range[0]) ? slot.range[0] : slot.defaultValue - kUnboundedRange;
        const double high = std::isfinite(slot.range[1]) ? slot.range[1] : slot.defaultValue + kUnboundedRange;
        if (slot.prescribedMotion)
            model.setCoordinate(state, name, slot.prescribedMotion->calcValue(share * kSampledTime));
        else if (!slot.locked)
            model.setCoordinate(state, name, low + share * (high - low));
    }
    model.applyCouplers(state);
}

/** A segment that a wrap allows. */
struct SampledSegment {
    SegmentInObject atDefault;  ///< in the default pose
    int numEngaged = 0;         ///< sampled poses in which the path wraps there
    int numPierced = 0;         ///< of those, poses in which it would pass through the object
};

/** A wrap of a path with what is seen of it over the poses. */
struct SampledWrap {
    const MusclePath* path = nullptr;
    std::size_t wrap = 0;
    const WrapObject* object = nullptr;
    std::shared_ptr<const Surface> surface;
    std::size_t firstSegment = 0;
    std::vector<SampledSegment> segments;

    const PathWrap& getWrap() const { return path->wraps[wrap]; }
};

/** Calls visit(isDefaultPose) in the default pose and in the sampled ones, with `state` realized to Position. */
template <class Visitor>
void visitSampledPoses(const BuiltModel& model, SimTK::State& state, Visitor visit) {
    std::mt19937 random(20260101);
    for (int sample = 0; sample <= kNumSampledPoses; ++sample) {
        if (sample == 0)
            model.setDefaultPose(state);
        else
            setRandomPose(model, random, state);
        model.getMatter().getSystem().realize(state, SimTK::Stage::Position);
        visit(sample == 0);
    }
}

/** What the file says of where the path runs: a point, a start, the side that the quadrant asks for, or the hole of a
ring, which a path passes in the direction in which the segment points in the default pose. */
StartHint makeHint(const SampledWrap& sampled, const SegmentInObject& atDefault) {
    const PathWrap& wrap = sampled.getWrap();
    if (wrap.hint) return PassNear{*wrap.hint};
    if (wrap.start) return PassNear{wrap.start->point};
    // A contact geometry without a hint is passed where the straight line suggests.
    if (std::holds_alternative<TorusShape>(sampled.object->shape) && !sampled.object->isContactGeometry)
        return ThreadHole{atDefault.e.z() < 0 ? -1 : 1};
    const Vector3 side = getActiveSide(sampled.object->quadrant);
    if (side.isZero()) return {};
    return PassOnSide{side};
}

/** Looks at the segments of a wrap in a pose. */
void sampleWrap(const BuiltModel& model, const SimTK::State& state, const std::vector<SimTK::Vec3>& points_G,
                bool isDefault, SampledWrap& sampled) {
    const WrapObject& object = *sampled.object;
    const SimTK::Transform X_GW = model.getBody(object.body).getBodyTransform(state) * toTransform(object.X_BW);
    for (std::size_t i = 0; i < sampled.segments.size(); ++i) {
        const std::size_t s = sampled.firstSegment + i;
        const SegmentInObject segment = lookAtSegment(*sampled.surface, X_GW, points_G[s], points_G[s + 1]);
        SampledSegment& record = sampled.segments[i];
        if (isDefault) record.atDefault = segment;
        const bool engages = isEngaged(object, segment);
        record.numEngaged += engages;
        record.numPierced += engages && segment.isPierced();
    }
}

/** The active wraps of all paths over all poses. */
std::vector<SampledWrap> sampleWraps(const ModelDescription& description, const std::vector<const MusclePath*>& paths,
                                     const BuiltModel& model, SimTK::State& state) {
    std::vector<std::shared_ptr<const Surface>> surfaces(description.wrapObjects.size());
    std::vector<SampledWrap> sampled;
    for (const MusclePath* path : paths) {
        for (std::size_t w = 0; w < path->wraps.size(); ++w) {
            const std::size_t index = path->wraps[w].wrapObject;
            const WrapObject& object = description.wrapObjects[index];
            if (!object.active) continue;
            if (!surfaces[index]) surfaces[index] = makeSurface(object);
            const auto [first, last] = getAllowedSegments(path->wraps[w], path->points.size());
            sampled.push_back(
                {path, w, &object, surfaces[index], first, std::vector<SampledSegment>(last - first + 1)});
        }
    }
    visitSampledPoses(model, state, [&](bool isDefault) {
        const MusclePath* located = nullptr;
        std::vector<SimTK::Vec3> points_G;
        for (SampledWrap& wrap : sampled) {
            if (wrap.path != located) points_G = calcPointLocations(*wrap.path, model, state);
            located = wrap.path;
            sampleWrap(model, state, points_G, isDefault, wrap);
        }
    });
    return sampled;
}

/** The segment that is engaged in most poses; of those the one nearest to the object. */
std::size_t chooseSegment(const std::vector<SampledSegment>& segments) {
    const auto isLess = [](const SampledSegment& a, const SampledSegment& b) {
        return a.numEngaged != b.numEngaged ? a.numEngaged < b.numEngaged : b.atDefault.height < a.atDefault.height;
    };
    return static_cast<std::size_t>(std::max_element(segments.begin(), segments.end(), isLess) - segments.begin());
}

/** Where the origin of the object stands along a segment, 0 to 1. */
double calcPlace(const SegmentInObject& segment) {
    return segment.length > 0 ? std::clamp(-segment.A.dot(segment.e) / segment.length, 0.0, 1.0) : 0.0;
}

/** Binds a wrap to its segments. */
void bindWrap(const SampledWrap& sampled, std::vector<BoundWrap>& bound) {
    const std::vector<SampledSegment>& segments = sampled.segments;
    const std::size_t chosen = chooseSegment(segments);
    const bool isOneSided = !getActiveSide(sampled.object->quadrant).isZero();
    const auto isBound = [&](std::size_t s) {
        return s == chosen || (isOneSided ? segments[s].numEngaged : segments[s].numPierced) > 0;
    };
    std::vector<std::size_t> alternatives;
    for (std::size_t s = 0; s < segments.size(); ++s)
        if (isOneSided && isBound(s)) alternatives.push_back(sampled.firstSegment + s);
    for (std::size_t s = 0; s < segments.size(); ++s) {
        if (!isBound(s)) continue;
        BoundWrap wrap;
        wrap.wrap = sampled.wrap;
        wrap.object = sampled.getWrap().wrapObject;
        wrap.surface = sampled.surface;
        wrap.segment = sampled.firstSegment + s;
        wrap.form = sampled.object->form;
        wrap.place = calcPlace(segments[s].atDefault);
        wrap.hint_W = makeHint(sampled, segments[s].atDefault);
        wrap.start = s == chosen ? sampled.getWrap().start : std::nullopt;
        if (alternatives.size() > 1) wrap.alternatives = alternatives;
        bound.push_back(std::move(wrap));
    }
}

}  // namespace

std::vector<std::vector<BoundWrap>> bindWraps(const ModelDescription& description,
                                              const std::vector<const MusclePath*>& paths, const BuiltModel& model,
                                              const SimTK::State& initialState) {
    SimTK::State state = initialState;
    const std::vector<SampledWrap> sampled = sampleWraps(description, paths, model, state);
    std::vector<std::vector<BoundWrap>> bound(paths.size());
    for (std::size_t p = 0; p < paths.size(); ++p) {
        for (const SampledWrap& wrap : sampled)
            if (wrap.path == paths[p]) bindWrap(wrap, bound[p]);
        const bool isListed = paths[p]->areWrapsInOrder;
        std::stable_sort(bound[p].begin(), bound[p].end(), [isListed](const BoundWrap& a, const BoundWrap& b) {
            return a.segment != b.segment ? a.segment < b.segment : !isListed && a.place < b.place;
        });
    }
    return bound;
}

}  // namespace tautline::models
