// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>

#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

class HeightMapPatch;

/** Any smooth SimTK::ContactGeometry (isSmooth()) as a surface that a cable can wrap, by its implicit function; see
makeSurface() for the shapes that the core knows. SimTK's function is positive inside; its sign is changed here and
nowhere else.

A SmoothHeightMap is a sheet over a rectangle: what lies below it is inside, what lies beside the rectangle is not,
wherever in height. Beyond its edges iterates go on over a smooth continuation, and an answer that lies there has the
status LeftDomain. */
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
    ImplicitValue calcImplicit(const Vector3& p_S) const override;
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;
    double calcDomainMargin(const SurfacePoint& point) const override;

private:
    double findSize();

    SimTK::ContactGeometry m_geometry;
    std::shared_ptr<const HeightMapPatch> m_heightMap;  ///< null unless the geometry is one
    double m_size;
};

/** The same shape as a surface of the core: Sphere, Cylinder, Ellipsoid, Torus and HalfSpace are its own, with closed
forms, and a SmoothHeightMap is a patch of the same bicubic polynomials, with the edge that the map has. What else is
smooth is wrapped as a ContactGeometrySurface, which is some ten times slower. Lengths near a HalfSpace, which has no
size, are measured in meters.
@throws InvalidInput if the geometry is not smooth, or a dimension is not positive */
std::shared_ptr<const Surface> makeSurface(const SimTK::ContactGeometry& geometry);

}  // namespace tautline
