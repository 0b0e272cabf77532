// SPDX-License-Identifier: Apache-2.0
#pragma once
/** One body of several that stand close to each other, such as the ribs of a chest. */
#include "tautline/meshes/triangle_mesh.h"

namespace tautline {

/** A closed mesh around all that a ball of diameter `gap` cannot enter from outside: the morphological closing of the
mesh's triangles. What such a ball reaches stays as it was, gaps that it cannot pass are filled, to where it comes to
rest; so are cavities that it cannot get into. Neither holes nor the way that triangles face matter.
@param gap   [m]
@param spacing   of the lattice on which it is found [m]; 0: an 80th of the longest side of the mesh, but no wider than
a tenth of the gap. What is left of a wall must be thicker than this, or it may have holes
@throws InvalidInput if requireMesh() refuses the mesh, or the spacing is not finer than a fourth of the gap, or so fine
that there would be too many lattice points */
TriangleMesh closeGaps(const TriangleMesh& mesh, double gap, double spacing = 0);

}  // namespace tautline
