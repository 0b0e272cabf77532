// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <ostream>

namespace tautline::compare {

/** Time per surface against the number of cylinders of the weave, from 10 to 1000, for each way that comes so far; as a
table, and drawn by gnuplot.
@throws std::runtime_error if gnuplot fails */
void drawCostCurve(int numRounds, const std::filesystem::path& picture, std::ostream& out);

}  // namespace tautline::compare
