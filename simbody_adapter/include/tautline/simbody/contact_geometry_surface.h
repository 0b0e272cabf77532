// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>

#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

class HeightMapPatch;

/** Any smooth SimTK::ContactGeometry (isSmooth()) as a surface that a cable can wrap. SimTK's implicit
function is positive inside; its sign is changed here and nowhere else.

A SmoothHeightMap is a sheet over a rectangle: what lies below it is inside, what lies beside the rectangle is not,
wherever in height. Beyond its edges iterates go on over a smooth continuation, and an answer that lies there has the
status LeftDomain. Its bicubic surface is evaluated directly, with a patch hint of
its own for each call, since SmoothHeightMap shares one between threads. */
class ContactGeometrySurface final : public ImplicitSurface {
public:
    /** @param geometry   smooth; copied
    @param size       characteristic length [m]; 0: about the smallest radius of curvature where the way down from
                      (1, 1, 1) meets the surface, half the shorter side of a height map. A half space needs one
    @throws InvalidInput if the geometry is not smooth or the size not positive and finite */
    explicit ContactGeometrySurface(const SimTK::ContactGeometry& geometry, double size = 0);

    const SimTK::ContactGeometry& getContactGeometry() const { return m_geometry; }
    std::string getDescription() const override;
    double getSize() const override { return m_size; }
    ImplicitValue calcImplicit(const Vec3& p_S) const override;
    double calcHeightAndNormal(const Vec3& p_S, Vec3& N_S) const override;
    double calcDomainMargin(const SurfacePoint& point) const override;

private:
    double findSize();

    SimTK::ContactGeometry m_geometry;
    std::shared_ptr<const HeightMapPatch> m_heightMap;  ///< null unless the geometry is one
    double m_size;
};

}  // namespace tautline
