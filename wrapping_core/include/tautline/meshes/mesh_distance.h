// SPDX-License-Identifier: Apache-2.0
#pragma once
/** How far a point is from a triangle mesh, and on which side of it. */
#include "tautline/meshes/triangle_mesh.h"

namespace tautline {

/** Distances and winding numbers of a mesh, by a tree of boxes over its triangles.

The sign is that of the generalized winding number (Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside
segmentation using generalized winding numbers", 2013): how often the mesh goes round a point, in full solid angles. It
is 1 inside a closed mesh, 2 where two parts overlap, and goes smoothly from 1 to 0 across a hole, so that nothing
leaks. Triangles far from the point count as one dipole (Barill et al., "Fast winding numbers for soups and clouds",
2018).

All methods are const and may be called from many threads at once. */
class MeshDistance {
public:
    struct Nearest {
        Vector3 point = Vector3::Constant(kNaN);  ///< of the mesh
        int triangle = -1;                        ///< -1: none is nearer than asked for
        double distance = kInfinity;              ///< [m], not negative
    };

    /** @param mesh   kept as it is; InvalidInput if requireMesh() refuses it */
    explicit MeshDistance(TriangleMesh mesh);

    const TriangleMesh& getMesh() const { return m_mesh; }

    /** The nearest point of the mesh. @param within   [m]: what lies farther is not looked for */
    Nearest findNearest(const Vector3& p, double within = kInfinity) const;

    /** Good to some 1e-2, exact in sign of (number - 1/2) where no hole is near. */
    double calcWindingNumber(const Vector3& p) const;

    bool isInside(const Vector3& p) const { return calcWindingNumber(p) > 0.5; }

    /** Distance to the nearest point, negative inside [m]. */
    double calcSignedDistance(const Vector3& p) const {
        return isInside(p) ? -findNearest(p).distance : findNearest(p).distance;
    }

private:
    struct Node {
        Eigen::AlignedBox3d box;
        int first, count;   ///< triangles of m_order
        int children = -1;  ///< the first of two next to each other; -1: a leaf
        Vector3 center = Vector3::Zero(),
                area = Vector3::Zero();  ///< the dipole: mean place [m], sum of area vectors [m^2]
        double radius = 0;               ///< about the center [m]
    };

    void build(int node);
    void setDipole(Node& node) const;

    TriangleMesh m_mesh;
    std::vector<int> m_order;
    std::vector<Node> m_nodes;
};

}  // namespace tautline
