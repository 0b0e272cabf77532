#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** Base of ellipsoid and elliptic cylinder: f = c/2 (p . D p - 1) with D diagonal, D >= 0, and c the least semi-axis,
so that f is a length. */
template <class Derived>
class CentralQuadric : public ImplicitShape<Derived> {
public:
    double getSize() const override { return m_size; }
    bool isConvex() const override { return true; }

    ImplicitValue calcImplicit(const Vec3& p) const {
        const Vec3 gradient = m_hessian.cwiseProduct(p);
        return {0.5 * (gradient.dot(p) - m_size), gradient, m_hessian.asDiagonal()};
    }

    /** The minimum of f along the line. */
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override {
        const Vec3 He = m_hessian.cwiseProduct(e_S);
        const double quadratic = e_S.dot(He);
        return quadratic > 0 ? std::clamp(-A_S.dot(He) / quadratic, 0.0, length) : 0;
    }

protected:
    /** @param D   inverse squares of the semi-axes @param size   the least of them */
    CentralQuadric(const Vec3& D, double size) : m_hessian(size * D), m_size(size) {}

private:
    Vec3 m_hessian;
    double m_size;
};

}  // namespace tautline
