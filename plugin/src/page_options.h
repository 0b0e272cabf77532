// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "bone_meshes.h"
#include "scene_recorder.h"

namespace tautline {

/** What `run` and `solve` know of the page to look at. */
struct PageOptions {
    std::filesystem::path report;                 ///< the page; empty: none
    std::vector<std::filesystem::path> geometry;  ///< folders of bone meshes

    /** Declares --report and --geometry. */
    void declare(CLI::App& app, const std::string& what);
};

/** Bones of a page are thinned to so many points: 24 bytes each with their triangles, half a megabyte in all. */
inline constexpr std::size_t kMostBonePoints = 20000;

/** Prints what of the model's bones is not drawn. */
Bones loadBones(const PageOptions& options, const models::ModelDescription& description,
                const models::BuiltModel& bodies, std::ostream& out);

/** Adds scene, bones and first lines to a page that has all else, writes it, and says so. */
void writePage(ReportPage page, const PageOptions& options, const models::ModelDescription& description,
               const SceneRecorder& scene, const Bones& bones, std::ostream& out);

}  // namespace tautline
