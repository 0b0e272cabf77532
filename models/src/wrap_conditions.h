// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>

#include "tautline/models/model_builder.h"
#include "tautline/models/wrap_binding.h"

namespace tautline::models {

/** When a bound wrap takes part, by OpenSim's rules: a cylinder within its length, a one-sided object on one segment at
a time. Null: always. Called with a State whose bodies' poses are known. */
std::function<bool(const SimTK::State&)> makeWrapCondition(const ModelDescription& description, const MusclePath& path,
                                                           const BoundWrap& wrap, const BuiltModel& model);

}  // namespace tautline::models
