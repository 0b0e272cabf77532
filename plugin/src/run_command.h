// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <ostream>

#include "excitations.h"
#include "initial_state.h"
#include "page_options.h"
#include "simulation_options.h"

namespace tautline {

struct EarlierRun;
struct SimulationResult;

/** `tautline run`: simulates a model file and writes states.sto, paths.sto, muscles.sto if there are any,
clearances.sto, events.csv and contacts.csv, start.csv if the model gives geodesics to start from, and pictures if asked
for. */
struct RunCommand {
    std::filesystem::path modelFile, outFolder = "results";
    /** Names or types of unknown elements that are left out. */
    std::vector<std::string> ignored;
    std::vector<std::string> settings;  ///< ELEMENT/FIELD=VALUE
    ExcitationOptions excitations;
    SimulationOptions simulation;
    std::filesystem::path statesFile, externalLoadsFile;
    std::optional<double> startTime, endTime;  ///< [s]
    std::vector<std::string> pose, speeds;     ///< NAME=VALUE
    std::vector<std::string> locked;           ///< patterns of coordinates
    std::vector<double> gravity;               ///< in ground [m/s^2]; empty: the model's
    bool allowsDegraded = false;
    bool drawsCurves = false;
    bool resumes = false;     ///< goes on from where an interrupted run into the same folder has ended
    bool visualizes = false;  ///< in a window of Simbody's visualizer
    PageOptions page;

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** @param isTerminal   whether `out` may be drawn a progress bar on
    @return exit code: 0; 3 if accepted steps had no verified path and that was not allowed; 4 if the simulation could
    not go on; 130 if it was interrupted (Ctrl-C). In all these cases what there is is written. Throws std::exception
    with one line for bad input; then no result file is written. */
    int run(std::ostream& out, bool isTerminal) const;

private:
    models::ModelDescription readModel() const;
    InitialState makeInitialState(const models::ModelDescription& description, std::vector<std::string>& notes) const;
    /** With the end that was given in place of a duration. @param earlier   that the run goes on from, if it does */
    SimulationOptions makeOptions(double start, const std::optional<EarlierRun>& earlier) const;
    void addExternalLoads(const models::ModelDescription& description, models::ModelSystem& model,
                          std::ostream& out) const;
    /** Says that nothing is left to do, if an earlier run has come to the end. */
    bool isDone(const EarlierRun& earlier, std::ostream& out) const;
    /** Writes all result files. @return their names */
    std::vector<std::string> writeResults(const SimulationResult& result) const;
};

}  // namespace tautline
