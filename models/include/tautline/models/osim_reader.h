// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "tautline/models/model_description.h"
#include "tautline/models/model_error.h"

namespace tautline::models {

/** Reads an OpenSim model: documents up to 30500 (joints inside bodies) and from 40000 to 40600.

What has no effect on the motion is listed in ModelDescription::skipped. Everything else that the reader does not know
is refused with a message `file:line: what`, so a model that is returned has all its joints, points and wraps.

@throws ModelError if the file cannot be read or is refused. */
ModelDescription readOsimFile(const std::filesystem::path& file);

/** The same from a text; `fileName` only names it in messages. */
ModelDescription readOsimText(std::string_view text, const std::string& fileName);

}  // namespace tautline::models
