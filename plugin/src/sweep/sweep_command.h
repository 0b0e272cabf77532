// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "sweep/run_pool.h"

namespace tautline {

/** `tautline sweep`: many runs of a model that differ in options, values of the model, or files, and one table of what
they come to. */
struct SweepCommand {
    std::filesystem::path modelFile, sweepFile, outFolder = "results/sweep";
    int numJobs = 0;       ///< runs at a time; 0: as many as there are cores
    bool retries = false;  ///< does runs that have failed once more

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** Reads the plan, and tries the command line of each run.
    @throws std::runtime_error with one line for bad input */
    SweepPlan readPlan() const;

    /** Runs what the folder does not have the results of, and writes the table.
    @return exit code: 0; 3 if runs have failed or are degraded; 130 if it was interrupted: the same command goes on.
    Throws std::exception with one line for bad input; then no file is written */
    int run(std::ostream& out, bool isTerminal) const;

    /** The same for a plan that is read, with runs done elsewhere than in processes on this machine. */
    int run(const SweepPlan& plan, RunPool& pool, std::ostream& out, bool isTerminal) const;
};

}  // namespace tautline
