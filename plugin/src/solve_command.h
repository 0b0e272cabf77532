// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "page_options.h"

namespace tautline {

/** `tautline solve`: lengths, lengthening speeds, contacts and moment arms of a model's paths along a motion or in one
pose; writes paths.sto, moment_arms.sto, coordinates.sto and statuses.csv. */
struct SolveCommand {
    std::filesystem::path modelFile, motionFile, outFolder = "results";
    std::vector<std::string> pose;      ///< NAME=VALUE
    std::vector<std::string> patterns;  ///< of paths; empty: all
    std::vector<std::string> ignored;   ///< elements of the model, and columns of the motion
    std::vector<std::string> settings;  ///< ELEMENT/FIELD=VALUE
    int numThreads = 0;  ///< 0: as many as there are cores; with a page: one
    bool allowsDegraded = false;
    PageOptions page;

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** @return exit code: 0, or 3 if a path in some frame is no verified shortest one as it was asked for, or
    constraints could not be met, and that was not allowed. Throws std::exception with one line for bad input; then no
    result file is written. */
    int run(std::ostream& out, bool isTerminal) const;
};

}  // namespace tautline
