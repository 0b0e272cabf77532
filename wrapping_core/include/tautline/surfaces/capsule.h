// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Cylinder with rounded ends about the z axis of S, closed and convex. With w = max(|z| - L/2, 0) the way into
an end cap, the profile is

    rho^2/r^2 + (w/c)^4 = 1:     rho = r (1 - w^4/(2 c^4) - ...) at the joint,

so the curvature of the profile starts from 0 like w^2: three derivatives of rho are continuous across the joint, and
the integrator passes it in its stride. (Half spheres would make the curvature jump.) The tip is regular; both its radii
of curvature are 2 r^2/c. */
class Capsule final : public ImplicitShape<Capsule> {
public:
    /** @param radius       of the cylinder, r [m], positive; InvalidInput otherwise
    @param length       of the cylindrical part, L [m], >= 0
    @param capHeight    of each end cap, c [m], positive */
    Capsule(double radius, double length, double capHeight);
    /** Caps as high as the radius. */
    Capsule(double radius, double length) : Capsule(radius, length, radius) {}

    double getRadius() const { return m_radius; }
    double getLength() const { return m_length; }
    double getCapHeight() const { return m_capHeight; }
    double getSize() const override { return std::min(m_radius, m_capHeight); }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }

    /** From farther away than the size first straight towards the axis: Newton's method on the fourth power would
    take long. */
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override;

    /** f = r/2 (rho^2/r^2 + (w/c)^4 - 1), convex. */
    DiagonalImplicitValue calcImplicit(const Vector3& p) const {
        const double w = std::max(std::abs(p.z()) - 0.5 * m_length, 0.0) / m_capHeight;
        const double k = m_radius / m_capHeight, side = p.z() < 0 ? -1 : 1;
        return {0.5 * ((p.x() * p.x() + p.y() * p.y()) / m_radius + m_radius * (w * w * w * w - 1)),
                {p.x() / m_radius, p.y() / m_radius, 2 * side * k * w * w * w},
                Vector3(1 / m_radius, 1 / m_radius, 6 * k / m_capHeight * w * w)};
    }

private:
    double m_radius, m_length, m_capHeight;
};

extern template class ImplicitShape<Capsule>;

/** The same capsule in three charts: (rho(v) cos u, rho(v) sin u, v) about the side, chart 0, and about the tips,
charts 1 (above) and 2, z as a function of x and y. Each ends where its slope grows without bound, beyond where the next
one has taken over. */
class ParametricCapsule final : public ParametricTwin<ParametricCapsule, Capsule> {
public:
    ParametricCapsule(double radius, double length, double capHeight)
        : ParametricTwin(Capsule(radius, length, capHeight)) {}
    ParametricCapsule(double radius, double length) : ParametricCapsule(radius, length, radius) {}

    ParametricValue calcParametric(const Vector2& uv, int chart) const;
    Vector2 calcNearbyParameters(const Vector3& p_S, int chart) const;
    int chooseChart(const Vector3& p_S, const Vector3& t_S, int current) const;
};

extern template class ParametricShape<ParametricCapsule>;
extern template class ParametricTwin<ParametricCapsule, Capsule>;

}  // namespace tautline
