// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tautline {

/** Excitation of a muscle as a function of time [s], within [0, 1]. */
using Excitation = std::function<double(double)>;

/** What the command line and the model say about excitations. */
struct ExcitationOptions {
    std::vector<std::string> assignments;  ///< NAME=VALUE each; they win over the file
    std::filesystem::path file;            ///< a storage file with a column per muscle; empty: none
    /** Of the model's controllers; file and command line win over them. */
    std::map<std::string, Excitation> prescribed = {};
};

inline constexpr double kDefaultExcitation = 0.05;

/** An excitation for each muscle named in `muscles`. Columns are found by name or by "/forceset/<name>",
linear between the file's times and constant outside. Throws std::runtime_error for an unknown muscle, a
value that is not a number or not in [0, 1], a name given twice, or a file that readStorage() refuses.
@param numDefault   how many muscles got the default */
std::map<std::string, Excitation> makeExcitations(const ExcitationOptions& options,
                                                  const std::vector<std::string>& muscles, int& numDefault);

}  // namespace tautline
