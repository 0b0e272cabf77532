// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The equations that the two tori share. R: from the z axis to the tube's center; a, b: semi-axes of the tube's
section along the radius and along z; all in meters. */
#include <algorithm>
#include <cmath>

#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_surface.h"
#include "tautline/surfaces/sine_cosine.h"

namespace tautline {

/** f = c/2 ((rho - R)^2/a^2 + z^2/b^2 - 1) with c the lesser semi-axis and rho the distance from the z axis: smooth
except on that axis, which is not part of the surface; the gradient there is that of a point beside it. */
inline ImplicitValue calcTorusForm(const Vector3& p, double R, double a, double b) {
    const double c = std::min(a, b), ra = c / (a * a), zb = c / (b * b);
    const double tiny = 1e-12 * R, rhoTrue = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const Vector3 radial = rhoTrue > tiny ? Vector3(p.x() / rhoTrue, p.y() / rhoTrue, 0) : Vector3(Vector3::UnitX());
    const double rho = std::max(rhoTrue, tiny), q = rho - R;
    ImplicitValue value;
    value.f = 0.5 * (ra * q * q + zb * p.z() * p.z() - c);
    value.gradient = Vector3(ra * q * radial.x(), ra * q * radial.y(), zb * p.z());
    // d(q radial) = radial radial^T + q/rho hoop hoop^T
    const double xx = radial.x() * radial.x(), xy = radial.x() * radial.y(), yy = radial.y() * radial.y();
    const double h = q / rho;
    value.hessian << ra * (xx + h * yy), ra * (1 - h) * xy, 0, ra * (1 - h) * xy, ra * (yy + h * xx), 0, 0, 0, zb;
    return value;
}

/** ((R + a cos v) cos u, (R + a cos v) sin u, b sin v) with its derivatives (thesis Eqn. 3.69 if a = b). */
inline ParametricValue calcTorusPoint(const Vector2& uv, double R, double a, double b) {
    const SineCosine angles(uv);
    const double cu = angles.cosine[0], su = angles.sine[0], cv = angles.cosine[1], sv = angles.sine[1];
    const double rho = R + a * cv;
    return {{rho * cu, rho * su, b * sv}, {-rho * su, rho * cu, 0},       {-a * sv * cu, -a * sv * su, b * cv},
            {-rho * cu, -rho * su, 0},    {a * sv * su, -a * sv * cu, 0}, {-a * cv * cu, -a * cv * su, -b * sv}};
}

/** (u, v) of a point of the surface, or of one on the same ray from the tube's center as the section is scaled. */
inline Vector2 calcTorusParameters(const Vector3& p, double R, double a, double b) {
    return {std::atan2(p.y(), p.x()), std::atan2(p.z() / b, (std::hypot(p.x(), p.y()) - R) / a)};
}

}  // namespace tautline
