/** Constructors, descriptions and closed forms of the shapes beyond the elementary four. */
#include <algorithm>

#include "shape_checks.h"
#include "tautline/capsule.h"
#include "tautline/cone.h"
#include "tautline/elliptic_cylinder.h"
#include "tautline/elliptic_torus.h"
#include "tautline/paraboloid.h"
#include "tautline/plane.h"

namespace tautline {

EllipticTorus::EllipticTorus(double ringRadius, double radialSemiAxis, double axialSemiAxis)
    : m_ringRadius(ringRadius),
      m_radial(radialSemiAxis),
      m_axial(axialSemiAxis),
      m_size(std::min(radialSemiAxis, axialSemiAxis)) {
    requireLength(ringRadius, "elliptic torus: ring radius");
    requireLength(radialSemiAxis, "elliptic torus: radial semi-axis");
    requireLength(axialSemiAxis, "elliptic torus: axial semi-axis");
    require(radialSemiAxis < ringRadius, "elliptic torus: radial semi-axis ", radialSemiAxis,
            " must be less than the ring radius ", ringRadius);
}

std::string EllipticTorus::getDescription() const {
    return describeShape("elliptic torus(ring radius=", m_ringRadius, ", radial semi-axis=", m_radial,
                         ", axial semi-axis=", m_axial, ")");
}

Paraboloid::Paraboloid(double A, double B) : m_A(A), m_B(B) {
    requireLength(A, "paraboloid: A");
    requireLength(B, "paraboloid: B");
}

std::string Paraboloid::getDescription() const {
    return describeShape("paraboloid(A=", m_A, ", B=", m_B, ")");
}

/** The minimum of the quadratic f along the line, or the lower end of a line along the axis. */
double Paraboloid::findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const {
    const double quadratic = e_S.x() * e_S.x() / m_A + e_S.y() * e_S.y() / m_B;
    const double linear = 2 * (A_S.x() * e_S.x() / m_A + A_S.y() * e_S.y() / m_B) - e_S.z();
    const double lowest = -linear / (2 * quadratic);
    if (std::isfinite(lowest)) return std::clamp(lowest, 0.0, length);
    return linear < 0 ? length : 0;
}

Plane::Plane(double size) : m_size(size) {
    requireLength(size, "plane: size");
}

std::string Plane::getDescription() const {
    return describeShape("plane(size=", m_size, ")");
}

void Plane::shootGeodesic(const GeodesicStart& start, const GeodesicOptions&, Geodesic& geodesic) const {
    geodesic.P = geodesic.Q = calcFrame(start.point, start.tangent);
    geodesic.Q.x += start.length * geodesic.P.t;
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = geodesic.r = start.length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = 0;
}

void Plane::findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const {
    clearance.found = false;
    constexpr double kParallel = 1e-15;  // rounding of a unit vector
    if (!(std::abs(e_S.z()) <= kParallel)) return;
    clearance.C = findSurfacePoint(A_S), clearance.N = Vec3::UnitZ(), clearance.lineCoordinate = 0;
    clearance.distance = A_S.z(), clearance.scale = 1 / m_size, clearance.found = true;
}

double Plane::findLowestPoint(const Vec3&, const Vec3& e_S, double length) const {
    return e_S.z() < 0 ? length : 0;
}

Cone::Cone(double halfAngle, double radius, double edgeRadius)
    : m_halfAngle(halfAngle),
      m_radius(radius),
      m_edgeRadius(edgeRadius),
      m_sine(std::sin(halfAngle)),
      m_cosine(std::cos(halfAngle)) {
    require(halfAngle > 0 && halfAngle < 0.5 * kPi, "cone: half angle must be between 0 and pi/2, but is ", halfAngle);
    requireLength(radius, "cone: radius");
    require(edgeRadius >= 0 && edgeRadius < radius, "cone: edge radius must be in [0, ", radius, "), but is ",
            edgeRadius);
}

std::string Cone::getDescription() const {
    return describeShape("cone(half angle=", m_halfAngle, ", radius=", m_radius, ", edge radius=", m_edgeRadius, ")");
}

double Cone::calcDomainMargin(const SurfacePoint& point) const {
    constexpr double kApex = 1e-6;  // in radii: closer, curvature is beyond use
    const double margin = std::hypot(point.p.x(), point.p.y()) - std::max(m_edgeRadius, kApex * m_radius);
    return point.p.z() > 0 ? margin : std::min(margin, point.p.z() - kApex * m_radius);
}

/** The nearest point; beside the apex where that is nearest. */
SurfacePoint Cone::findSurfacePoint(const Vec3& p_S) const {
    constexpr double kBesideApex = 1e-9;  // in radii: has a normal, and is out of the domain
    const double rho = std::hypot(p_S.x(), p_S.y());
    const Vec3 radial = rho > 0 ? Vec3(p_S.x() / rho, p_S.y() / rho, 0) : Vec3(Vec3::UnitX());
    const double fromApex = std::max(rho * m_sine + p_S.z() * m_cosine, kBesideApex * m_radius);
    return {fromApex * (m_sine * radial + m_cosine * Vec3::UnitZ())};
}

/** On the unrolled cone, with polar coordinates (distance from the apex, angle about it = turning about the
axis times sin(alpha)), the geodesic is straight: m0 + s cos(psi) along the start's ray, s sin(psi) across. */
void Cone::shootGeodesic(const GeodesicStart& start, const GeodesicOptions&, Geodesic& geodesic) const {
    const DarbouxFrame P = calcFrame(start.point, start.tangent);
    const double rho = std::hypot(P.x.x(), P.x.y()), m0 = P.x.norm(), length = start.length;
    const Vec3 radial(P.x.x() / rho, P.x.y() / rho, 0), hoop(-radial.y(), radial.x(), 0);
    const Vec3 ray = m_sine * radial + m_cosine * Vec3::UnitZ();
    const double along = P.t.dot(ray), across = P.t.dot(hoop);
    const double x = m0 + length * along, y = length * across, m1 = std::hypot(x, y);
    const double unrolled = std::atan2(y, x), turn = unrolled / m_sine;
    const Vec3 endRadial = std::cos(turn) * radial + std::sin(turn) * hoop;
    const Vec3 endHoop = std::cos(turn) * hoop - std::sin(turn) * radial;
    const Vec3 endRay = m_sine * endRadial + m_cosine * Vec3::UnitZ();
    const double c = std::cos(unrolled), s = std::sin(unrolled);
    geodesic.P = P;
    geodesic.endPoint = {m1 * endRay};
    geodesic.Q = calcFrame(geodesic.endPoint, (c * along + s * across) * endRay + (c * across - s * along) * endHoop);
    geodesic.length = geodesic.r = length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = std::max(P.kappaN, geodesic.Q.kappaN);
}

EllipticCylinder::EllipticCylinder(double semiAxisX, double semiAxisY)
    : CentralQuadric({1 / (semiAxisX * semiAxisX), 1 / (semiAxisY * semiAxisY), 0}, std::min(semiAxisX, semiAxisY)),
      m_semiAxes(semiAxisX, semiAxisY) {
    requireLength(semiAxisX, "elliptic cylinder: semi-axis x");
    requireLength(semiAxisY, "elliptic cylinder: semi-axis y");
}

std::string EllipticCylinder::getDescription() const {
    return describeShape("elliptic cylinder(semi-axes=", m_semiAxes.x(), ", ", m_semiAxes.y(), ")");
}

Capsule::Capsule(double radius, double length, double capHeight)
    : m_radius(radius), m_length(length), m_capHeight(capHeight) {
    requireLength(radius, "capsule: radius");
    require(std::isfinite(length) && length >= 0, "capsule: length must be finite and not negative, but is ", length);
    requireLength(capHeight, "capsule: cap height");
}

SurfacePoint Capsule::findSurfacePoint(const Vec3& p_S) const {
    const Vec3 onAxis(0, 0, std::clamp(p_S.z(), -0.5 * m_length, 0.5 * m_length)), q = p_S - onAxis;
    const double b = q.head<2>().squaredNorm() / (m_radius * m_radius), w = q.z() / m_capHeight, a = w * w * w * w;
    if (a < 1 && b < 0.25 * (1 - a)) {
        // About the axis the steepest descent leads out through the tip, however far that is: begin half way to the
        // side.
        const double rho = p_S.head<2>().norm(), half = 0.5 * m_radius * std::sqrt(1 - a);
        const Vec2 outward = rho > 0 ? Vec2(p_S.head<2>() / rho) : Vec2(Vec2::UnitX());
        return ImplicitShape::findSurfacePoint(Vec3(half * outward.x(), half * outward.y(), p_S.z()));
    }
    if (!(b + a > 4)) return ImplicitShape::findSurfacePoint(p_S);
    // onAxis + k q with a k^4 + b k^2 = 1, then the foot of a point that lies on the surface but for rounding
    const double k = std::sqrt(2 / (b + std::sqrt(b * b + 4 * a)));
    return ImplicitShape::findSurfacePoint(onAxis + k * q);
}

std::string Capsule::getDescription() const {
    return describeShape("capsule(radius=", m_radius, ", length=", m_length, ", cap height=", m_capHeight, ")");
}

}  // namespace tautline
