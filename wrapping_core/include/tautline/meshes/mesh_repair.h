// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Closes and turns meshes as bone scans have them, so that each has an inside. */
#include "tautline/meshes/triangle_mesh.h"

namespace tautline {

/** A mesh put in order, and what had to be done to it. */
struct RepairedMesh {
    TriangleMesh mesh;
    int mergedPoints = 0;      ///< at the place of another one
    int emptyTriangles = 0;    ///< without area, left out
    int doubleTriangles = 0;   ///< between the same corners as another one, left out
    int turnedTriangles = 0;   ///< they faced inward
    int parts = 0;             ///< that hang together by edges
    int closedHoles = 0;       ///< by a fan of triangles about the middle of their rim
    double widestHole = 0;     ///< the longest side of the box about the rim [m]
    int addedTriangles = 0;    ///< of those fans, the last ones of the mesh
    double addedArea = 0;      ///< of those fans [m^2]
    int edgesOfManyFaces = 0;  ///< where three triangles or more meet: left as they are
};

/** Merges points at one place, drops empty and double triangles, makes the triangles of each part face the same way and
the part outward (its volume positive), and closes holes.

Parts that overlap stay as they are: a winding number tells inside from outside all the same (MeshDistance). A part
inside another one, such as the wall of a marrow cavity, faces outward too and is thus no cavity.
@throws InvalidInput if requireMesh() refuses the mesh, or no triangle has an area */
RepairedMesh repairMesh(const TriangleMesh& mesh);

}  // namespace tautline
