// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace tautline {

/** Points in the unit cube [0, 1)^d, one row each; the same for a seed on every machine. */
using UnitSamples = std::vector<std::vector<double>>;

/** Independent and uniform. @param count, dimensions   at least 1 */
UnitSamples drawRandom(int count, int dimensions, std::uint64_t seed);

/** A Latin hypercube (McKay, Beckman, Conover 1979): each coordinate has one point in each of `count` equal parts of
its range, at a random place there, in an order of its own. */
UnitSamples drawLatinHypercube(int count, int dimensions, std::uint64_t seed);

}  // namespace tautline
