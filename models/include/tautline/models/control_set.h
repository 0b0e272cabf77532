// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tautline/models/model_error.h"

namespace tautline::models {

/** One control over time, as OpenSim's ControlLinear says: through its nodes in straight lines, or in steps. */
struct Control {
    std::string name;
    int line = 0;
    std::vector<std::array<double, 2>> nodes;  ///< time [s] and value; at least one, times increase
    /** Between two nodes the value is that of the later one, as it is at that node. */
    bool hasSteps = false;
    /** Before the first and after the last node the lines go on straight; else, and with steps, their values hold. */
    bool extrapolates = true;

    double calcValue(double time) const;
};

/** Reads a file of controls: a ControlSet of ControlLinear and ControlConstant. Bounds, filters and gains, which belong
to the tools that compute controls, play no part.
@throws ModelError if the file cannot be read, a control has no nodes, or times do not increase; UnknownElementsError
for controls of other types */
std::vector<Control> readControlSet(const std::filesystem::path& file);

}  // namespace tautline::models
