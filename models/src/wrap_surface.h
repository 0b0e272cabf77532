// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "tautline/models/model_description.h"
#include "tautline/surfaces/surface.h"

namespace tautline::models {

/** The surface of a wrap object, in its own frame. */
std::shared_ptr<const Surface> makeSurface(const WrapObject& object);

}  // namespace tautline::models
