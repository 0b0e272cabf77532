#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** Ellipsoid about the origin of S with semi-axes along x, y, z. */
class Ellipsoid final : public ImplicitShape<Ellipsoid> {
public:
    /** @param semiAxes   [m], each positive; InvalidInput otherwise */
    explicit Ellipsoid(const Vec3& semiAxes);

    const Vec3& getSemiAxes() const { return m_semiAxes; }
    double getSize() const override { return m_size; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    /** The nearest point, also from afar, where the way of steepest descent leads elsewhere on a thin ellipsoid. */
    SurfacePoint findSurfacePoint(const Vec3& p_S) const override;
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override;

    /** f = c/2 (x^2/a^2 + y^2/b^2 + z^2/c^2 - 1) with c the least semi-axis, so that f is a length. */
    ImplicitValue calcImplicit(const Vec3& p) const {
        const Vec3 gradient = m_hessian.cwiseProduct(p);
        return {0.5 * (gradient.dot(p) - m_size), gradient, m_hessian.asDiagonal()};
    }

private:
    Vec3 m_semiAxes, m_hessian;
    double m_size;
};

extern template class ImplicitShape<Ellipsoid>;

}  // namespace tautline
