// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "tautline/models/model_builder.h"
#include "tautline/paths/start_hint.h"
#include "tautline/surfaces/surface.h"

namespace tautline::models {

/** A wrap object of a path, bound to one of its segments. A model file lets a path wrap anywhere between the points of
a range, while an obstacle has its place in the order of the path. An object without a quadrant that the path would pass
through on several segments, in one pose or another, is bound to each of them; one with a quadrant to each segment on
which it engages in some pose, but takes part on one at a time. */
struct BoundWrap {
    /** Index into MusclePath::wraps. */
    std::size_t wrap = 0;
    /** Index into ModelDescription::wrapObjects. */
    std::size_t object = 0;
    /** One for all paths over the object. */
    std::shared_ptr<const Surface> surface;
    /** Between points `segment` and `segment + 1`, counted from 0. */
    std::size_t segment = 0;
    SurfaceForm form = SurfaceForm::Implicit;
    /** Where the object stands along the segment in the default pose, 0 to 1: the order of several. */
    double place = 0.0;
    /** A point that the file gives, the side that the quadrant asks for, or once through the hole of a ring, in the
    object's frame; nothing for all. */
    StartHint hint_W;
    /** A geodesic that the file gives. */
    std::optional<WrapStart> start;
    /** Of a one-sided object that is bound to several segments: all of them. It takes part on one at a time, on which
    OpenSim's rule decides pose by pose. */
    std::vector<std::size_t> alternatives;
};

/** Binds the active wrap objects of paths, those of each path sorted by their place. An object is bound to the segment
on which it is engaged in most of the poses sampled: the default and others over the coordinates' ranges, the same at
each call; one that is never engaged, to the segment nearest to it. It is bound, too, to every
other segment that passes through it in a pose, or, with a quadrant, on which it engages in one.

@param state   of the system in which `model` was built; realized to Model */
std::vector<std::vector<BoundWrap>> bindWraps(const ModelDescription& description,
                                              const std::vector<const MusclePath*>& paths, const BuiltModel& model,
                                              const SimTK::State& state);

}  // namespace tautline::models
