// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/models/model_builder.h"
#include "tautline/paths/start_hint.h"

namespace tautline::models {

/** A wrap object of a path, bound to one of its segments. A model file lets a path wrap anywhere between the points of
a range; over a motion it does so on one segment, and an obstacle has its place in the order of the path. */
struct BoundWrap {
    /** Index into MusclePath::wraps. */
    std::size_t wrap = 0;
    /** Between points `segment` and `segment + 1`, counted from 0. */
    std::size_t segment = 0;
    SurfaceForm form = SurfaceForm::Implicit;
    /** Where the object stands along the segment in the default pose, 0 to 1: the order of several. */
    double place = 0.0;
    /** A point that the file gives, or the side that the quadrant asks for, in the object's frame; nothing for all. */
    StartHint hint_W;
    /** In how many of the sampled poses the path wraps here, and on any other segment. */
    int numEngaged = 0, numElsewhere = 0;
};

/** Binds the active wrap objects of a path, sorted by their place. The segment is the one on which the object is
engaged in most of the poses sampled: the default and others over the coordinates' ranges, the same at each call. An
object that is never engaged is bound to the segment nearest to it.

@param state   of the system in which `model` was built; realized to Model */
std::vector<BoundWrap> bindWraps(const ModelDescription& description, const MusclePath& path, const BuiltModel& model,
                                 const SimTK::State& state);

}  // namespace tautline::models
