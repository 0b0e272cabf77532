#pragma once
#include "tautline/implicit_surface.h"

namespace tautline {

/** Ring torus about the z axis of S: a tube of radius r around a circle of radius R > r in the plane z = 0. */
class Torus final : public ImplicitShape<Torus> {
public:
    /** @param ringRadius   from the axis to the tube's centre [m]
    @param tubeRadius   [m]; 0 < tubeRadius < ringRadius, InvalidInput otherwise */
    Torus(double ringRadius, double tubeRadius);

    double getRingRadius() const { return m_ringRadius; }
    double getTubeRadius() const { return m_tubeRadius; }
    double getSize() const override { return m_tubeRadius; }
    std::string getDescription() const override;

    /** f = ((rho - R)^2 + z^2 - r^2)/(2r) with rho the distance from the axis: smooth but on the axis,
    which is no part of the surface; there the gradient is taken for a point beside it. */
    ImplicitValue calcImplicit(const Vec3& p) const {
        const double tiny = 1e-12 * m_ringRadius, rhoTrue = std::sqrt(p.x() * p.x() + p.y() * p.y());
        const Vec3 radial = rhoTrue > tiny ? Vec3(p.x() / rhoTrue, p.y() / rhoTrue, 0) : Vec3::UnitX();
        const double rho = std::max(rhoTrue, tiny), q = rho - m_ringRadius;
        ImplicitValue value;
        value.f = (q * q + p.z() * p.z() - m_tubeRadius * m_tubeRadius) / (2 * m_tubeRadius);
        value.gradient = (q * radial + p.z() * Vec3::UnitZ()) / m_tubeRadius;
        // d(q radial) = radial radial^T + q/rho (I - radial radial^T - z z^T)
        const Mat3 outer = radial * radial.transpose();
        value.hessian = outer;
        value.hessian += (q / rho) * (Mat3::Identity() - outer);
        value.hessian.row(2).setZero();
        value.hessian.col(2).setZero();
        value.hessian(2, 2) = 1;
        value.hessian /= m_tubeRadius;
        return value;
    }
    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const override {
        return countDiscCrossings(m_ringRadius, A_S, B_S);
    }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override;

private:
    double m_ringRadius, m_tubeRadius;
};

extern template class ImplicitShape<Torus>;

}  // namespace tautline
