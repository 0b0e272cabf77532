// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <ostream>

namespace tautline::compare {

/** Lengths and all derivatives of a model's paths in the frames of a motion: laid out exactly, and by functions that
were fitted to them (OpenSim's FunctionBasedPath). A table of what a frame takes, and how far the functions are off.
@param fitted   file of FunctionBasedPaths */
void compareFittedPaths(const std::filesystem::path& model, const std::filesystem::path& motion,
                        const std::filesystem::path& fitted, int numRounds, std::ostream& out);

}  // namespace tautline::compare
