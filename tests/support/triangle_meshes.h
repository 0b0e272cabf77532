// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Triangle meshes of known shapes, at any fineness, and a bone that is none of them. */
#include <cmath>
#include <map>

#include "tautline/meshes/triangle_mesh.h"

namespace tautline::testing {

/** An icosahedron whose triangles are split in four `splits` times, its points on the ball of radius 1. */
inline TriangleMesh makeBallMesh(int splits) {
    const double g = 0.5 * (1 + std::sqrt(5.0));
    TriangleMesh mesh;
    mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vector3& point : mesh.points) point.normalize();
    for (int split = 0; split < splits; ++split) {
        std::map<std::pair<int, int>, int> middles;
        const auto getMiddle = [&](int a, int b) {
            const auto [found, isNew] = middles.emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
            if (isNew) {
                const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
                mesh.points.push_back((mesh.points[i] + mesh.points[k]).normalized());
            }
            return found->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const int ab = getMiddle(a, b), bc = getMiddle(b, c), ca = getMiddle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

inline TriangleMesh scaleMesh(TriangleMesh mesh, const Vector3& factors, const Vector3& shift = Vector3::Zero()) {
    for (Vector3& point : mesh.points) point = factors.cwiseProduct(point) + shift;
    return mesh;
}

/** Both in one, side by side or through each other. */
inline TriangleMesh joinMeshes(TriangleMesh mesh, const TriangleMesh& other) {
    const int shift = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + shift, b + shift, c + shift});
    return mesh;
}

/** Two triangles for each of the cells of a lattice over u and v that is closed in both.
@param point   of (u, v) in [0, 1)^2; xu x xv points outward */
template <class Function>
TriangleMesh makeRingMesh(int numU, int numV, Function&& point) {
    TriangleMesh mesh;
    const auto at = [&](int i, int j) { return i % numU * numV + j % numV; };
    for (int i = 0; i < numU; ++i)
        for (int j = 0; j < numV; ++j) {
            mesh.points.push_back(point(double(i) / numU, double(j) / numV));
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

/** About z, with numV cells around the tube. */
inline TriangleMesh makeTorusMesh(double ringRadius, double tubeRadius, int numV) {
    const int numU = static_cast<int>(std::lround(numV * ringRadius / tubeRadius));
    return makeRingMesh(numU, numV, [=](double u, double v) {
        const double rho = ringRadius + tubeRadius * std::cos(2 * kPi * v);
        return Vector3(rho * std::cos(2 * kPi * u), rho * std::sin(2 * kPi * u), tubeRadius * std::sin(2 * kPi * v));
    });
}

/** A long bone along z, 0.3 m long, of some 12 mm in the middle of its shaft and twice that at the ends, bent and with
a ridge: as large and as finely scanned as a humerus. @param fineness   1: edges of some 6 mm */
inline TriangleMesh makeBoneMesh(int fineness = 1) {
    TriangleMesh mesh = makeBallMesh(3 + fineness);
    for (Vector3& point : mesh.points) {
        const double z = 0.15 * point.z(), along = point.z(), around = std::atan2(point.y(), point.x());
        const double out = std::hypot(point.x(), point.y());
        const double round = std::pow(1 - std::pow(along, 8), 0.5);  // a tube with rounded ends
        const double radius = 0.012 * (1 + std::pow(along, 4)) * (1 + 0.15 * std::cos(2 * around + 2 * along));
        const double scale = out > 0 ? round * radius / out : 0;
        point = Vector3(scale * point.x() + 0.01 * along * along, scale * point.y(), z);
    }
    return mesh;
}

}  // namespace tautline::testing
