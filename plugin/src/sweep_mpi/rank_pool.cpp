// SPDX-License-Identifier: Apache-2.0
#include "sweep_mpi/rank_pool.h"

#include <mpi.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "storage_file.h"
#include "sweep/sweep_journal.h"

namespace tautline {
namespace {

enum Tag { kRun = 1, kResult = 2, kAlive = 3 };
constexpr int kGoHome = -1;
constexpr int kGoWithoutFarewell = -2;  ///< a rank is lost, for which MPI's end would wait forever
constexpr std::chrono::milliseconds kStep(5);
constexpr std::chrono::milliseconds kBetweenSigns(200);  ///< of life

void send(int rank, Tag tag, const std::string& text) {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

void sendRun(int rank, int run) {
    MPI_Send(&run, 1, MPI_INT, rank, kRun, MPI_COMM_WORLD);
}

/** A message that has come; false if none has. */
bool probe(MPI_Status& status) {
    int has = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has, &status);
    return has != 0;
}

}  // namespace

RankPool::RankPool(std::chrono::milliseconds patience) : m_patience(patience) {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size < 2) throw std::runtime_error("there is one rank alone, which hands out work that no other one does");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);  // what is sent to a dead rank is lost
    m_ranks.resize(static_cast<std::size_t>(size));
    for (Rank& rank : m_ranks) rank.heard = Clock::now();
}

int RankPool::findFree() const {
    for (std::size_t i = 1; i < m_ranks.size(); ++i)
        if (!m_ranks[i].isLost && m_ranks[i].run < 0) return static_cast<int>(i);
    return -1;
}

bool RankPool::isFree() const {
    return m_givenBack.empty() && findFree() >= 0;
}

bool RankPool::isBusy() const {
    return !m_givenBack.empty() ||
           std::any_of(m_ranks.begin(), m_ranks.end(), [](const Rank& r) { return r.run >= 0; });
}

void RankPool::giveTo(int rank, int run) {
    m_ranks[static_cast<std::size_t>(rank)].run = run;
    sendRun(rank, run);
}

void RankPool::start(int run) {
    giveTo(findFree(), run);
}

std::optional<SweepResult> RankPool::receive() {
    MPI_Status status;
    while (probe(status)) {
        int size = 0;
        MPI_Get_count(&status, MPI_CHAR, &size);
        std::string text(static_cast<std::size_t>(size), ' ');
        MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        Rank& rank = m_ranks[static_cast<std::size_t>(status.MPI_SOURCE)];
        rank.heard = Clock::now();
        if (status.MPI_TAG != kResult || rank.isLost) continue;  // given to another one meanwhile
        rank.run = -1;
        return parseResult(text);
    }
    return {};
}

/** @return what is to be said of a run with which a second rank was lost */
std::optional<SweepResult> RankPool::loseSilentRanks() {
    for (std::size_t i = 1; i < m_ranks.size(); ++i) {
        Rank& rank = m_ranks[i];
        if (rank.isLost || Clock::now() - rank.heard < m_patience) continue;
        rank.isLost = true;
        const int run = std::exchange(rank.run, -1);
        std::cerr << "warning: rank " << i << " is lost: not heard of for " << toText(1e-3 * m_patience.count()) << " s"
                  << (run < 0 ? "" : ", with run " + std::to_string(run)) << std::endl;
        if (run < 0) continue;
        if (std::count(m_lostRuns.begin(), m_lostRuns.end(), run) > 0)
            return SweepResult{run, -1, "two ranks were lost with it", {}};
        m_lostRuns.push_back(run);
        m_givenBack.push_back(run);
    }
    return {};
}

std::optional<SweepResult> RankPool::wait(std::chrono::milliseconds time) {
    for (std::chrono::milliseconds waited(0);; waited += kStep) {
        if (std::optional<SweepResult> result = receive()) return result;
        if (std::optional<SweepResult> result = loseSilentRanks()) return result;
        while (!m_givenBack.empty() && findFree() >= 0) {
            giveTo(findFree(), m_givenBack.back());
            m_givenBack.pop_back();
        }
        if (std::all_of(m_ranks.begin() + 1, m_ranks.end(), [](const Rank& r) { return r.isLost; }))
            throw std::runtime_error("all ranks are lost; the same command goes on from here");
        if (waited >= time) return {};
        std::this_thread::sleep_for(kStep);
    }
}

bool RankPool::dismiss() {
    const bool isWhole = std::none_of(m_ranks.begin(), m_ranks.end(), [](const Rank& r) { return r.isLost; });
    for (std::size_t i = 1; i < m_ranks.size(); ++i)
        if (!m_ranks[i].isLost) sendRun(static_cast<int>(i), isWhole ? kGoHome : kGoWithoutFarewell);
    return isWhole;
}

bool serveRuns(RunPool& pool) {
    auto lastSign = std::chrono::steady_clock::now();
    for (;;) {
        if (std::chrono::steady_clock::now() - lastSign > kBetweenSigns) {
            send(0, kAlive, "");
            lastSign = std::chrono::steady_clock::now();
        }
        MPI_Status status;
        if (probe(status)) {
            int run = 0;
            MPI_Recv(&run, 1, MPI_INT, 0, kRun, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            if (run < 0) return run == kGoHome;
            pool.start(run);
        }
        if (const std::optional<SweepResult> result = pool.wait(kStep)) send(0, kResult, toLine(*result));
    }
}

}  // namespace tautline
