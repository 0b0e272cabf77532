#pragma once

namespace tautline {

struct SimulationOptions {
    double duration = 1;     ///< [s]
    double interval = 0.01;  ///< between rows of the results [s]
    double accuracy = 1e-6;  ///< of the integrator
};

}  // namespace tautline
