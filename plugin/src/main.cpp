// SPDX-License-Identifier: Apache-2.0
/** The `tautline` program: chooses the command, turns exceptions into one line. */
#include <unistd.h>

#include <iostream>

#include "run_command.h"

int main(int argc, char** argv) {
    CLI::App app{"Tautline: shortest paths of muscles and cables over smooth surfaces, in Simbody"};
    app.set_version_flag("--version", "tautline " TAUTLINE_VERSION);
    app.require_subcommand(1);
    tautline::RunCommand run;
    CLI::App* runApp = app.add_subcommand("run", "simulate a model file forward under gravity");
    run.declare(*runApp);
    CLI11_PARSE(app, argc, argv);
    try {
        return run.run(std::cout, isatty(STDOUT_FILENO) == 1);
    } catch (const std::exception& error) {
        std::cout << std::flush;
        std::cerr << "tautline: " << error.what() << "\n";
        return 1;
    }
}
