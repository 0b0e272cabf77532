// SPDX-License-Identifier: Apache-2.0
/** The `tautline` program: chooses the command, turns exceptions into one line. */
#include <unistd.h>

#include <iostream>

#include "check_command.h"
#include "command_options.h"
#include "fit_command.h"
#include "run_command.h"
#include "solve_command.h"
#include "sweep/sweep_command.h"
#include "tautline/models/extensions.h"
#include "tautline/version.h"

int main(int argc, char** argv) {
    CLI::App app{"Tautline: shortest paths of muscles and cables over smooth surfaces, in Simbody"};
    app.set_version_flag("--version", "tautline " TAUTLINE_VERSION);
    app.require_subcommand(1);
    app.fallthrough();  // what all commands have in common may stand behind any of them
    std::vector<std::filesystem::path> extensions;
    tautline::addRepeatable(app, "--load", extensions, "shared library with surfaces and force laws for model files");
    tautline::RunCommand run;
    CLI::App* runApp = app.add_subcommand("run", "simulate a model file forward under gravity");
    run.declare(*runApp);
    tautline::SolveCommand solve;
    CLI::App* solveApp =
        app.add_subcommand("solve", "lengths, contacts and moment arms of a model's paths along a motion or in a pose");
    solve.declare(*solveApp);
    tautline::CheckCommand check;
    CLI::App* checkApp = app.add_subcommand(
        "check", "what is in a model file, what is supported, where its paths wrap, what differs from OpenSim");
    check.declare(*checkApp);
    tautline::FitCommand fit;
    CLI::App* fitApp = app.add_subcommand("fit", "a smooth surface from a mesh, for a model to wrap over");
    fit.declare(*fitApp);
    tautline::SweepCommand sweep;
    CLI::App* sweepApp = app.add_subcommand("sweep", "many runs of a model with variations, and one table of them");
    sweep.declare(*sweepApp);
    CLI11_PARSE(app, argc, argv);
    try {
        for (const std::filesystem::path& extension : extensions) tautline::models::loadExtension(extension);
        const bool isTerminal = isatty(STDOUT_FILENO) == 1;
        if (solveApp->parsed()) return solve.run(std::cout, isTerminal);
        if (fitApp->parsed()) return fit.run(std::cout);
        if (sweepApp->parsed()) return sweep.run(std::cout, isTerminal);
        if (checkApp->parsed()) return check.run(std::cout, isTerminal);
        return run.run(std::cout, isTerminal);
    } catch (const std::exception& error) {
        std::cout << std::flush;
        std::cerr << "tautline: " << error.what() << "\n";
        return 1;
    }
}
