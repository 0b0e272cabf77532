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
    /** NAME=VALUE each, where NAME may be a pattern; they win over the file, names over patterns, and the last pattern
    over those before. */
    std::vector<std::string> assignments;
    /** A storage file with a column per muscle, or a control set (.xml); empty: none. */
    std::filesystem::path file;
    /** Of the model's controllers; file and command line win over them. */
    std::map<std::string, Excitation> prescribed = {};
};

inline constexpr double kDefaultExcitation = 0.05;

/** An excitation for each muscle named in `muscles`. Columns, or controls, of the file are found by name, by
"/forceset/<name>" or by "<name>.excitation". Columns are linear between their times and constant outside, controls are
as models::Control says; values outside [0, 1] are clipped. Throws std::runtime_error for a name or pattern of no
muscle, a value that is not a number or, on the command line, not in [0, 1], a name given twice, or a file that
readStorage() or models::readControlSet() refuses or that has nothing of a muscle.
@param numDefault   how many muscles got the default
@param notes        what of the file was clipped or not used is added */
std::map<std::string, Excitation> makeExcitations(const ExcitationOptions& options,
                                                  const std::vector<std::string>& muscles, int& numDefault,
                                                  std::vector<std::string>& notes);

}  // namespace tautline
