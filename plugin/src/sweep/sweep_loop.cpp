// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_loop.h"

namespace tautline {

bool doRuns(const SweepPlan& plan, SweepJournal& journal, RunPool& pool,
            const std::function<void(double)>& reportProgress, const std::function<bool()>& isInterrupted) {
    constexpr std::chrono::milliseconds kPatience(100);
    std::vector<int> left;
    for (int run = 0; run < plan.getNumRuns(); ++run)
        if (journal.getResults().count(run) == 0) left.push_back(run);
    std::size_t begun = 0, ended = 0;
    while (ended < left.size()) {
        if (isInterrupted()) return false;
        while (begun < left.size() && pool.isFree()) pool.start(left[begun++]);
        const std::optional<SweepResult> result = pool.wait(kPatience);
        if (!result) continue;
        if (isInterrupted()) return false;  // which may be what has ended it
        journal.add(*result);
        reportProgress(static_cast<double>(++ended) / static_cast<double>(left.size()));
    }
    return true;
}

}  // namespace tautline
