/** The one place where the parametric shapes are instantiated: their headers declare it extern, so that a user's
code does not compile the integrator again for each. */
#include <algorithm>

#include "tautline/capsule.h"
#include "tautline/cone.h"
#include "tautline/elliptic_cylinder.h"
#include "tautline/elliptic_torus.h"
#include "tautline/paraboloid.h"
#include "tautline/parametric_cylinder.h"
#include "tautline/parametric_ellipsoid.h"
#include "tautline/parametric_sphere.h"
#include "tautline/parametric_torus.h"
#include "tautline/plane.h"

namespace tautline {

template class ParametricShape<ParametricSphere>;
template class ParametricTwin<ParametricSphere, Sphere>;
template class ParametricShape<ParametricCylinder>;
template class ParametricTwin<ParametricCylinder, Cylinder>;
template class ParametricShape<ParametricEllipsoid>;
template class ParametricTwin<ParametricEllipsoid, Ellipsoid>;
template class ParametricShape<ParametricTorus>;
template class ParametricTwin<ParametricTorus, Torus>;
template class ParametricShape<ParametricEllipticCylinder>;
template class ParametricTwin<ParametricEllipticCylinder, EllipticCylinder>;
template class ParametricShape<ParametricEllipticTorus>;
template class ParametricTwin<ParametricEllipticTorus, EllipticTorus>;
template class ParametricShape<ParametricParaboloid>;
template class ParametricTwin<ParametricParaboloid, Paraboloid>;
template class ParametricShape<ParametricPlane>;
template class ParametricTwin<ParametricPlane, Plane>;
template class ParametricShape<ParametricCone>;
template class ParametricTwin<ParametricCone, Cone>;
template class ParametricShape<ParametricCapsule>;
template class ParametricTwin<ParametricCapsule, Capsule>;

/** On the side rho = r sqrt(1 - w^4), w = (|v| - L/2)/c; at the tips |z| = L/2 + c (1 - rho^2/r^2)^(1/4). */
ParametricValue ParametricCapsule::calcParametric(const Vec2& uv, int chart) const {
    const double r = m_twin.getRadius(), c = m_twin.getCapHeight(), half = 0.5 * m_twin.getLength();
    if (chart == 0) {
        const double side = uv[1] < 0 ? -1 : 1, w = std::max(std::abs(uv[1]) - half, 0.0) / c, w2 = w * w;
        const double root = std::sqrt(1 - w2 * w2);
        const double rho = r * root, rho1 = -2 * r * side / c * w2 * w / root;
        const double rho2 = -2 * r / (c * c) * w2 * (3 - w2 * w2) / (root * root * root);
        const double cu = std::cos(uv[0]), su = std::sin(uv[0]);
        return {{rho * cu, rho * su, uv[1]}, {-rho * su, rho * cu, 0},   {rho1 * cu, rho1 * su, 1},
                {-rho * cu, -rho * su, 0},   {-rho1 * su, rho1 * cu, 0}, {rho2 * cu, rho2 * su, 0}};
    }
    // In chart 2 u and v change places, so that xu x xv points outward there too.
    const double side = chart == 1 ? 1 : -1, k = 1 / (r * r), q = 1 - k * uv.squaredNorm();
    const double quarter = std::sqrt(std::sqrt(q)), slope = -0.5 * side * c * k * quarter / q;  // dz/dx = slope x
    const double bend = 1.5 * k / q;  // d slope/dx / slope / x
    const double u = uv[0], v = uv[1], z = side * (half + c * quarter);
    const double zuu = slope * (1 + bend * u * u), zuv = slope * bend * u * v, zvv = slope * (1 + bend * v * v);
    if (chart == 1) return {{u, v, z}, {1, 0, slope * u}, {0, 1, slope * v}, {0, 0, zuu}, {0, 0, zuv}, {0, 0, zvv}};
    return {{v, u, z}, {0, 1, slope * u}, {1, 0, slope * v}, {0, 0, zuu}, {0, 0, zuv}, {0, 0, zvv}};
}

/** Kept to where the chart has slopes. */
Vec2 ParametricCapsule::calcNearbyParameters(const Vec3& p_S, int chart) const {
    constexpr double kEdge = 0.95;
    if (chart == 0) {
        const double end = 0.5 * m_twin.getLength() + kEdge * m_twin.getCapHeight();
        return {std::atan2(p_S.y(), p_S.x()), std::clamp(p_S.z(), -end, end)};
    }
    const double rho = p_S.head<2>().norm(), most = kEdge * m_twin.getRadius(), k = rho > most ? most / rho : 1;
    return chart == 1 ? Vec2(k * p_S.x(), k * p_S.y()) : Vec2(k * p_S.y(), k * p_S.x());
}

/** By the distance from the axis: in the middle of a cap either kind of chart will do. */
int ParametricCapsule::chooseChart(const Vec3& p_S, const Vec3& /*t_S*/, int current) const {
    const double rho2 = p_S.head<2>().squaredNorm() / (m_twin.getRadius() * m_twin.getRadius());
    const int tip = p_S.z() < 0 ? 2 : 1;
    if (std::abs(p_S.z()) <= 0.5 * m_twin.getLength() || rho2 > 0.8) return 0;
    if (rho2 < 0.5) return tip;
    return current == 0 ? 0 : tip;
}

}  // namespace tautline
