// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"
#include "tautline/surfaces/torus_form.h"

namespace tautline {

/** Torus about the z axis of S whose tube section is an ellipse (thesis Sec. 8.3): its center runs on a circle
of radius R in the plane z = 0, its semi-axes lie along the radius and along z. */
class EllipticTorus final : public ImplicitShape<EllipticTorus> {
public:
    /** @param ringRadius      R, from the axis to the tube's center [m]
    @param radialSemiAxis   of the section [m]; 0 < radialSemiAxis < ringRadius, InvalidInput otherwise
    @param axialSemiAxis    of the section along z [m], positive */
    EllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis);

    double getRingRadius() const { return m_ringRadius; }
    double getRadialSemiAxis() const { return m_radial; }
    double getAxialSemiAxis() const { return m_axial; }
    double getSize() const override { return m_size; }
    std::string getDescription() const override;

    std::optional<Hole> getHole() const override { return Hole(m_ringRadius); }

    ImplicitValue calcImplicit(const Vector3& p) const { return calcTorusForm(p, m_ringRadius, m_radial, m_axial); }

private:
    double m_ringRadius, m_radial, m_axial, m_size;
};

extern template class ImplicitShape<EllipticTorus>;

/** The same torus in ring angle u and section angle v:

    ((R + a cos v) cos u, (R + a cos v) sin u, b sin v)     (thesis Eqn. 3.69 if a = b). */
class ParametricEllipticTorus final : public ParametricTwin<ParametricEllipticTorus, EllipticTorus> {
public:
    ParametricEllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis)
        : ParametricTwin(EllipticTorus(ringRadius, radialSemiAxis, axialSemiAxis)) {}

    ParametricValue calcParametric(const Vector2& uv, int) const {
        return calcTorusPoint(uv, getTwin().getRingRadius(), getTwin().getRadialSemiAxis(),
                              getTwin().getAxialSemiAxis());
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const {
        return calcTorusParameters(p_S, getTwin().getRingRadius(), getTwin().getRadialSemiAxis(),
                                   getTwin().getAxialSemiAxis());
    }
};

extern template class ParametricShape<ParametricEllipticTorus>;
extern template class ParametricTwin<ParametricEllipticTorus, EllipticTorus>;

}  // namespace tautline
