// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What all fitted patches share: a rectangular domain, a smooth surface beyond it, heights, starts for Newton. */
#include "tautline/surfaces/parametric_surface.h"

namespace tautline {

/** Partial derivatives of x(u, v) up to the second in each coordinate: column 3 i + j holds
d^(i+j) x / du^i dv^j. */
using PatchPartials = Eigen::Matrix<double, 3, 9>;

/** Base of a patch over a rectangle of (u, v). `Derived` gives `void calcPartials(const Vector2& uv, PatchPartials&)
const` for uv in the domain.

Beyond an edge u = u0, at d = u - u0, the patch goes on as x + x_u d + x_uu psi(d), psi(d) = w^2 (sqrt(1 + d^2/w^2) -
1), and so in v: twice continuously differentiable, and growing only linearly, with w a quarter of the domain's width.
Iterates may pass there; isInDomain judges the answer. Points beside the domain are not inside (ParametricShape).

A height patch has x = u, y = v and z = f(u, v): heights and nearby points then need no search. The foot of a point is
taken straight below or above it, so that what is inside is the prism under the rectangle, up to the sheet. */
template <class Derived>
class PatchShape : public ParametricShape<Derived> {
public:
    const ParameterDomain& getDomain() const { return m_domain; }
    bool isHeightPatch() const { return m_isHeightPatch; }
    double getSize() const override { return m_size; }
    double getNormalSign() const { return m_normalSign; }

    double calcDomainMargin(const SurfacePoint& point) const override {
        const bool isAtItsXY = m_isHeightPatch && point.p.allFinite();
        return m_domain.calcMargin(isAtItsXY ? Vector2(point.p.head<2>()) : this->resolve(point).uv);
    }

    ParametricValue calcParametric(const Vector2& uv, int) const {
        const Vector2 edge = m_domain.clamp(uv), d = uv - edge;
        PatchPartials p;
        derived().calcPartials(edge, p);
        if (d[0] == 0 && d[1] == 0) return {p.col(0), p.col(3), p.col(1), p.col(6), p.col(4), p.col(2)};
        const Matrix3 forU = calcExtension(d[0], 0), forV = calcExtension(d[1], 1);
        // Column i of inV(k): the k-th derivative by v of x^(i), the i-th one by u at the edge.
        const auto inV = [&](int k) {
            Matrix3 columns;
            for (int i = 0; i < 3; ++i) columns.col(i) = p.middleCols<3>(3 * i) * forV.row(k).transpose();
            return columns;
        };
        const Matrix3 x = inV(0) * forU.transpose(), xv = inV(1) * forU.transpose();
        return {x.col(0), x.col(1), xv.col(0), x.col(2), xv.col(1), inV(2) * forU.row(0).transpose()};
    }

    Vector2 calcNearbyParameters(const Vector3& p_S, int) const {
        return m_isHeightPatch ? Vector2(p_S.head<2>()) : m_grid.findNearest(p_S);
    }

    /** Of a height patch: z - f(x, y) over the length of its gradient, and beside the rectangle no less than the
    distance from that; else the distance. */
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        if (!m_isHeightPatch) return ParametricShape<Derived>::calcHeightAndNormal(p_S, N_S);
        const ParametricValue s = calcParametric(p_S.head<2>(), 0);
        const Vector3 gradient(-s.xu.z(), -s.xv.z(), 1);
        const double slope = gradient.norm();
        N_S = m_normalSign * gradient / slope;
        const double height = m_normalSign * (p_S.z() - s.x.z()) / slope;
        if (m_domain.calcMargin(p_S.head<2>()) >= 0) return height;
        const Vector2 aside = p_S.head<2>() - m_domain.clamp(p_S.head<2>());
        const double way = aside.norm();
        if (!(way > height)) return height;
        N_S = Vector3(aside.x() / way, aside.y() / way, 0);
        return way;
    }

protected:
    PatchShape(const ParameterDomain& domain, bool isHeightPatch, double normalSign)
        : m_domain(domain), m_isHeightPatch(isHeightPatch), m_normalSign(normalSign) {}

    /** Call at the end of Derived's constructor: lays the grid of starts and measures the patch. The size is half of
    its shorter middle line. */
    void measure() {
        m_grid.build(m_domain, [this](const Vector2& uv) { return calcParametric(uv, 0).x; });
        double length[2] = {0, 0};
        constexpr int kPieces = 16;
        const Vector2 middle = 0.5 * (m_domain.min + m_domain.max), extent = m_domain.max - m_domain.min;
        for (int side = 0; side < 2; ++side) {
            Vector3 previous;
            for (int i = 0; i <= kPieces; ++i) {
                Vector2 uv = middle;
                uv[side] = m_domain.min[side] + extent[side] * i / kPieces;
                const Vector3 x = calcParametric(uv, 0).x;
                if (i > 0) length[side] += (x - previous).norm();
                previous = x;
            }
        }
        m_size = 0.5 * std::min(length[0], length[1]);
    }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    /** Row k, column i: k-th derivative of the factor of x^(i) at d beyond the edge; the identity at d = 0. */
    Matrix3 calcExtension(double d, int side) const {
        constexpr double kWidth = 0.25;  // of the domain: how far its curvature reaches out
        const double w = kWidth * (m_domain.max[side] - m_domain.min[side]), root = std::sqrt(1 + d * d / (w * w));
        Matrix3 factors;
        factors << 1, d, d * d / (root + 1), 0, 1, d / root, 0, 0, 1 / (root * root * root);
        return factors;
    }

    ParameterDomain m_domain;
    bool m_isHeightPatch;
    double m_normalSign, m_size = kNaN;
    NearbyGrid m_grid;
};

}  // namespace tautline
