// SPDX-License-Identifier: Apache-2.0
#pragma once
/** OpenSim's storage files (.sto): a header, a row of labels, rows of numbers; the first column is time. */
#include <filesystem>
#include <string>
#include <vector>

namespace tautline {

struct StorageTable {
    std::string name;
    std::vector<std::string> labels;        ///< the first is "time"
    std::vector<std::vector<double>> rows;  ///< as long as labels each
    bool isInDegrees = false;
    bool saysUnits = true;  ///< false: a file was read whose header has no inDegrees
};

/** The shortest text that reads back as the same double. */
std::string toText(double value);

/** Writes a table so that reading it gives the same doubles; what is not defined is written as nan. The file appears
whole or not at all. Throws std::runtime_error naming the file. */
void writeStorage(const StorageTable& table, const std::filesystem::path& file);

/** Writes text likewise. */
void writeWhole(const std::string& text, const std::filesystem::path& file);

/** Reads a storage file. Throws std::runtime_error naming file and line where it is missing, a number cannot
be read, a row has another length than the labels, or time does not increase. */
StorageTable readStorage(const std::filesystem::path& file);

}  // namespace tautline
