// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <map>
#include <ostream>

#include "sweep/sweep_run.h"

namespace tautline {

/** Writes the table of a sweep, a row per run in the order of the plan: sweep.csv with words and numbers, and sweep.sto
with numbers alone (the first column is the number of the run, a value that is no number stands by its place among those
of its variable, from 0). Runs that have failed have no values there; failed.csv lists them with the reasons, if any.
@param results   by number; runs that are missing have no row
@return the files */
std::vector<std::filesystem::path> writeSweepTable(const SweepPlan& plan, const std::map<int, SweepResult>& results,
                                                   const std::filesystem::path& folder);

/** How many runs came to what. */
void printSweepSummary(const SweepPlan& plan, const std::map<int, SweepResult>& results, std::ostream& out);

}  // namespace tautline
