// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sweep/child_process.h"
#include "sweep/sweep_plan.h"

namespace tautline {

/** What a run came to. */
struct SweepResult {
    int run = -1;
    int exitCode = 0;    ///< of `tautline run` or `solve`; negative: the signal that has ended it
    std::string reason;  ///< why it is not done; empty where it is
    /** Of the table: "biceps|length max" and its value, in the order of the plan and of the columns. */
    std::vector<std::pair<std::string, double>> values;

    bool isFailed() const { return exitCode != 0 && exitCode != 3; }
    /** done, degraded, refused, stuck, crashed */
    const char* getOutcome() const;
};

/** One run of a sweep, in a process of its own and a folder of its own. */
class SweepRun {
public:
    /** Starts it. @param folder   of its results, made anew */
    SweepRun(const SweepPlan& plan, int run, const std::filesystem::path& modelFile,
             const std::filesystem::path& folder);

    /** Its result once it has ended; its folder is then as the plan wishes. */
    std::optional<SweepResult> poll();

private:
    SweepResult collect(int exitCode) const;

    const SweepPlan* m_plan;
    int m_run;
    std::filesystem::path m_folder;
    ChildProcess m_process;
};

}  // namespace tautline
