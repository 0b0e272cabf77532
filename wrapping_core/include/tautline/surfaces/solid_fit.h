// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Smooth solids from triangle meshes. */
#include "tautline/meshes/mesh_repair.h"
#include "tautline/surfaces/bspline_solid.h"
#include "tautline/surfaces/fit_report.h"

namespace tautline {

/** How a mesh is made smooth. */
struct SolidFitOptions {
    /** Standard deviation of the smoothing along each axis [m]. Parts thinner than about 1.6 widths vanish; round ones
    of radius r shrink by about width^2 / r (a ball; a cylinder by half of that). 0: half the mean edge of the mesh, so
    that its facets are not felt, or a fifth of its size, if that is less, so that thin parts stay. */
    double width = 0;
    /** Of the lattice [m], between width / 1.8 and 1.7 width. 0: 1.5 widths. Finer
    takes more memory and time, and is no better: there is nothing in the function that is smaller than the width.
     */
    double spacing = 0;
};

/** What became of a mesh. */
struct SolidFit {
    BSplineSolid solid;
    RepairedMesh repaired;        ///< what was fitted
    std::vector<Vector3> points;  ///< where residuals are taken: near the corners and in the middle of each triangle
                                  ///< that lies on the outside
    FitReport report;
};

/** Fits a solid to a mesh, which is put in order first (repairMesh()): the signed distance (MeshDistance) on a lattice,
smoothed there by a kernel that is nowhere negative and has the width asked for together with the B-splines, whose
control values are what comes out. So a convex body stays convex, and the surface misses that of the mesh by the square
of the width.
@throws InvalidInput for a mesh without area, a width or spacing that is negative, not finite or out of proportion, or a
lattice of more than 2^27 control values */
SolidFit fitSolid(const TriangleMesh& mesh, const SolidFitOptions& options = {});

}  // namespace tautline
