// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The answers of a PathStudy as files. */
#include <string>
#include <vector>

#include "storage_file.h"
#include "tautline/models/path_study.h"

namespace tautline {

/** Of each path length, rate, status (0 solved, 1 not_minimum, 2 left_domain, 3 end_inside, 4 not_converged), whether
it follows its hints, and by obstacle whether it is touched or switched off. */
StorageTable makePathTable(const models::PathStudy& study, const std::vector<double>& times,
                           const std::vector<models::PoseAnswer>& answers);

/** Of each path and each coordinate that it crosses the effective and the geometric moment arm. */
StorageTable makeMomentArmTable(const models::PathStudy& study, const std::vector<double>& times,
                                const std::vector<models::PoseAnswer>& answers);

/** Values and speeds of all coordinates as OpenSim's states files have them. */
StorageTable makeCoordinateTable(const models::PathStudy& study, const std::vector<double>& times,
                                 const std::vector<models::PoseAnswer>& answers);

/** time,path,status,explanation: a row for each path and frame with something to explain; frames whose constraints
are broken have one without a path. */
std::string makeStatusText(const models::PathStudy& study, const std::vector<double>& times,
                           const std::vector<models::PoseAnswer>& answers);

}  // namespace tautline
