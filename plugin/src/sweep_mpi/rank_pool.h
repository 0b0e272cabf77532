// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <optional>
#include <vector>

#include "sweep/run_pool.h"

namespace tautline {

/** The other ranks of an MPI program, a run at a time each: rank 0 hands out numbers of runs and gets results back. A
rank that is not heard of for a while is lost; its run is given to another one, once. */
class RankPool : public RunPool {
public:
    /** @param patience   after which a silent rank is lost
    @throws std::runtime_error if there are no other ranks */
    explicit RankPool(std::chrono::milliseconds patience);

    bool isFree() const override;
    bool isBusy() const override;
    void start(int run) override;
    /** @throws std::runtime_error if all ranks are lost */
    std::optional<SweepResult> wait(std::chrono::milliseconds time) override;

    /** Sends all home. @return whether none was lost, so that MPI can end as it should */
    bool dismiss();

private:
    using Clock = std::chrono::steady_clock;

    struct Rank {
        int run = -1;  ///< -1: none
        bool isLost = false;
        Clock::time_point heard;
    };

    int findFree() const;
    void giveTo(int rank, int run);
    std::optional<SweepResult> receive();
    std::optional<SweepResult> loseSilentRanks();

    std::chrono::milliseconds m_patience;
    std::vector<Rank> m_ranks;     ///< by their numbers; the first is this one
    std::vector<int> m_givenBack;  ///< runs of lost ranks that wait for another one
    std::vector<int> m_lostRuns;   ///< all that a rank was lost with
};

/** What ranks other than 0 do: runs that they are given, until they are sent home.
@param pool   of one run at a time, in which they are done
@return whether MPI can end as it should */
bool serveRuns(RunPool& pool);

}  // namespace tautline
