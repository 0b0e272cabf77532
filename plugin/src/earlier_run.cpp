// SPDX-License-Identifier: Apache-2.0
#include "earlier_run.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tautline {
namespace {

void prepend(const StorageTable& earlier, StorageTable& table) {
    if (earlier.labels != table.labels)
        throw std::runtime_error("--resume: " + table.name +
                                 ".sto has other columns: it is of another model or of other options");
    // The earlier run ends with the row with which this one begins.
    table.rows.insert(table.rows.begin(), earlier.rows.begin(), earlier.rows.end() - 1);
}

std::string readText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

void EarlierRun::prependTo(SimulationResult& result) const {
    prepend(states, result.states);
    prepend(paths, result.paths);
    if (!muscles.labels.empty()) prepend(muscles, result.muscles);
    prepend(clearances, result.clearances);
    result.events = events + result.events.substr(result.events.find('\n') + 1);
}

EarlierRun readEarlierRun(const std::filesystem::path& folder) {
    EarlierRun run;
    run.states = readStorage(folder / "states.sto");
    run.paths = readStorage(folder / "paths.sto");
    if (std::filesystem::exists(folder / "muscles.sto")) run.muscles = readStorage(folder / "muscles.sto");
    run.clearances = readStorage(folder / "clearances.sto");
    run.events = readText(folder / "events.csv");
    for (const StorageTable* table : {&run.paths, &run.muscles, &run.clearances})
        if (!table->rows.empty() && table->rows.back()[0] != run.getEnd())
            throw std::runtime_error(folder.string() + ": " + table->name +
                                     ".sto and states.sto end at different times");
    return run;
}

}  // namespace tautline
