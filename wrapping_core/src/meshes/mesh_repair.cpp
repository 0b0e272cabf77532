// SPDX-License-Identifier: Apache-2.0
#include "tautline/meshes/mesh_repair.h"

#include <algorithm>
#include <map>
#include <set>

#include "tautline/error.h"

namespace tautline {
namespace {

using Triangle = std::array<int, 3>;
using Edge = std::pair<int, int>;

constexpr double kSamePlace = 1e-9;  ///< of the box's diagonal: half the digits of a float in files are far above it
constexpr double kFarthest = 1e30;   ///< [m]: powers of it, as they stand in areas and curvatures, are numbers
constexpr double kNoArea = 1e-12;    ///< double area of a triangle over its longest edge squared

Edge sortEdge(int a, int b) {
    return {std::min(a, b), std::max(a, b)};
}

/** Points that round to the same place of a fine lattice become one. */
void mergePoints(RepairedMesh& repaired) {
    TriangleMesh& mesh = repaired.mesh;
    const Eigen::AlignedBox3d box = calcBox(mesh);
    const double cell = std::max(kSamePlace * box.diagonal().norm(), 1e-300);
    std::map<std::array<double, 3>, int> places;
    std::vector<int> newIndex;
    std::vector<Vector3> points;
    for (const Vector3& point : mesh.points) {
        const Vector3 place = ((point - box.min()) / cell).array().round();
        const auto [found, isNew] = places.emplace(std::array<double, 3>{place.x(), place.y(), place.z()}, 0);
        if (isNew) found->second = static_cast<int>(points.size()), points.push_back(point);
        newIndex.push_back(found->second);
    }
    repaired.mergedPoints = static_cast<int>(mesh.points.size() - points.size());
    mesh.points = std::move(points);
    for (Triangle& triangle : mesh.triangles)
        for (int& corner : triangle) corner = newIndex[static_cast<std::size_t>(corner)];
}

bool isEmpty(const TriangleMesh& mesh, int triangle) {
    double longest = 0;
    for (int i = 0; i < 3; ++i)
        longest =
            std::max(longest, (mesh.getCorner(triangle, (i + 1) % 3) - mesh.getCorner(triangle, i)).squaredNorm());
    return !(calcDoubleArea(mesh, triangle).norm() > kNoArea * longest);
}

void dropUseless(RepairedMesh& repaired) {
    TriangleMesh& mesh = repaired.mesh;
    std::set<Triangle> seen;
    std::vector<Triangle> kept;
    for (int i = 0; i < mesh.countTriangles(); ++i) {
        Triangle corners = mesh.triangles[static_cast<std::size_t>(i)];
        if (isEmpty(mesh, i)) {
            ++repaired.emptyTriangles;
            continue;
        }
        std::sort(corners.begin(), corners.end());
        if (seen.insert(corners).second)
            kept.push_back(mesh.triangles[static_cast<std::size_t>(i)]);
        else
            ++repaired.doubleTriangles;
    }
    require(!kept.empty(), "mesh: none of its ", mesh.triangles.size(), " triangles has an area");
    mesh.triangles = std::move(kept);
}

/** Which triangles meet at each edge. */
std::map<Edge, std::vector<int>> findEdges(const TriangleMesh& mesh) {
    std::map<Edge, std::vector<int>> edges;
    for (int i = 0; i < mesh.countTriangles(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Triangle& corners = mesh.triangles[static_cast<std::size_t>(i)];
            edges[sortEdge(corners[k], corners[(k + 1) % 3])].push_back(i);
        }
    return edges;
}

bool runsAlong(const Triangle& triangle, int from, int to) {
    for (int k = 0; k < 3; ++k)
        if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
    return false;
}

/** Goes from triangle to triangle over edges that two of them share, and turns those that face the other way.
@return the parts, as numbers of triangles */
std::vector<std::vector<int>> turnAlike(RepairedMesh& repaired) {
    std::vector<Triangle>& triangles = repaired.mesh.triangles;
    const auto edges = findEdges(repaired.mesh);
    for (const auto& entry : edges) repaired.edgesOfManyFaces += entry.second.size() > 2;
    std::vector<char> isDone(triangles.size(), 0);
    std::vector<std::vector<int>> parts;
    for (int seed = 0; seed < repaired.mesh.countTriangles(); ++seed) {
        if (isDone[static_cast<std::size_t>(seed)]) continue;
        isDone[static_cast<std::size_t>(seed)] = 1;
        std::vector<int> part{seed};
        for (std::size_t at = 0; at < part.size(); ++at) {
            const Triangle here = triangles[static_cast<std::size_t>(part[at])];
            for (int k = 0; k < 3; ++k) {
                const int from = here[k], to = here[(k + 1) % 3];
                const std::vector<int>& sharing = edges.at(sortEdge(from, to));
                if (sharing.size() != 2) continue;
                const int next = sharing[0] == part[at] ? sharing[1] : sharing[0];
                if (isDone[static_cast<std::size_t>(next)]) continue;
                isDone[static_cast<std::size_t>(next)] = 1;
                Triangle& other = triangles[static_cast<std::size_t>(next)];
                if (runsAlong(other, from, to)) std::swap(other[1], other[2]);
                part.push_back(next);
            }
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

/** Volume between the triangles of a part and the middle of its box: of an open one, too, it tells which way it faces.
 */
double calcPartVolume(const TriangleMesh& mesh, const std::vector<int>& part) {
    Eigen::AlignedBox3d box;
    for (const int i : part)
        for (int corner = 0; corner < 3; ++corner) box.extend(mesh.getCorner(i, corner));
    double volume = 0;
    for (const int i : part) volume += (mesh.getCorner(i, 0) - box.center()).dot(calcDoubleArea(mesh, i)) / 6;
    return volume;
}

void turnOutward(RepairedMesh& repaired) {
    const std::vector<Triangle> before = repaired.mesh.triangles;
    const std::vector<std::vector<int>> parts = turnAlike(repaired);
    repaired.parts = static_cast<int>(parts.size());
    std::vector<Triangle>& triangles = repaired.mesh.triangles;
    for (const std::vector<int>& part : parts)
        if (calcPartVolume(repaired.mesh, part) < 0)
            for (const int i : part)
                std::swap(triangles[static_cast<std::size_t>(i)][1], triangles[static_cast<std::size_t>(i)][2]);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        repaired.turnedTriangles += !runsAlong(before[i], triangles[i][0], triangles[i][1]);
}

/** Closed chains of the edges that only one triangle has, in the direction in which a triangle of the hole has them. */
std::vector<std::vector<int>> findRims(const TriangleMesh& mesh) {
    std::multimap<int, int> next;
    for (const auto& [edge, sharing] : findEdges(mesh)) {
        if (sharing.size() != 1) continue;
        const bool isAlong = runsAlong(mesh.triangles[static_cast<std::size_t>(sharing[0])], edge.first, edge.second);
        if (isAlong)
            next.emplace(edge.second, edge.first);
        else
            next.emplace(edge.first, edge.second);
    }
    std::vector<std::vector<int>> rims;
    while (!next.empty()) {
        std::vector<int> rim{next.begin()->first};
        for (auto edge = next.begin(); edge != next.end(); edge = next.find(rim.back())) {
            const int to = edge->second;
            next.erase(edge);
            // Back at a point of the rim: what lies between is a hole of its own.
            const auto before = std::find(rim.begin(), rim.end(), to);
            if (before == rim.end()) {
                rim.push_back(to);
                continue;
            }
            rims.emplace_back(before, rim.end());
            rim.erase(before + 1, rim.end());
        }
    }
    return rims;
}

void closeHoles(RepairedMesh& repaired) {
    TriangleMesh& mesh = repaired.mesh;
    for (const std::vector<int>& rim : findRims(mesh)) {
        if (rim.size() < 3) continue;
        Eigen::AlignedBox3d box;
        Vector3 middle = Vector3::Zero();
        for (const int point : rim) {
            box.extend(mesh.points[static_cast<std::size_t>(point)]);
            middle += mesh.points[static_cast<std::size_t>(point)] / static_cast<double>(rim.size());
        }
        const int apex = static_cast<int>(mesh.points.size());
        mesh.points.push_back(middle);
        for (std::size_t k = 0; k < rim.size(); ++k) {
            mesh.triangles.push_back({rim[k], rim[(k + 1) % rim.size()], apex});
            ++repaired.addedTriangles;
            repaired.addedArea += 0.5 * calcDoubleArea(mesh, mesh.countTriangles() - 1).norm();
        }
        ++repaired.closedHoles;
        repaired.widestHole = std::max(repaired.widestHole, box.sizes().maxCoeff());
    }
}

}  // namespace

RepairedMesh repairMesh(const TriangleMesh& mesh) {
    requireMesh(mesh);
    for (const Vector3& point : mesh.points)
        require(point.cwiseAbs().maxCoeff() <= kFarthest, "mesh: points must be no farther than ", kFarthest,
                " m from the origin, but one is (", point.transpose(), ")");
    RepairedMesh repaired;
    repaired.mesh = mesh;
    mergePoints(repaired);
    dropUseless(repaired);
    turnOutward(repaired);
    closeHoles(repaired);
    return repaired;
}

}  // namespace tautline
