// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <vector>

#include "tautline/meshes/triangle_mesh.h"

namespace tautline {

/** The part of a mesh that a patch of heights is fitted to. */
struct PatchRegion {
    Pose X_MP;  ///< frame of the patch in that of the mesh: heights along z, the longer side along x
    std::vector<Vector3> points_P;  ///< corners of the triangles that face up [m]
};

/** The corners, in a box, of the triangles that face a direction: those whose normals are within 60 degrees of it.
@param toward   z of the patch, in the frame of the mesh; without it, the normal of the plane next to all corners in the
                box, to the side where more of the mesh's area faces
@param box      of the mesh's frame; empty: all of the mesh
@throws InvalidInput if the direction is zero or no triangle is left */
PatchRegion findPatchRegion(const TriangleMesh& mesh, const std::optional<Vector3>& toward,
                            const Eigen::AlignedBox3d& box);

}  // namespace tautline
