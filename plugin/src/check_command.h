// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace tautline {

/** `tautline check`: what is in a model file, what of it is supported, where its paths wrap over the ranges of its
coordinates, and what differs from OpenSim, as tables or as JSON. Writes no files. */
struct CheckCommand {
    std::filesystem::path modelFile;
    std::vector<std::string> ignored;   ///< names or types of unknown elements
    std::vector<std::string> settings;  ///< ELEMENT/FIELD=VALUE
    bool printsJson = false;

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** @return exit code: 0, or 3 if the model has elements without which it can be checked but that `tautline run`
    refuses. Throws std::exception if it cannot be read at all. */
    int run(std::ostream& out, bool isTerminal) const;
};

}  // namespace tautline
