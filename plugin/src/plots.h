// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "simulation.h"

namespace tautline {

/** @throws std::runtime_error if gnuplot is not among the programs that can be called */
void requireGnuplot();

/** Draws the results of a run that stand in a folder: for each path length, rate, tension, path error and, of its
obstacles, signed distance, line coordinate and surface coordinates over time, dashed where contact changes
(curves_<path>.svg), and the errors of its first iterations if the model gives a start (start_<path>.svg). Writes
the gnuplot script curves.gp, which can be run again in the folder, and runs it.
@param said   what gnuplot has to say of its script, such as warnings
@return the pictures
@throws std::runtime_error if gnuplot fails, with what it says */
std::vector<std::filesystem::path> drawCurves(const models::ModelSystem& model, const SimulationResult& result,
                                              const std::filesystem::path& folder, std::string& said);

}  // namespace tautline
