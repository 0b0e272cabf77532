// SPDX-License-Identifier: Apache-2.0
#include "read_text.h"

#include <fstream>
#include <sstream>

#include "tautline/models/model_error.h"

namespace tautline::models {

std::string readText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || std::filesystem::is_directory(file)) throw ModelError(file.string() + ": the file cannot be read");
    return text.str();
}

}  // namespace tautline::models
