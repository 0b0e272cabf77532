// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Private: what constructors of shapes check and how they describe themselves. */
#include <cmath>
#include <sstream>
#include <string>

#include "tautline/error.h"
#include "tautline/surfaces/parametric_surface.h"

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

inline void requireDomain(const ParameterDomain& domain, const char* what) {
    for (int i = 0; i < 2; ++i)
        require(std::isfinite(domain.min[i]) && std::isfinite(domain.max[i]) && domain.min[i] < domain.max[i], what,
                ": domain of ", "uv"[i], " must be finite and not empty, but is [", domain.min[i], ", ", domain.max[i],
                "]");
}

inline void requireNormalSign(double sign, const char* what) {
    require(sign == 1 || sign == -1, what, ": normal sign must be 1 or -1, but is ", sign);
}

/** @param coefficients   3 x `expected` [m] */
inline void requirePatch(const ParameterDomain& domain, const Eigen::Matrix3Xd& coefficients, Eigen::Index expected,
                         double normalSign, const char* what) {
    requireDomain(domain, what);
    require(coefficients.cols() == expected, what, ": needs ", expected, " coefficient columns, got ",
            coefficients.cols());
    for (Eigen::Index i = 0; i < expected; ++i)
        require(coefficients.col(i).allFinite(), what, ": coefficients must be finite, but column ", i, " is (",
                coefficients.col(i).transpose(), ")");
    requireNormalSign(normalSign, what);
}

}  // namespace tautline
