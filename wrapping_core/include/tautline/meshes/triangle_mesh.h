// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Triangles in space, as scanners and modelers leave them. */
#include <array>
#include <vector>

#include "tautline/types.h"

namespace tautline {

struct TriangleMesh {
    std::vector<Vector3> points;                ///< [m], in the mesh's own frame
    std::vector<std::array<int, 3>> triangles;  ///< indices of points, counterclockwise seen from outside

    const Vector3& getCorner(int triangle, int corner) const {
        return points[static_cast<std::size_t>(triangles[static_cast<std::size_t>(triangle)][corner])];
    }
    int countTriangles() const { return static_cast<int>(triangles.size()); }
};

/** Refuses a mesh without triangles, a point that is not finite, and an index without a point (InvalidInput, with the
number of point or triangle, counted from 0). */
void requireMesh(const TriangleMesh& mesh);

/** Twice the area of a triangle along its normal [m^2]. */
Vector3 calcDoubleArea(const TriangleMesh& mesh, int triangle);

/** Area [m^2], and volume [m^3] by the divergence theorem: exact for a closed mesh, positive if it faces outward. */
double calcArea(const TriangleMesh& mesh);
double calcVolume(const TriangleMesh& mesh);

Eigen::AlignedBox3d calcBox(const TriangleMesh& mesh);

}  // namespace tautline
