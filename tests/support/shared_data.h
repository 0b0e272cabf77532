// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Where the reference data of others stand: never copied into the project, read in place. */
#include <cstdlib>
#include <filesystem>
#include <string>

namespace tautline::testing {

/** The folder named by TAUTLINE_SHARED, or `../shared` of the source tree; empty if it is absent. */
inline std::filesystem::path findSharedFolder() {
    const char* fromEnvironment = std::getenv("TAUTLINE_SHARED");
    const std::filesystem::path folder = fromEnvironment ? std::filesystem::path(fromEnvironment)
                                                         : std::filesystem::path(TAUTLINE_SOURCE_DIR) / ".." / "shared";
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

}  // namespace tautline::testing

/** Ends the test as skipped, with a word, where the shared data are absent. */
#define TAUTLINE_SKIP_WITHOUT_SHARED(folder)                                    \
    const std::filesystem::path folder = tautline::testing::findSharedFolder(); \
    if (folder.empty()) GTEST_SKIP() << "no reference data: neither ../shared nor TAUTLINE_SHARED is a folder"
