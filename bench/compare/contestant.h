// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Several ways to solve one row of poses, timed side by side. */
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tautline::compare {

/** One way to find the length of a path in pose after pose. */
struct Contestant {
    std::string way;                        ///< as the table names it
    std::function<double(int pose)> step;   ///< solves in a pose of the row; length [m]
    std::function<void(int pose)> without;  ///< what the step does besides, such as moving bodies; null: nothing
    const char* rival = nullptr;            ///< the way that it is divided by; null: none

    double seconds = std::numeric_limits<double>::infinity();         ///< CPU time of a round, least of all
    double secondsWithout = std::numeric_limits<double>::infinity();  ///< of what the steps do besides
    double error = 0;                                                 ///< largest, of a length [m]

    /** CPU time of the path in one pose [us]. */
    double calcMicroseconds(int numPoses) const {
        const double besides = without ? secondsWithout : 0;
        return 1e6 * (seconds - besides) / numPoses;
    }
};

/** Poses there and back, so that a round begins next to where the one before has ended. */
int turnBack(int step, int numPoses);

/** Runs all contestants in turn, round after round, so that each of them sees the same machine; the least time counts,
since what others do on it only adds. The first round counts no time, but errors.
@param lengths   exact, by pose [m] */
void runRounds(std::vector<Contestant>& contestants, const std::vector<double>& lengths, int numRounds);

/** @throws std::logic_error if there is none of this name */
const Contestant& findContestant(const std::vector<Contestant>& contestants, const std::string& way);

}  // namespace tautline::compare
