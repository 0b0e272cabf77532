// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Poses of a model from motion files and from the command line. */
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "storage_file.h"
#include "tautline/models/path_study.h"

namespace tautline {

struct Motion {
    std::vector<models::ModelPose> poses;  ///< by frame, with speeds
    /** Coordinates that it says nothing of and that no coupler gives a value, in the order of the model. */
    std::vector<std::string> missing;
    /** What was read otherwise than it is written, or not at all; a line each. */
    std::vector<std::string> notes;
};

/** Reads a motion or states file: a column of values for each coordinate, labeled with its name or as OpenSim's states
are, /jointset/<joint>/<coordinate>/value. Angles are in degrees if the header says so. Columns of states of forces,
which lie beside coordinates in such files, and of coordinates that couplers determine are left out with a note. Speeds
are those of the columns .../speed or <coordinate>_u, else slopes of the cubic splines through the frames (lines if
there are fewer than three).
@param ignored   patterns of columns to leave out
@throws std::runtime_error naming the file and all columns that it cannot read, or a coordinate that has two */
Motion readMotion(const std::filesystem::path& file, const models::ModelDescription& description,
                  const std::vector<std::string>& ignored);

/** What a column of a motion or states file holds of a coordinate. */
struct CoordinateColumn {
    std::string coordinate;
    bool isSpeed = false;
};

/** By a label such as <coordinate>, /jointset/<joint>/<coordinate>/speed or <coordinate>_u; nothing if it is of none.
 */
std::optional<CoordinateColumn> findCoordinateColumn(const std::string& label,
                                                     const models::ModelDescription& description);

/** By which numbers of a coordinate in a table must be multiplied to be in SI units. */
double getUnit(const StorageTable& table, const models::ModelDescription& description, const std::string& coordinate);

/** A coordinate with a value [rad or m]. */
struct CoordinateValue {
    std::string name;
    double value = 0.0;
};

/** Reads NAME=VALUE texts, where 30deg is an angle in degrees.
@param option   for messages, such as "--pose"
@throws std::runtime_error naming the text: an unknown coordinate, one that is given twice, no number, or degrees of
a length */
std::vector<CoordinateValue> parseCoordinateValues(const std::vector<std::string>& texts, const std::string& option,
                                                   const models::ModelDescription& description);

}  // namespace tautline
