// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "element.h"
#include "tautline/models/multivariate_function.h"

namespace tautline::models {

/** Reads an element that is a function of as many arguments, such as LinearFunction. */
MultivariateFunction readFunction(Element element, std::size_t numArguments);

/** The function inside a wrapper such as x_location; none if the wrapper is empty. */
std::optional<ScalarFunction> readWrappedFunction(const Element& wrapper);

ScalarFunction requireWrappedFunction(const Element& wrapper);
/** The same for a function of several arguments. */
MultivariateFunction requireWrappedFunction(const Element& wrapper, std::size_t numArguments);

}  // namespace tautline::models
