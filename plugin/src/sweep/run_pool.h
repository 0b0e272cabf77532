// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <optional>

#include "sweep/sweep_run.h"

namespace tautline {

/** Where runs are done: several at a time, in any order. */
class RunPool {
public:
    virtual ~RunPool() = default;
    /** Whether one more can begin. */
    virtual bool isFree() const = 0;
    /** Whether some have begun and not ended. */
    virtual bool isBusy() const = 0;
    /** Begins a run; there must be room. */
    virtual void start(int run) = 0;
    /** A run that has ended, after this time at most. */
    virtual std::optional<SweepResult> wait(std::chrono::milliseconds time) = 0;
};

}  // namespace tautline
