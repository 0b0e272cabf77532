// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tautline/models/model_builder.h"

namespace tautline::models {

/** Measured forces on a body, as columns of a table over time. Each identifier is what the labels of its three columns,
x, y and z, begin with; an empty one means none. Frames are bodies, or the ground. */
struct ExternalForce {
    std::string name;
    bool appliesForce = true;
    std::string body;
    /** In whose axes force and torque are given. */
    std::string forceFrame;
    /** In which the point of application is given; without a point it is the body's origin. */
    std::string pointFrame;
    std::string forceIdentifier, pointIdentifier, torqueIdentifier;
    int line = 0;
};

struct ExternalLoads {
    std::string fileName;
    /** Of the table, as the file names it. */
    std::string dataFile;
    std::vector<ExternalForce> forces;
};

/** Numbers over time; the first column is time and increases. */
struct TimeSeries {
    std::vector<std::string> labels;
    std::vector<std::vector<double>> rows;
};

/** Reads a file of ExternalLoads, such as reaction forces of the ground. The table is not read.
@throws ModelError as readOsimFile() does */
ExternalLoads readExternalLoads(const std::filesystem::path& file, const ModelDescription& model);

/** Adds the forces to a system before its topology is realized. Between the rows they follow cubic splines (straight
lines if there are fewer than four), and before the first and after the last row they keep its values.
@throws ModelError naming the identifier, if a table has not three columns for it */
void addExternalLoads(const ExternalLoads& loads, const TimeSeries& data, const BuiltModel& model,
                      SimTK::GeneralForceSubsystem& forces);

}  // namespace tautline::models
