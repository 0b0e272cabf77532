#pragma once
#include "tautline/implicit_surface.h"
#include "tautline/parametric_twin.h"

namespace tautline {

/** Cylinder of infinite length along the z axis of S with an elliptic section. */
class EllipticCylinder final : public ImplicitShape<EllipticCylinder> {
public:
    /** @param semiAxisX, semiAxisY   of the section [m], positive; InvalidInput otherwise */
    EllipticCylinder(double semiAxisX, double semiAxisY);

    const Vec2& getSemiAxes() const { return m_semiAxes; }
    double getSize() const override { return m_size; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override;

    /** f = c/2 (x^2/a^2 + y^2/b^2 - 1), c the lesser semi-axis. */
    ImplicitValue calcImplicit(const Vec3& p) const {
        const Vec3 gradient = m_hessian.cwiseProduct(p);
        return {0.5 * (gradient.dot(p) - m_size), gradient, m_hessian.asDiagonal()};
    }

private:
    Vec2 m_semiAxes;
    double m_size;
    Vec3 m_hessian;
};

/** The same cylinder: (a cos u, b sin u, v); u counts turns. */
class ParametricEllipticCylinder final : public ParametricTwin<ParametricEllipticCylinder, EllipticCylinder> {
public:
    ParametricEllipticCylinder(double semiAxisX, double semiAxisY)
        : ParametricTwin(EllipticCylinder(semiAxisX, semiAxisY)) {}

    ParametricValue calcParametric(const Vec2& uv, int) const {
        const double a = m_twin.getSemiAxes()[0], b = m_twin.getSemiAxes()[1], c = std::cos(uv[0]), s = std::sin(uv[0]);
        return {{a * c, b * s, uv[1]}, {-a * s, b * c, 0}, Vec3::UnitZ(),
                {-a * c, -b * s, 0},   Vec3::Zero(),       Vec3::Zero()};
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int) const {
        return {std::atan2(p_S.y() / m_twin.getSemiAxes()[1], p_S.x() / m_twin.getSemiAxes()[0]), p_S.z()};
    }
};

extern template class ParametricShape<ParametricEllipticCylinder>;
extern template class ParametricTwin<ParametricEllipticCylinder, EllipticCylinder>;

}  // namespace tautline
