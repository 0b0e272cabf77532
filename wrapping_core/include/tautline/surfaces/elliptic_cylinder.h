// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/central_quadric.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Cylinder of infinite length along the z axis of S with an elliptic section. */
class EllipticCylinder final : public CentralQuadric<EllipticCylinder> {
public:
    /** @param semiAxisX, semiAxisY   of the section [m], positive; InvalidInput otherwise */
    EllipticCylinder(double semiAxisX, double semiAxisY);

    const Vector2& getSemiAxes() const { return m_semiAxes; }
    std::string getDescription() const override;

private:
    Vector2 m_semiAxes;
};

extern template class ImplicitShape<EllipticCylinder>;

/** The same cylinder: (a cos u, b sin u, v); u counts turns. */
class ParametricEllipticCylinder final : public ParametricTwin<ParametricEllipticCylinder, EllipticCylinder> {
public:
    ParametricEllipticCylinder(double semiAxisX, double semiAxisY)
        : ParametricTwin(EllipticCylinder(semiAxisX, semiAxisY)) {}

    ParametricValue calcParametric(const Vector2& uv, int) const {
        const double a = getTwin().getSemiAxes()[0], b = getTwin().getSemiAxes()[1], c = std::cos(uv[0]),
                     s = std::sin(uv[0]);
        return {{a * c, b * s, uv[1]}, {-a * s, b * c, 0}, Vector3::UnitZ(),
                {-a * c, -b * s, 0},   Vector3::Zero(),    Vector3::Zero()};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const {
        return {std::atan2(p_S.y() / getTwin().getSemiAxes()[1], p_S.x() / getTwin().getSemiAxes()[0]), p_S.z()};
    }
};

extern template class ParametricShape<ParametricEllipticCylinder>;
extern template class ParametricTwin<ParametricEllipticCylinder, EllipticCylinder>;

}  // namespace tautline
