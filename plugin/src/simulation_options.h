// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tautline {

struct SimulationOptions {
    double duration = 1;          ///< [s], at most 1e6
    double interval = 0.01;       ///< between rows of the results [s], so that there are no more than 1e7
    double accuracy = 1e-6;       ///< of the integrator, in [1e-14, 0.1]
    bool recordsAllArms = false;  ///< moment arms also of coordinates that a path does not cross

    /** @throws InvalidInput naming the option of the command, its value and its limits */
    void validate() const;

    /** Besides the one at the start. */
    int calcNumRows() const;
};

}  // namespace tautline
