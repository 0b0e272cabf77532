// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <vector>

#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/patch_shape.h"

namespace tautline {

/** z = f(x, y) of Simbody's bicubic surface, cell by cell the same polynomial, outward up, with the continuation beyond
its edges that all patches have. Read once: Simbody evaluates one derivative at a time, and looks the cell up for each.
*/
class HeightMapPatch final : public PatchShape<HeightMapPatch> {
public:
    explicit HeightMapPatch(const SimTK::BicubicSurface& surface);

    std::string getDescription() const override { return "height_map"; }
    void calcPartials(const Vector2& uv, PatchPartials& partials) const;

    /** f = z - height(x, y). */
    ImplicitValue calcImplicit(const Vector3& p_S) const;

private:
    /** Row i, column j: of s^i t^j, s and t from 0 to 1 along x and y of the cell. */
    using Coefficients = Eigen::Matrix4d;

    std::vector<double> m_x, m_y;       ///< of the cells' sides, ascending
    std::vector<Coefficients> m_cells;  ///< cell (i, j) at i + j times the number of cells along x
};

extern template class ParametricShape<HeightMapPatch>;

}  // namespace tautline
