// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Elliptic paraboloid z = x^2/A + y^2/B of S (thesis Eqn. 6.6: A = 14, B = 6). The bowl above it counts as
solid: N points outward of it, on its convex side, where z is less. */
class Paraboloid final : public ImplicitShape<Paraboloid> {
public:
    /** @param A, B   twice the radii of curvature at the vertex [m], positive; InvalidInput otherwise */
    Paraboloid(double A, double B);

    double getA() const { return m_A; }
    double getB() const { return m_B; }
    double getSize() const override { return 0.5 * std::min(m_A, m_B); }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override;

    /** f = x^2/A + y^2/B - z: the gradient is nowhere less than 1. */
    DiagonalImplicitValue calcImplicit(const Vector3& p) const {
        return {p.x() * p.x() / m_A + p.y() * p.y() / m_B - p.z(),
                {2 * p.x() / m_A, 2 * p.y() / m_B, -1},
                Vector3(2 / m_A, 2 / m_B, 0)};
    }

private:
    double m_A, m_B;
};

extern template class ImplicitShape<Paraboloid>;

/** The same paraboloid with u = x, v = y. */
class ParametricParaboloid final : public ParametricTwin<ParametricParaboloid, Paraboloid> {
public:
    ParametricParaboloid(double A, double B) : ParametricTwin(Paraboloid(A, B)) {}

    double getNormalSign() const { return -1; }  // xu x xv points up, into the bowl
    ParametricValue calcParametric(const Vector2& uv, int) const {
        const double A = getTwin().getA(), B = getTwin().getB(), u = uv[0], v = uv[1];
        return {{u, v, u * u / A + v * v / B},
                {1, 0, 2 * u / A},
                {0, 1, 2 * v / B},
                {0, 0, 2 / A},
                Vector3::Zero(),
                {0, 0, 2 / B}};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const { return p_S.head<2>(); }
};

extern template class ParametricShape<ParametricParaboloid>;
extern template class ParametricTwin<ParametricParaboloid, Paraboloid>;

}  // namespace tautline
