// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>

#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

/** The numbers behind a BSplineSolid: control values of tricubic B-splines over two lattices of cubic cells, a fine one
in bricks near the surface and a coarse one around all of it. Lattice points have x as the slowest index. */
struct SolidGrid {
    static constexpr int kBrick = 8;              ///< cells along an edge of a brick
    static constexpr int kControls = kBrick + 3;  ///< control values along it
    static constexpr int kBrickControls = kControls * kControls * kControls;
    static constexpr std::int32_t kOutside = -1, kInside = -2;

    Vector3 origin = Vector3::Zero();  ///< lowest corner of the first brick, in S [m]
    double spacing = kNaN;             ///< of the fine lattice [m]
    std::array<int, 3> numBricks{};    ///< along the axes
    std::vector<std::int32_t> bricks;  ///< which control values a brick has; kOutside, kInside: none, it is far away
    std::vector<float> controls;       ///< signed heights [m], kBrickControls for each brick that has some

    Vector3 farOrigin = Vector3::Zero();  ///< lowest corner of the coarse cells, in S [m]
    double farSpacing = kNaN;             ///< [m]
    std::array<int, 3> numFarControls{};  ///< three more than cells
    std::vector<float> farControls;       ///< distances without sign [m]

    double blendBegin = kNaN,
           blendEnd = kNaN;  ///< heights between which the fine function goes over into the coarse [m]
    double size = kNaN;      ///< characteristic length [m]
    double width = kNaN;     ///< of the smoothing, for descriptions [m]
};

/** A solid of any shape, such as a bone: f(p) = 0 where f is a tricubic B-spline over a lattice, as fitSolid() makes it
of a mesh. f is about the height above the surface.

(1) f is twice continuously differentiable everywhere; gradient and Hessian are exact.

(2) Beyond heights of `blendEnd` f is a distance without sign, a tricubic B-spline over a coarse lattice, times the side
that the brick is on: never the wrong one. Between `blendBegin` and `blendEnd` the two are blended.

(3) Beyond the coarse lattice it is the value at the nearest place of its box plus the distance from there, rounded at
the edge of the box.

By (2) and (3) searches that march by heights come near the surface from anywhere. */
class BSplineSolid final : public ImplicitShape<BSplineSolid> {
public:
    /** @param grid   consistent in its counts, finite, distances not negative, 0 < blendBegin < blendEnd; InvalidInput
    otherwise, with what is wrong */
    explicit BSplineSolid(SolidGrid grid);

    const SolidGrid& getGrid() const { return m_grid; }
    double getSize() const override { return m_grid.size; }
    std::string getDescription() const override;

    /** The box outside which nothing of the solid is, in S. */
    Eigen::AlignedBox3d calcBox() const;

    ImplicitValue calcImplicit(const Vector3& p) const;
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;

private:
    template <int kOrder>
    void calcFunction(const Vector3& p, ImplicitValue& value) const;
    template <int kOrder>
    void calcNear(const float* controls, const Vector3& inBrick, ImplicitValue& value) const;
    template <int kOrder>
    void calcFar(const Vector3& p, ImplicitValue& value) const;
    /** Number of the brick's control values, kOutside or kInside. @param place   in fine cells, from the origin */
    std::int32_t findBrick(const Vector3& place, Vector3& inBrick) const;

    SolidGrid m_grid;
    double m_inverseSpacing = kNaN, m_inverseFarSpacing = kNaN;
};

extern template class ImplicitShape<BSplineSolid>;

}  // namespace tautline
