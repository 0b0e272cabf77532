// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "report_page.h"

namespace tautline {

/** A mesh whose points have been drawn together to one in each cell of a grid, their mean (vertex clustering: Rossignac
and Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993). No point moves farther than a
cell's diagonal; triangles that have become lines or points are gone, as are points without a triangle.
@param cell   width of the grid's cells [m], positive */
ReportPage::Mesh clusterPoints(const ReportPage::Mesh& mesh, double cell);

/** Draws points of meshes together in cells of one width, the least that leaves no more than `mostPoints` in all.
Meshes that have no more stay as they are. @return the width [m]; 0 if nothing has changed */
double thinMeshes(std::vector<ReportPage::Mesh>& meshes, std::size_t mostPoints);

}  // namespace tautline
