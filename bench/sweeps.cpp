// SPDX-License-Identifier: Apache-2.0
/** Jumps of length in sweeps over each coordinate of models, with their causes; README.md says how to read it. */
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "command_options.h"
#include "motion_file.h"
#include "support/model_sweep.h"
#include "tautline/models/osim_reader.h"
#include "text_table.h"

namespace {

using namespace tautline;
using testing::LengthJump;

void printJumps(const std::vector<LengthJump>& jumps, bool printsAll) {
    TextTable table;
    for (const char* what : {"path", "coordinate"}) table.addColumn(what, "", true);
    table.addColumn("at", "[rad or m]");
    table.addColumn("length", "[m]");
    table.addColumn("jump", "[m]");
    for (const char* what : {"cause", "of what"}) table.addColumn(what, "", true);
    for (const LengthJump& jump : jumps)
        if (printsAll || !isExplained(jump.cause))
            table.addRow({jump.path, jump.coordinate, format(jump.value, 9), format(jump.before, 6),
                          format(jump.after - jump.before, 6), getName(jump.cause), jump.detail});
    table.print(std::cout);
}

/** @return whether every jump has its cause, and continued lengths are those of poses alone */
bool sweep(const std::string& file, const std::vector<std::string>& base, int steps, bool printsAll) {
    const models::ModelDescription description = models::readOsimFile(file, {{}, true});
    std::map<std::string, double> values;
    for (const CoordinateValue& given : parseCoordinateValues(base, "--pose", description))
        values[given.name] = given.value;
    const testing::SweepReport report = testing::ModelSweep(description, values).run(steps);
    std::map<std::string, int> counts;
    bool isExplained = true;
    for (const LengthJump& jump : report.jumps) {
        ++counts[getName(jump.cause)];
        isExplained = isExplained && testing::isExplained(jump.cause);
    }
    std::cout << description.name << ": " << report.numPoses << " poses, " << report.jumps.size() << " jumps";
    for (const auto& [cause, count] : counts) std::cout << ", " << cause << " " << count;
    std::cout << "; walked other than alone " << report.misses.size() << " times\n";
    if (!report.jumps.empty()) printJumps(report.jumps, printsAll);
    for (const testing::WalkMiss& miss : report.misses)
        std::cout << miss.path << " at " << miss.coordinate << " " << format(miss.value, 9) << ": walked "
                  << format(miss.walked, 9) << " m, alone " << format(miss.alone, 9) << " m\n";
    return isExplained && report.misses.empty();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Jumps of length in sweeps over each coordinate of models"};
    std::vector<std::string> files, base;
    int steps = 200;
    bool printsAll = false;
    app.add_option("MODEL", files, "model files (.osim)")->required();
    app.add_option("--steps", steps, "of each coordinate over its range")->capture_default_str();
    addRepeatable(app, "--pose", base, "value of a coordinate while others are swept, NAME=VALUE");
    app.add_flag("--all", printsAll, "list jumps with a cause in OpenSim's rules or in the string, too");
    CLI11_PARSE(app, argc, argv);
    bool isClean = true;
    try {
        for (const std::string& file : files) isClean = sweep(file, base, steps, printsAll) && isClean;
    } catch (const std::exception& error) {
        std::cerr << "sweeps: " << error.what() << "\n";
        return 2;
    }
    return isClean ? 0 : 1;
}
