// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "excitations.h"
#include "simulation_options.h"

namespace tautline {

/** `tautline run`: simulates a model file and writes states.sto, paths.sto, muscles.sto if there are any,
clearances.sto and events.csv, start.csv if the model gives geodesics to start from, and pictures if asked for. */
struct RunCommand {
    std::filesystem::path modelFile, outFolder = "results";
    /** Names or types of unknown elements that are left out. */
    std::vector<std::string> ignored;
    ExcitationOptions excitations;
    SimulationOptions simulation;
    bool allowsDegraded = false;
    bool drawsCurves = false;
    /** The page to look at; empty: none. */
    std::filesystem::path report;

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** @param isTerminal   whether `out` may be drawn a progress bar on
    @return exit code: 0, or 3 if accepted steps had no verified path and that was not allowed. Throws
    std::exception with one line for bad input; then no result file is written. */
    int run(std::ostream& out, bool isTerminal) const;
};

}  // namespace tautline
