// SPDX-License-Identifier: Apache-2.0
#include "patch_region.h"

#include <Eigen/Eigenvalues>
#include <set>

#include "tautline/error.h"

namespace tautline {
namespace {

constexpr double kLeastFacing = 0.5;  ///< cosine between a normal and the direction

/** Axes of inertia of a cloud, the one of least spread first. */
Matrix3 findAxes(const std::vector<Vector3>& points) {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& p : points) mean += p / static_cast<double>(points.size());
    Matrix3 spread = Matrix3::Zero();
    for (const Vector3& p : points) spread += (p - mean) * (p - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Matrix3>(spread).eigenvectors();
}

/** Numbers of the triangles that have all corners in the box. */
std::vector<int> findTriangles(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box) {
    std::vector<int> found;
    for (int i = 0; i < mesh.countTriangles(); ++i) {
        bool isIn = true;
        for (int k = 0; k < 3; ++k) isIn = isIn && (box.isEmpty() || box.contains(mesh.getCorner(i, k)));
        if (isIn) found.push_back(i);
    }
    require(!found.empty(), "patch: no triangle of the mesh lies in the box");
    return found;
}

/** Each point once, however many triangles it is a corner of. */
std::vector<Vector3> getCorners(const TriangleMesh& mesh, const std::vector<int>& triangles) {
    std::set<int> numbers;
    for (const int i : triangles)
        numbers.insert(mesh.triangles[static_cast<std::size_t>(i)].begin(),
                       mesh.triangles[static_cast<std::size_t>(i)].end());
    std::vector<Vector3> points;
    for (const int number : numbers) points.push_back(mesh.points[static_cast<std::size_t>(number)]);
    return points;
}

Vector3 findDirection(const TriangleMesh& mesh, const std::vector<int>& triangles) {
    const Vector3 normal = findAxes(getCorners(mesh, triangles)).col(0);
    double balance = 0;
    for (const int i : triangles) balance += calcDoubleArea(mesh, i).dot(normal);
    return balance < 0 ? Vector3(-normal) : normal;
}

}  // namespace

PatchRegion findPatchRegion(const TriangleMesh& mesh, const std::optional<Vector3>& toward,
                            const Eigen::AlignedBox3d& box) {
    const std::vector<int> inBox = findTriangles(mesh, box);
    if (toward) require(toward->norm() > 0, "patch: the direction that it faces must not be zero");
    const Vector3 z = toward ? Vector3(toward->normalized()) : findDirection(mesh, inBox);
    std::vector<int> facing;
    for (const int i : inBox)
        if (calcDoubleArea(mesh, i).dot(z) > kLeastFacing * calcDoubleArea(mesh, i).norm()) facing.push_back(i);
    require(!facing.empty(), "patch: none of ", inBox.size(), " triangles faces the direction (", z.transpose(), ")");
    const std::vector<Vector3> points = getCorners(mesh, facing);
    std::vector<Vector3> flat;
    for (const Vector3& p : points) flat.push_back(p - z.dot(p) * z);
    PatchRegion region;
    const Vector3 x = findAxes(flat).col(2);  // of the greatest spread in the plane
    region.X_MP.R << x, z.cross(x), z;
    for (const Vector3& p : points) region.X_MP.p += p / static_cast<double>(points.size());
    for (const Vector3& p : points) region.points_P.push_back(region.X_MP.shiftBack(p));
    return region;
}

}  // namespace tautline
