// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"
#include "tautline/surfaces/torus_form.h"

namespace tautline {

/** Ring torus about the z axis of S: a tube of radius r around a circle of radius R > r in the plane z = 0. */
class Torus final : public ImplicitShape<Torus> {
public:
    /** @param ringRadius   from the axis to the tube's center [m]
    @param tubeRadius   [m]; 0 < tubeRadius < ringRadius, InvalidInput otherwise */
    Torus(double ringRadius, double tubeRadius);

    double getRingRadius() const { return m_ringRadius; }
    double getTubeRadius() const { return m_tubeRadius; }
    double getSize() const override { return m_tubeRadius; }
    std::string getDescription() const override;

    /** As the elliptic torus with both semi-axes r: f = ((rho - R)^2 + z^2 - r^2)/(2r). */
    ImplicitValue calcImplicit(const Vector3& p) const {
        return calcTorusForm(p, m_ringRadius, m_tubeRadius, m_tubeRadius);
    }
    std::optional<Hole> getHole() const override { return Hole(m_ringRadius); }
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;

private:
    double m_ringRadius, m_tubeRadius;
};

extern template class ImplicitShape<Torus>;

/** Ring torus about the z axis of S in ring angle u and tube angle v (thesis Eqn. 3.69). */
class ParametricTorus final : public ParametricTwin<ParametricTorus, Torus> {
public:
    /** @param ringRadius   from the axis to the tube's center [m]
    @param tubeRadius   [m]; 0 < tubeRadius < ringRadius, InvalidInput otherwise */
    ParametricTorus(double ringRadius, double tubeRadius) : ParametricTwin(Torus(ringRadius, tubeRadius)) {}

    ParametricValue calcParametric(const Vector2& uv, int) const {
        return calcTorusPoint(uv, getTwin().getRingRadius(), getTwin().getTubeRadius(), getTwin().getTubeRadius());
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const {
        return calcTorusParameters(p_S, getTwin().getRingRadius(), getTwin().getTubeRadius(),
                                   getTwin().getTubeRadius());
    }
};

extern template class ParametricShape<ParametricTorus>;
extern template class ParametricTwin<ParametricTorus, Torus>;

}  // namespace tautline
