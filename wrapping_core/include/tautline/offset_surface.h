#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** The surface at constant distance h outside another one: a string of thickness 2h over the base, or a layer
of tissue. It is the zero set of f(p) = d(p) - h, d the signed distance from the base, whose derivatives are exact at
any p with foot C on the base: gradient N(C) and, with W = dN the base's shape operator, Hessian W/(1 + d W) in the
tangent plane, or

    kappa_offset = kappa/(1 - kappa d)     for each principal curvature (kappa < 0 where the base is convex).

So nothing beyond the base's frames is needed, whatever its kind; where it has closed forms (Sphere of
radius r + h) those are faster. A concave base needs kappa h < 1, else the offset has edges: not checked. */
class OffsetSurface final : public ImplicitShape<OffsetSurface> {
public:
    /** @param base        not null; InvalidInput otherwise
    @param thickness   h [m], >= 0 */
    OffsetSurface(std::shared_ptr<const Surface> base, double thickness);

    double getThickness() const { return m_thickness; }
    const Surface& getBase() const { return *m_base; }
    double getSize() const override { return m_base->getSize() + m_thickness; }
    std::string getDescription() const override;
    bool isConvex() const override { return m_base->isConvex(); }
    bool isInDomain(const SurfacePoint& point) const override;
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override;
    SurfacePoint findSurfacePoint(const Vec3& p_S) const override;
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override;

    ImplicitValue calcImplicit(const Vec3& p) const;

private:
    std::shared_ptr<const Surface> m_base;
    double m_thickness;
};

}  // namespace tautline
