// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report_page.h"
#include "tautline/models/model_builder.h"

namespace tautline {

/** Where a mesh file is, by OpenSim's rule: a file with an absolute path there; any other beside the model, in the
folder Geometry beside the model, in the folders given, the last one first, and in $OPENSIM_HOME/Geometry.
@param folders   where the user keeps meshes
@return nothing if it is in none of them */
std::optional<std::filesystem::path> findMeshFile(const std::string& file, const std::filesystem::path& modelFile,
                                                  const std::vector<std::filesystem::path>& folders);

/** The meshes of a model's bodies, as far as they are found. */
struct Bones {
    std::vector<ReportPage::Mesh> meshes;
    /** A line for those that are in none of the folders, and one for each that cannot be read. */
    std::vector<std::string> notes;
};

/** Reads mesh files (mesh_file.h), with the scales that the model gives.
@param bodies   of the description */
Bones loadBones(const models::ModelDescription& description, const models::BuiltModel& bodies,
                const std::vector<std::filesystem::path>& folders);

}  // namespace tautline
