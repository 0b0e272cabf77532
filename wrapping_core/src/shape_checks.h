#pragma once
/** Private: what constructors of shapes check and how they describe themselves. */
#include <cmath>
#include <sstream>
#include <string>

#include "tautline/error.h"

namespace tautline {

inline void requireLength(double value, const char* what) {
    require(std::isfinite(value) && value > 0, what, " must be positive and finite, but is ", value);
}

template <class... Parts>
std::string describeShape(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

}  // namespace tautline
