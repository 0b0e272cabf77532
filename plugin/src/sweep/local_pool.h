// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <list>

#include "sweep/run_pool.h"

namespace tautline {

/** A folder for each run of a sweep. */
std::filesystem::path getRunFolder(const std::filesystem::path& outFolder, int run);

/** Processes on this machine. */
class LocalPool : public RunPool {
public:
    /** @param plan   must outlive this
    @param size   how many at a time */
    LocalPool(const SweepPlan& plan, std::filesystem::path modelFile, std::filesystem::path outFolder, int size);

    bool isFree() const override { return static_cast<int>(m_runs.size()) < m_size; }
    bool isBusy() const override { return !m_runs.empty(); }
    void start(int run) override;
    std::optional<SweepResult> wait(std::chrono::milliseconds time) override;

private:
    const SweepPlan& m_plan;
    std::filesystem::path m_modelFile, m_outFolder;
    int m_size;
    std::list<SweepRun> m_runs;
};

}  // namespace tautline
