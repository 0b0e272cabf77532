// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

/** One body of a blend. */
struct BlendPart {
    std::shared_ptr<const Surface> surface;
    Pose X_SP;  ///< of its frame P in that of the blend, S
};

/** The union of several bodies with rounded grooves, twice continuously differentiable: a string may lie in a groove,
or bridge it, where over two surfaces that overlap it would have a kink.

Of the signed distances a and b of two parts the blend takes

    min(a, b) - k/6 max(1 - |a - b|/k, 0)^3,    k = 2 sqrt(2) radius,

part after part. So it differs from the nearest part only where another one is no farther than k more, and in the middle
of a groove between planes at right angles its radius of curvature is `radius`; blunter grooves are rounder. Distances
are measured by Newton's method from the foot of the steepest descent, so that an evaluation costs some microseconds.
Deep inside, near the medial axis of a part, it is smooth no more. */
class Blend final : public ImplicitShape<Blend> {
public:
    /** @param parts    closed or endless, at least one
    @param radius   of the rounding [m]
    @throws InvalidInput if there are no parts, one has no surface or an edge, a pose is not finite or its rotation is
    none, or the radius is not positive and finite */
    Blend(std::vector<BlendPart> parts, double radius);

    const std::vector<BlendPart>& getParts() const { return m_parts; }
    double getRadius() const { return m_radius; }

    /** That of the smallest part. */
    double getSize() const override { return m_size; }
    std::string getDescription() const override;
    ImplicitValue calcImplicit(const Vector3& p_S) const;

private:
    std::vector<BlendPart> m_parts;
    double m_radius, m_size;
};

extern template class ImplicitShape<Blend>;

/** The blend of bodies that are all given in one frame. */
std::shared_ptr<const Blend> makeBlend(const std::vector<std::shared_ptr<const Surface>>& surfaces, double radius);

}  // namespace tautline
