// SPDX-License-Identifier: Apache-2.0
#include "tautline/meshes/triangle_mesh.h"

#include "tautline/error.h"

namespace tautline {

void requireMesh(const TriangleMesh& mesh) {
    require(!mesh.triangles.empty(), "mesh: has no triangles");
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        require(mesh.points[i].allFinite(), "mesh: points must be finite, but point ", i, " is (",
                mesh.points[i].transpose(), ")");
    const int count = static_cast<int>(mesh.points.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const int corner : mesh.triangles[i])
            require(corner >= 0 && corner < count, "mesh: triangle ", i, " has a corner at point ", corner,
                    ", but there are ", count, " points");
}

Vector3 calcDoubleArea(const TriangleMesh& mesh, int triangle) {
    const Vector3& a = mesh.getCorner(triangle, 0);
    return (mesh.getCorner(triangle, 1) - a).cross(mesh.getCorner(triangle, 2) - a);
}

double calcArea(const TriangleMesh& mesh) {
    double area = 0;
    for (int i = 0; i < mesh.countTriangles(); ++i) area += 0.5 * calcDoubleArea(mesh, i).norm();
    return area;
}

double calcVolume(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return 0;
    const Vector3 apex = mesh.getCorner(0, 0);  // near by, so that nothing large cancels
    double volume = 0;
    for (int i = 0; i < mesh.countTriangles(); ++i)
        volume += (mesh.getCorner(i, 0) - apex).dot(calcDoubleArea(mesh, i)) / 6;
    return volume;
}

Eigen::AlignedBox3d calcBox(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vector3& point : mesh.points) box.extend(point);
    return box;
}

}  // namespace tautline
