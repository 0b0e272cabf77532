// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "excitations.h"
#include "initial_state.h"
#include "simulation_options.h"
#include "storage_file.h"
#include "tautline/models/model_system.h"

namespace tautline {

/** What the path of a muscle or spring did over a simulation. */
struct PathSummary {
    CableStatistics statistics;
    /** Without a verified minimum. Objects that a point has entered are switched off as in OpenSim, which is no fault.
     */
    long degradedSteps = 0;
    int contactsMade = 0, contactsLost = 0, slips = 0;
    int switches = 0;              ///< of obstacles that a point has entered or left, or whose ends the path has
    double slippedLength = 0;      ///< by which the slips have shortened it [m]
    std::string firstDegradation;  ///< status, reason and time of the first degraded step
};

/** What a muscle did over a simulation. */
struct MuscleSummary {
    MuscleEquilibrium start;  ///< from which it began
    double longestFiber = 0;  ///< in optimal fiber lengths, at the accepted steps
    double longestAt = 0;     ///< when [s]
};

/** How a simulation ended. */
struct SimulationEnding {
    enum class Kind {
        Finished,
        Interrupted,  ///< as the caller wished
        Stuck,        ///< the state is no longer finite, or changes faster than any step can follow
    };
    Kind kind = Kind::Finished;
    double time = 0;     ///< [s]
    std::string reason;  ///< if stuck: which coordinate or muscle, in words
};

struct SimulationResult {
    SimulationEnding ending;
    StorageTable states, paths;
    StorageTable muscles;     ///< fibers, tendons, forces, powers; without columns if the model has no muscles
    StorageTable clearances;  ///< where each obstacle stands to the straight segment that passes it
    std::string events;       ///< events.csv: time,path,obstacle,kind,length_change
    std::string contacts;     ///< contacts.csv of the end: makeContactText()
    std::string starts;       ///< start.csv: path,iteration,obstacle,error; empty if the model gives no starts
    std::vector<PathSummary> summaries;          ///< in the order of ModelSystem::getPaths()
    std::vector<MuscleSummary> muscleSummaries;  ///< in the order of ModelSystem::getMuscles()
    SimTK::State finalState;
    int acceptedSteps = 0;
    double seconds = 0;          ///< of wall time in the integration
    double wrappingSeconds = 0;  ///< of it in the path solver
};

/** Simulates a model forward under gravity and its muscles' excitations from an initial state, with fibers and tendons
in equilibrium where that does not say otherwise. Paths for which the model gives geodesics to start from begin with
what these lead to, others with what the solver finds.
@param reportProgress   called with the share done, 0 to 1
@param watchRow   if there is one: called with the State of each row, realized to Velocity
@param initial   its time is that at which the simulation begins
@param isInterrupted   asked after each step whether to end; null: never
@throws InvalidInput as SimulationOptions::validate(), std::runtime_error if a start that the model gives leads to no
path, ModelError as InitialState::setPose()
@return the recorded results; the same for the same input, bit for bit, but for the times */
SimulationResult simulate(models::ModelSystem& model, const std::map<std::string, Excitation>& excitations,
                          const SimulationOptions& options, const std::function<void(double)>& reportProgress,
                          const std::function<void(const SimTK::State&)>& watchRow = nullptr,
                          const InitialState& initial = {}, const std::function<bool()>& isInterrupted = nullptr);

}  // namespace tautline
