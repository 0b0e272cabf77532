// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/surface_decorator.h"

namespace tautline {

/** The surface at constant distance h outside another one: a string of thickness 2h over the base, or a layer
of tissue. With W = dN the base's shape operator at the foot C of p = C + h N(C), the tangent planes are parallel and

    dp = (1 + h W) dC,     W_offset = W/(1 + h W),     kappa_offset = kappa/(1 - kappa h)

for each principal curvature (kappa < 0 where the base is convex). So nothing beyond the base's frames is needed,
whatever its kind. Geodesics are integrated on the base: the foot, with (u, v) if the base has them, and the tangent
that both share; only the start is projected. As an implicit surface it is the zero set of f(p) = d(p) - h, d the signed
distance from the base; where there are closed forms (Sphere of radius r + h) those are faster. A concave base needs
kappa h < 1, else the offset has edges: not checked. */
class OffsetSurface final : public SurfaceDecorator<ImplicitShape<OffsetSurface>, std::shared_ptr<const Surface>> {
public:
    /** @param base        not null; InvalidInput otherwise
    @param thickness   h [m], >= 0 */
    OffsetSurface(std::shared_ptr<const Surface> base, double thickness);

    double getThickness() const { return m_thickness; }
    double getSize() const override { return getBase().getSize() + m_thickness; }
    std::string getDescription() const override;
    double calcDomainMargin(const SurfacePoint& point) const override;
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;
    /** With the (u, v) of its foot, if the base has such. */
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override;
    SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const override;
    DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const override;
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override;

    ImplicitValue calcImplicit(const Vector3& p) const;

private:
    /** Foot of a point of this surface, and the base's frame there with t along `direction`. */
    bool findFootOfPoint(const SurfacePoint& point, const Vector3& direction, SurfacePoint& C,
                         DarbouxFrame& frame) const;

    double m_thickness;
    bool m_hasCoordinates;
};

extern template class ImplicitShape<OffsetSurface>;

}  // namespace tautline
