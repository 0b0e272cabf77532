// SPDX-License-Identifier: Apache-2.0
#include "sweep/local_pool.h"

#include <cstdio>
#include <thread>

namespace tautline {

std::filesystem::path getRunFolder(const std::filesystem::path& outFolder, int run) {
    char name[16];
    std::snprintf(name, sizeof name, "%07d", run);
    return outFolder / "runs" / name;
}

LocalPool::LocalPool(const SweepPlan& plan, std::filesystem::path modelFile, std::filesystem::path outFolder, int size)
    : m_plan(plan), m_modelFile(std::move(modelFile)), m_outFolder(std::move(outFolder)), m_size(size) {}

void LocalPool::start(int run) {
    m_runs.emplace_back(m_plan, run, m_modelFile, getRunFolder(m_outFolder, run));
}

std::optional<SweepResult> LocalPool::wait(std::chrono::milliseconds time) {
    constexpr std::chrono::milliseconds kStep(2);
    for (std::chrono::milliseconds waited(0);; waited += kStep) {
        for (auto run = m_runs.begin(); run != m_runs.end(); ++run)
            if (const std::optional<SweepResult> result = run->poll()) {
                m_runs.erase(run);
                return result;
            }
        if (waited >= time) return {};
        std::this_thread::sleep_for(kStep);
    }
}

}  // namespace tautline
