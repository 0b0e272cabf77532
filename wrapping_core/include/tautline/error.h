// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The one exception of the core: bad input, refused at the border with the value in the message. */
#include <sstream>
#include <stdexcept>
#include <string>

namespace tautline {

class InvalidInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/** Throws InvalidInput with all parts streamed into one message unless `condition` holds. */
template <class... Parts>
void require(bool condition, const Parts&... parts) {
    if (condition) return;
    std::ostringstream message;
    message.precision(17);
    (message << ... << parts);
    throw InvalidInput(message.str());
}

}  // namespace tautline
