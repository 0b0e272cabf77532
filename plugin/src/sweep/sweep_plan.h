// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tautline {

/** What varies from run to run: an option of the command, with a name in front where it is one of NAME=VALUE. */
struct SweepVariable {
    std::string option;  ///< without dashes: pose, excitation, set, states, ...
    std::string name;    ///< of the coordinate, muscle or field; empty for options that have a value alone

    /** Its column in the table: "pose elbow_flexion". */
    std::string getLabel() const { return name.empty() ? option : option + " " + name; }
};

/** Of which columns of the result files the table has what. */
struct SweepColumns {
    std::string pattern;              ///< of columns, such as "*|length"
    std::vector<std::string> values;  ///< first, last, min, max, mean
};

/** What a file of a sweep asks for: runs of one command that differ in some options.

@code{.json}
{
    "command": "run",
    "options": {"duration": 0.2, "lock": ["shoulder*"]},
    "vary": [
        {"option": "pose", "name": "elbow_flexion", "from": 20, "to": 80, "count": 4, "unit": "deg"},
        {"option": "set", "name": "biceps_long/max_isometric_force", "values": ["*0.8", "*1.2"]}
    ],
    "sampling": {"method": "grid"},
    "table": [{"columns": "*|length", "values": ["min", "max"]}],
    "keep": "failed"
}
@endcode */
struct SweepPlan {
    enum class Keep { None, Failed, All };

    std::string command;                 ///< run or solve
    std::vector<std::string> arguments;  ///< of all runs, as on a command line
    std::vector<SweepVariable> variables;
    std::vector<std::vector<std::string>> runs;  ///< of each run the values of the variables, as texts
    std::vector<SweepColumns> table;
    Keep keep = Keep::Failed;  ///< whose result files stay

    int getNumRuns() const { return static_cast<int>(runs.size()); }
    /** The command line of a run, from the command on. */
    std::vector<std::string> makeArguments(int run, const std::filesystem::path& modelFile,
                                           const std::filesystem::path& outFolder) const;
};

/** Reads the file of a sweep and draws its runs.
@throws std::runtime_error naming the file and the place in it (a JSON pointer, or line and column) of what is missing,
not known, or out of its range */
SweepPlan readSweepPlan(const std::filesystem::path& file);

}  // namespace tautline
