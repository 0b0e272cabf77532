// SPDX-License-Identifier: Apache-2.0
#include "mesh_thinning.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tautline {
namespace {

/** The first width of cells that is tried, as a share of the meshes' extent, and the factor to the next. */
constexpr double kFirstShare = 1.0 / 4096, kStep = 1.25;

/** Points of one cell. */
struct Cluster {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    int index = -1;  ///< in the new mesh; -1 until a triangle needs it
};

std::size_t countPoints(const std::vector<ReportPage::Mesh>& meshes) {
    std::size_t count = 0;
    for (const ReportPage::Mesh& mesh : meshes) count += mesh.points_M.size();
    return count;
}

double calcExtent(const std::vector<ReportPage::Mesh>& meshes) {
    double most = 0;
    for (const ReportPage::Mesh& mesh : meshes) {
        Eigen::AlignedBox3d box;
        for (const Vector3& point : mesh.points_M) box.extend(point);
        if (!box.isEmpty()) most = std::max(most, box.diagonal().norm());
    }
    return most;
}

}  // namespace

ReportPage::Mesh clusterPoints(const ReportPage::Mesh& mesh, double cell) {
    std::map<std::array<double, 3>, Cluster> clusters;
    std::vector<Cluster*> clusterOfPoint;
    for (const Vector3& point : mesh.points_M) {
        Cluster& cluster =
            clusters[{std::floor(point.x() / cell), std::floor(point.y() / cell), std::floor(point.z() / cell)}];
        cluster.sum += point;
        ++cluster.count;
        clusterOfPoint.push_back(&cluster);
    }
    ReportPage::Mesh clustered{mesh.body, mesh.X_BM, {}, {}};
    for (const auto& triangle : mesh.triangles) {
        std::array<Cluster*, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = clusterOfPoint[static_cast<std::size_t>(triangle[i])];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        std::array<int, 3> indices{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (corners[i]->index < 0) {
                corners[i]->index = static_cast<int>(clustered.points_M.size());
                clustered.points_M.push_back(corners[i]->sum / corners[i]->count);
            }
            indices[i] = corners[i]->index;
        }
        clustered.triangles.push_back(indices);
    }
    return clustered;
}

double thinMeshes(std::vector<ReportPage::Mesh>& meshes, std::size_t mostPoints) {
    if (countPoints(meshes) <= mostPoints) return 0;
    double cell = kFirstShare * calcExtent(meshes);
    std::vector<ReportPage::Mesh> thinned;
    do {
        cell *= kStep;
        thinned.clear();
        for (const ReportPage::Mesh& mesh : meshes) thinned.push_back(clusterPoints(mesh, cell));
    } while (countPoints(thinned) > mostPoints);
    meshes = std::move(thinned);
    return cell;
}

}  // namespace tautline
