// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Options that commands have in common. */
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace tautline {

/** An option with one value that may be given again and again. */
template <class Value>
void addRepeatable(CLI::App& app, const std::string& name, std::vector<Value>& values, const std::string& description) {
    app.add_option(name, values, description + "; repeatable")->take_all()->allow_extra_args(false);
}

/** The model file, and what of it may be left out. Of options that are not repeatable the last one counts, so that what
a script gives can be overridden: call it before others are added. */
inline void addModelOptions(CLI::App& app, std::filesystem::path& modelFile, std::vector<std::string>& ignored,
                            const std::string& ignorable = "name or type of an element") {
    app.option_defaults()->take_last();
    app.add_option("MODEL", modelFile, "model file (.osim)")->required();
    addRepeatable(app, "--ignore", ignored, ignorable + " to leave out though it is not known");
}

}  // namespace tautline
