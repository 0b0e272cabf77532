// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>

namespace tautline::models {

/** The whole of a file. @throws ModelError naming it if it cannot be read */
std::string readText(const std::filesystem::path& file);

}  // namespace tautline::models
