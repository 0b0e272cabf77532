#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "excitations.h"
#include "simulation_options.h"
#include "storage_file.h"
#include "tautline/models/model_system.h"

namespace tautline {

/** What one muscle's path did over a simulation. */
struct MuscleSummary {
    double largestPathError = 0;  ///< over accepted steps
    int contactsMade = 0, contactsLost = 0;
    int degradedSteps = 0;         ///< accepted steps whose path was no verified minimum
    std::string firstDegradation;  ///< status, reason and time of the first of them
};

struct SimulationResult {
    StorageTable states, paths;
    std::string events;  ///< events.csv: time,path,obstacle,kind
    std::vector<MuscleSummary> muscles;
    SimTK::State finalState;
    int acceptedSteps = 0;
    double seconds = 0;          ///< of wall time in the integration
    double wrappingSeconds = 0;  ///< of it in the path solver
};

/** Simulates a model forward under gravity and its muscles' excitations from its default pose.
@param reportProgress   called with the share done, 0 to 1
@return the recorded results; the same for the same input, bit for bit, but for the times */
SimulationResult simulate(models::ModelSystem& model, const std::map<std::string, Excitation>& excitations,
                          const SimulationOptions& options, const std::function<void(double)>& reportProgress);

}  // namespace tautline
