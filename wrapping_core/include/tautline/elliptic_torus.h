#pragma once
#include "tautline/implicit_surface.h"
#include "tautline/parametric_twin.h"
#include "tautline/sine_cosine.h"

namespace tautline {

/** Torus about the z axis of S whose tube section is an ellipse (thesis Sec. 8.3): its centre runs on a circle
of radius R in the plane z = 0, its semi-axes lie along the radius and along z. */
class EllipticTorus final : public ImplicitShape<EllipticTorus> {
public:
    /** @param ringRadius      R, from the axis to the tube's centre [m]
    @param radialSemiAxis   of the section [m]; 0 < radialSemiAxis < ringRadius, InvalidInput otherwise
    @param axialSemiAxis    of the section along z [m], positive */
    EllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis);

    double getRingRadius() const { return m_ringRadius; }
    double getRadialSemiAxis() const { return m_radial; }
    double getAxialSemiAxis() const { return m_axial; }
    double getSize() const override { return m_size; }
    std::string getDescription() const override;

    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const override {
        return countDiscCrossings(m_ringRadius, A_S, B_S);
    }

    /** f = c/2 ((rho - R)^2/a^2 + z^2/b^2 - 1), c the lesser semi-axis; on the axis, no part of the surface, the
    gradient is that of a point beside it. */
    ImplicitValue calcImplicit(const Vec3& p) const {
        const double tiny = 1e-12 * m_ringRadius, rhoTrue = std::sqrt(p.x() * p.x() + p.y() * p.y());
        const Vec3 radial = rhoTrue > tiny ? Vec3(p.x() / rhoTrue, p.y() / rhoTrue, 0) : Vec3(Vec3::UnitX());
        const double rho = std::max(rhoTrue, tiny), q = rho - m_ringRadius;
        const double ra = m_size / (m_radial * m_radial), zb = m_size / (m_axial * m_axial);
        ImplicitValue value;
        value.f = 0.5 * (ra * q * q + zb * p.z() * p.z() - m_size);
        value.gradient = Vec3(ra * q * radial.x(), ra * q * radial.y(), zb * p.z());
        // d(q radial) = radial radial^T + q/rho hoop hoop^T
        const double xx = radial.x() * radial.x(), xy = radial.x() * radial.y(), yy = radial.y() * radial.y();
        const double h = q / rho;
        value.hessian << ra * (xx + h * yy), ra * (1 - h) * xy, 0, ra * (1 - h) * xy, ra * (yy + h * xx), 0, 0, 0, zb;
        return value;
    }

private:
    double m_ringRadius, m_radial, m_axial, m_size;
};

/** The same torus in ring angle u and section angle v:

    ((R + a cos v) cos u, (R + a cos v) sin u, b sin v)     (thesis Eqn. 3.69 if a = b). */
class ParametricEllipticTorus final : public ParametricTwin<ParametricEllipticTorus, EllipticTorus> {
public:
    ParametricEllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis)
        : ParametricTwin(EllipticTorus(ringRadius, radialSemiAxis, axialSemiAxis)) {}

    ParametricValue calcParametric(const Vec2& uv, int) const {
        return calcTorus(uv, m_twin.getRingRadius(), m_twin.getRadialSemiAxis(), m_twin.getAxialSemiAxis());
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int) const {
        return calcTorusParameters(p_S, m_twin.getRingRadius(), m_twin.getRadialSemiAxis(), m_twin.getAxialSemiAxis());
    }

    static ParametricValue calcTorus(const Vec2& uv, double R, double a, double b) {
        const SineCosine angles(uv);
        const double cu = angles.cosine[0], su = angles.sine[0], cv = angles.cosine[1], sv = angles.sine[1];
        const double rho = R + a * cv;
        return {{rho * cu, rho * su, b * sv}, {-rho * su, rho * cu, 0},       {-a * sv * cu, -a * sv * su, b * cv},
                {-rho * cu, -rho * su, 0},    {a * sv * su, -a * sv * cu, 0}, {-a * cv * cu, -a * cv * su, -b * sv}};
    }
    static Vec2 calcTorusParameters(const Vec3& p, double R, double a, double b) {
        return {std::atan2(p.y(), p.x()), std::atan2(p.z() / b, (std::hypot(p.x(), p.y()) - R) / a)};
    }
};

extern template class ParametricShape<ParametricEllipticTorus>;
extern template class ParametricTwin<ParametricEllipticTorus, EllipticTorus>;

}  // namespace tautline
