// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tautline {

/** Where the path of a solve came from. In the order in which they are tried: start_strategies.h. */
enum class StartStrategy {
    None,           ///< the solve has not begun
    Continued,      ///< from the path that was given
    AlongPrevious,  ///< from an elastic band laid along that path
    Inserted,       ///< from the straight line: obstacles were touched as they were met, on the sides asked for
    Band,           ///< from an elastic band laid along the route asked for
    Released,       ///< from an elastic band laid without the hints, since along them it had slipped off
};

/** A short word for tables: "continued", "band", ... */
const char* getName(StartStrategy strategy);

/** How a solve went, beside its path. */
struct SolveReport {
    StartStrategy strategy = StartStrategy::None;  ///< that the path came from
    int bandLevel = 0;                             ///< fineness of the band that it came from, from 1; 0: none
    bool usedMinimizer = false;                    ///< Newton's method did not lead on somewhere on the way
    bool turnedTangents = false;                   ///< a stationary path that turned back was turned round
    bool leftSaddle = false;                       ///< a saddle was left along its direction of negative curvature
    int failedSteps = 0;  ///< continued solves since the path last was a minimum: each new search waits twice as long
};

}  // namespace tautline
