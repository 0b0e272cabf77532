// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What tests of the program's commands share. */
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "storage_file.h"
#include "support/run_program.h"

namespace tautline::testing {

struct Outcome {
    int exitCode = -1;
    std::string text;  ///< standard output and error

    bool has(const std::string& part) const { return text.find(part) != std::string::npos; }
    long countLines() const { return std::count(text.begin(), text.end(), '\n'); }
};

inline Outcome runTautline(const std::string& arguments) {
    Outcome outcome;
    outcome.exitCode = runProgram(TAUTLINE_PROGRAM " " + arguments, outcome.text);
    return outcome;
}

inline std::string readAll(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/** An empty place for results, not made yet. */
inline std::filesystem::path makeFolder(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / ("tautline_" + name);
    std::filesystem::remove_all(folder);
    return folder;
}

/** Of the test that runs: tests run side by side. */
inline std::string getTestName() {
    return ::testing::UnitTest::GetInstance()->current_test_info()->name();
}

/** A file with a text beside the results of a test. */
inline std::filesystem::path writeInput(const std::string& name, const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / ("tautline_" + name);
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

inline std::size_t findColumn(const StorageTable& table, const std::string& label) {
    const auto at = std::find(table.labels.begin(), table.labels.end(), label);
    EXPECT_NE(at, table.labels.end()) << label;
    return at == table.labels.end() ? 0 : static_cast<std::size_t>(at - table.labels.begin());
}

}  // namespace tautline::testing
