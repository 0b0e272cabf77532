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

/** The model file, what of it may be left out, and what is set otherwise. Of options that are not repeatable the last
one counts, so that what a script gives can be overridden: call it before others are added. */
inline void addModelOptions(CLI::App& app, std::filesystem::path& modelFile, std::vector<std::string>& ignored,
                            std::vector<std::string>& settings,
                            const std::string& ignorable = "name or type of an element") {
    app.option_defaults()->take_last();
    app.add_option("MODEL", modelFile, "model file (.osim)")->required();
    addRepeatable(app, "--ignore", ignored, ignorable + " to leave out though it is not known");
    addRepeatable(app, "--set", settings,
                  "field of the model with another value, ELEMENT/FIELD=VALUE, or =*FACTOR for a multiple");
}

}  // namespace tautline
