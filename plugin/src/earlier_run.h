// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What an interrupted run has left in its folder. */
#include <filesystem>
#include <string>

#include "simulation.h"

namespace tautline {

struct EarlierRun {
    StorageTable states, paths, muscles, clearances;
    std::string events;

    double getStart() const { return states.rows.front()[0]; }
    double getEnd() const { return states.rows.back()[0]; }

    /** Puts its rows and events before those of a run that has gone on from its end.
    @throws std::runtime_error if that has other columns */
    void prependTo(SimulationResult& result) const;
};

/** @throws std::runtime_error naming the file that is missing or cannot be read, or if the files end at different times
 */
EarlierRun readEarlierRun(const std::filesystem::path& folder);

}  // namespace tautline
