// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

namespace tautline::models {

/** A model that cannot be read or built. The message names the file, the line and the element. */
class ModelError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace tautline::models
