// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "element.h"

namespace tautline::models {

/** Reads an element that is a function, such as LinearFunction. */
ScalarFunction readFunction(Element element);

/** The function inside a wrapper such as x_location; none if the wrapper is empty. */
std::optional<ScalarFunction> readWrappedFunction(const Element& wrapper);

ScalarFunction requireWrappedFunction(const Element& wrapper);

}  // namespace tautline::models
