// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "tautline/surfaces/implicit_surface.h"

namespace tautline {

/** Base of ellipsoid and elliptic cylinder: f = c/2 (p . D p - 1) with D diagonal, D >= 0, and c the least semi-axis,
so that f is a length. */
template <class Derived>
class CentralQuadric : public ImplicitShape<Derived> {
public:
    double getSize() const override { return m_size; }
    bool isConvex() const override { return true; }

    DiagonalImplicitValue calcImplicit(const Vector3& p) const {
        const Vector3 gradient = m_hessian.cwiseProduct(p);
        return {0.5 * (gradient.dot(p) - m_size), gradient, m_hessian};
    }

    /** The nearest point, also from afar, where the way of steepest descent leads elsewhere if the surface is thin:
    x_i = p_i/(1 + t D_i) with t the root of g = sum D_i x_i^2 - 1, which falls and is convex, so that Newton's method
    comes to it from below, from where one term alone is 1. */
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override {
        constexpr double kNear = 0.2;  // in sizes; there the way of steepest descent is shorter
        constexpr int kMaxIterations = 60;
        if (!(calcImplicit(p_S).f > kNear * m_size)) return {this->projectToSurface(p_S)};
        const Vector3 D = m_hessian / m_size;
        double t = 0;
        for (int i = 0; i < 3; ++i)
            if (D[i] > 0) t = std::max(t, (std::abs(p_S[i]) * std::sqrt(D[i]) - 1) / D[i]);
        Vector3 x = p_S;
        for (int i = 0; i < kMaxIterations; ++i) {
            const Vector3 shrink = (1 + t * D.array()).inverse();
            x = p_S.cwiseProduct(shrink);
            const Vector3 terms = D.cwiseProduct(x).cwiseProduct(x);
            const double step = (terms.sum() - 1) / (2 * terms.cwiseProduct(D).dot(shrink));
            if (!(step > 1e-12 * t)) break;
            t += step;
        }
        return {this->projectToSurface(x)};
    }

    /** The minimum of f along the line. */
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override {
        const Vector3 He = m_hessian.cwiseProduct(e_S);
        const double quadratic = e_S.dot(He);
        return quadratic > 0 ? std::clamp(-A_S.dot(He) / quadratic, 0.0, length) : 0;
    }

protected:
    /** @param D   inverse squares of the semi-axes @param size   the least of them */
    CentralQuadric(const Vector3& D, double size) : m_hessian(size * D), m_size(size) {}

private:
    Vector3 m_hessian;
    double m_size;
};

}  // namespace tautline
