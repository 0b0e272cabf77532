// SPDX-License-Identifier: Apache-2.0
#pragma once
/** With what a simulation begins where it is not the model's default. */
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact_record.h"
#include "motion_file.h"
#include "tautline/models/model_system.h"

namespace tautline {

struct InitialState {
    double time = 0.0;                           ///< [s]
    std::map<std::string, double> values;        ///< of coordinates [rad or m]
    std::map<std::string, double> speeds;        ///< of coordinates [rad/s or m/s]
    std::map<std::string, double> activations;   ///< of muscles
    std::map<std::string, double> fiberLengths;  ///< of muscles [m]
    /** Of all paths, where a run goes on; none: as the model says, or found anew. */
    std::optional<std::vector<RecordedContact>> contacts;

    /** Sets time, coordinates and speeds, then lets constraints have their way. Realizes the State to Position.
    @throws models::ModelError if constraints cannot be met near the pose, or a joint is singular there */
    void setPose(const models::ModelSystem& model, SimTK::State& state) const;
    /** Sets activations and fiber lengths; fibers that are not given are put where they and their tendons pull alike at
    rest. Stage: Position. @return that equilibrium, muscle by muscle */
    std::vector<MuscleEquilibrium> setMuscles(const models::ModelSystem& model, SimTK::State& state) const;
};

/** Reads one row of a states file: values and speeds of coordinates, activations and fiber lengths of muscles.
@param time   linear between the rows; none: the first row, and its time
@param notes   columns that play no part are added
@throws std::runtime_error if the file has no such time, or an activation or length that cannot be */
InitialState readStates(const std::filesystem::path& file, const models::ModelDescription& description,
                        std::optional<double> time, std::vector<std::string>& notes);

}  // namespace tautline
