// SPDX-License-Identifier: Apache-2.0
#include "page_options.h"

#include <algorithm>
#include <sstream>

#include "command_options.h"
#include "mesh_thinning.h"
#include "model_report.h"
#include "storage_file.h"
#include "text_table.h"

namespace tautline {
namespace {

/** Surfaces of a page have so many points in all, and none fewer than the second number for its share: what a phone
draws smoothly. */
constexpr std::size_t kMostSurfacePoints = 20000, kLeastShare = 300;

/** Each to its share. */
void thinSurfaces(std::vector<ReportPage::Mesh>& surfaces) {
    const std::size_t share = std::max(kLeastShare, kMostSurfacePoints / std::max<std::size_t>(1, surfaces.size()));
    for (ReportPage::Mesh& surface : surfaces) {
        std::vector<ReportPage::Mesh> one{std::move(surface)};
        thinMeshes(one, share);
        surface = std::move(one.front());
    }
}

}  // namespace

void PageOptions::declare(CLI::App& app, const std::string& what) {
    app.add_option("--report", report, "write a page (.html) to look at " + what);
    addRepeatable(app, "--geometry", geometry,
                  "folder of bone meshes (.vtp, .obj, .stl), searched after the model's own and its Geometry");
}

Bones loadBones(const PageOptions& options, const models::ModelDescription& description,
                const models::BuiltModel& bodies, std::ostream& out) {
    Bones bones = loadBones(description, bodies, options.geometry);
    for (const std::string& note : bones.notes) out << "note: " << note << "\n";
    return bones;
}

void writePage(ReportPage page, const PageOptions& options, const models::ModelDescription& description,
               const SceneRecorder& scene, const Bones& bones, std::ostream& out) {
    page.title = description.name;
    std::ostringstream summary;
    printModelSummary(description, summary);
    page.summary = summary.str();
    scene.addTo(page);
    thinSurfaces(page.surfaces);
    page.bones = bones.meshes;
    const double cell = thinMeshes(page.bones, kMostBonePoints);
    if (options.report.has_parent_path()) std::filesystem::create_directories(options.report.parent_path());
    writeWhole(writePage(page), options.report);
    out << "page: " << options.report.string();
    if (cell > 0) out << ", bones rounded to " << format(1e3 * cell, 1) << " mm";
    out << "\n";
}

}  // namespace tautline
