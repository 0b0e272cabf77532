// SPDX-License-Identifier: Apache-2.0
#include "bone_meshes.h"

#include <cstdlib>
#include <map>

#include "name_pattern.h"
#include "tautline/models/mesh_file.h"
#include "tautline/models/model_error.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

namespace fs = std::filesystem;

std::optional<fs::path> findMeshFile(const std::string& file, const fs::path& modelFile,
                                     const std::vector<fs::path>& folders) {
    std::vector<fs::path> candidates;
    if (fs::path(file).is_absolute()) {
        candidates = {file};
    } else {
        const fs::path beside = modelFile.parent_path();
        candidates = {beside / file, beside / "Geometry" / file};
        for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) candidates.push_back(*folder / file);
        if (const char* home = std::getenv("OPENSIM_HOME")) candidates.push_back(fs::path(home) / "Geometry" / file);
    }
    std::error_code ignored;
    for (const fs::path& candidate : candidates)
        if (fs::is_regular_file(candidate, ignored)) return candidate;
    return std::nullopt;
}

Bones loadBones(const models::ModelDescription& description, const models::BuiltModel& bodies,
                const std::vector<fs::path>& folders) {
    Bones bones;
    std::map<std::string, std::optional<TriangleMesh>> files;  // nothing: it cannot be drawn
    std::vector<std::string> missing;
    for (const models::BodyMesh& bone : description.meshes) {
        const auto [entry, isNew] = files.try_emplace(bone.file);
        if (isNew) {
            const auto path = findMeshFile(bone.file, description.fileName, folders);
            if (!path) missing.push_back(bone.file);
            if (path) try {
                    entry->second = models::readMeshFile(*path);
                } catch (const models::ModelError& error) {
                    bones.notes.push_back("a mesh is not drawn: " + std::string(error.what()));
                }
        }
        if (!entry->second) continue;
        ReportPage::Mesh mesh{bodies.getBodyIndex(bone.body), toTransform(bone.X_BM), entry->second->points,
                              entry->second->triangles};
        for (Vector3& point : mesh.points_M) point = point.cwiseProduct(bone.scale);
        bones.meshes.push_back(std::move(mesh));
    }
    if (!missing.empty())
        bones.notes.push_back(
            std::to_string(missing.size()) + " of " + std::to_string(files.size()) +
            " bone meshes are not found and not drawn (--geometry FOLDER says where they are): " + listNames(missing));
    return bones;
}

}  // namespace tautline
