// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

#include "sweep/run_pool.h"
#include "sweep/sweep_journal.h"

namespace tautline {

/** Hands out the runs that the journal does not have, and writes down what they come to.
@param reportProgress   called with the share of them that is done
@param isInterrupted   asked now and then
@return whether all are done; what was begun when it was interrupted is done anew another time */
bool doRuns(const SweepPlan& plan, SweepJournal& journal, RunPool& pool,
            const std::function<void(double)>& reportProgress, const std::function<bool()>& isInterrupted);

}  // namespace tautline
