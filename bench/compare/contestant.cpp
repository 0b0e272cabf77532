// SPDX-License-Identifier: Apache-2.0
#include "contestant.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace tautline::compare {
namespace {

/** CPU time of this process [s]. */
double getCpuTime() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Step>
double timeRound(int numPoses, const Step& step) {
    const double begin = getCpuTime();
    for (int k = 0; k < numPoses; ++k) step(k);
    return getCpuTime() - begin;
}

void updateError(Contestant& contestant, const std::vector<double>& lengths) {
    const int count = static_cast<int>(lengths.size());
    for (int k = 0; k < count; ++k) {
        const double error = std::abs(contestant.step(k) - lengths[static_cast<std::size_t>(k)]);
        contestant.error = error <= contestant.error ? contestant.error : error;  // no number is an error, too
    }
}

}  // namespace

int turnBack(int step, int numPoses) {
    return std::min(step, numPoses - 1 - step);
}

void runRounds(std::vector<Contestant>& contestants, const std::vector<double>& lengths, int numRounds) {
    const int count = static_cast<int>(lengths.size());
    for (Contestant& contestant : contestants) updateError(contestant, lengths);
    for (int round = 0; round < numRounds; ++round)
        for (Contestant& contestant : contestants) {
            contestant.seconds = std::min(contestant.seconds, timeRound(count, contestant.step));
            if (!contestant.without) continue;
            contestant.secondsWithout = std::min(contestant.secondsWithout, timeRound(count, contestant.without));
            contestant.step(0);  // back to where a round begins
        }
}

const Contestant& findContestant(const std::vector<Contestant>& contestants, const std::string& way) {
    const auto at = std::find_if(contestants.begin(), contestants.end(),
                                 [&](const Contestant& contestant) { return contestant.way == way; });
    if (at == contestants.end()) throw std::logic_error("no contestant '" + way + "'");
    return *at;
}

}  // namespace tautline::compare
