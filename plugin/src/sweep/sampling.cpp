// SPDX-License-Identifier: Apache-2.0
#include "sweep/sampling.h"

#include <numeric>
#include <random>
#include <utility>

namespace tautline {
namespace {

/** Numbers that do not depend on the standard library's distributions, which are its own. */
class Draws {
public:
    explicit Draws(std::uint64_t seed) : m_random(seed) {}

    /** In [0, 1), all 53 bits. */
    double drawUnit() { return static_cast<double>(m_random() >> 11) * 0x1p-53; }
    /** In 0 ... count - 1. */
    int drawIndex(int count) { return static_cast<int>(drawUnit() * count); }

private:
    std::mt19937_64 m_random;
};

UnitSamples makeRows(int count, int dimensions) {
    const auto rows = static_cast<std::size_t>(count), columns = static_cast<std::size_t>(dimensions);
    return UnitSamples(rows, std::vector<double>(columns));
}

}  // namespace

UnitSamples drawRandom(int count, int dimensions, std::uint64_t seed) {
    UnitSamples samples = makeRows(count, dimensions);
    Draws draws(seed);
    for (std::vector<double>& row : samples)
        for (double& x : row) x = draws.drawUnit();
    return samples;
}

UnitSamples drawLatinHypercube(int count, int dimensions, std::uint64_t seed) {
    UnitSamples samples = makeRows(count, dimensions);
    Draws draws(seed);
    std::vector<int> parts(samples.size());
    for (std::size_t d = 0; d < samples.front().size(); ++d) {
        std::iota(parts.begin(), parts.end(), 0);
        for (int i = count - 1; i > 0; --i)
            std::swap(parts[static_cast<std::size_t>(i)], parts[static_cast<std::size_t>(draws.drawIndex(i + 1))]);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i][d] = (parts[i] + draws.drawUnit()) / count;
    }
    return samples;
}

}  // namespace tautline
