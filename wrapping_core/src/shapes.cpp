/** Constructors, descriptions and closed forms of the elementary shapes. */
#include "shape_checks.h"
#include "tautline/cylinder.h"
#include "tautline/ellipsoid.h"
#include "tautline/sphere.h"
#include "tautline/torus.h"

namespace tautline {

// Declared extern in the headers: the integrator is compiled once for each shape, here.
template class ImplicitShape<Sphere>;
template class ImplicitShape<Cylinder>;
template class ImplicitShape<Ellipsoid>;
template class ImplicitShape<Torus>;

namespace {

/** A unit vector orthogonal to unit e, nearest to `wish` if that is not along e. */
Vec3 makeOrthogonalUnit(const Vec3& e, const Vec3& wish) {
    Vec3 v = wish - wish.dot(e) * e;
    if (v.norm() < 1e-9) v = e.unitOrthogonal();
    return v.normalized();
}

}  // namespace

Sphere::Sphere(double radius) : m_radius(radius) {
    requireLength(radius, "sphere: radius");
}

std::string Sphere::getDescription() const {
    return describeShape("sphere(radius=", m_radius, ")");
}

double Sphere::calcHeight(const Vec3& p_S, Vec3& N_S) const {
    const double distance = p_S.norm();
    N_S = distance > 0 ? Vec3(p_S / distance) : Vec3(Vec3::UnitX());
    return distance - m_radius;
}

SurfacePoint Sphere::findSurfacePoint(const Vec3& p_S) const {
    Vec3 N;
    calcHeight(p_S, N);
    return {m_radius * N};
}

DarbouxFrame Sphere::calcFrame(const SurfacePoint& point, const Vec3& direction_S) const {
    DarbouxFrame frame;
    const double distance = point.p.norm();
    frame.x = point.p, frame.N = point.p / distance;
    frame.t = makeTangent(direction_S, frame.N), frame.B = frame.t.cross(frame.N);
    frame.kappaN = frame.kappaB = -1 / distance, frame.tauG = 0;
    return frame;
}

void Sphere::shootGeodesic(const GeodesicStart& start, const GeodesicOptions&, Geodesic& geodesic) const {
    const double angle = start.length / m_radius, c = std::cos(angle), s = std::sin(angle);
    const DarbouxFrame P = Sphere::calcFrame(start.point, start.tangent);
    geodesic.P = geodesic.Q = P;
    geodesic.Q.N = c * P.N + s * P.t;  // B stays: a great circle has no torsion
    geodesic.Q.t = c * P.t - s * P.N;
    geodesic.Q.x = m_radius * geodesic.Q.N;
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = start.length;
    geodesic.a = c, geodesic.aDot = -s / m_radius;
    geodesic.r = m_radius * s, geodesic.rDot = c;
    geodesic.steps = 0, geodesic.converged = true;
    geodesic.hasConjugatePoint = std::abs(angle) >= kPi;
    geodesic.maxKappaN = P.kappaN;
}

void Sphere::findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const {
    const double s = -A_S.dot(e_S);
    const Vec3 D = A_S + s * e_S;  // nearest the centre
    Vec3 N = makeOrthogonalUnit(e_S, D);
    if (N.dot(clearance.N) < 0) N = -N;  // of the two critical points, the one on the side that is kept
    clearance.C = {m_radius * N}, clearance.N = N, clearance.lineCoordinate = s;
    clearance.distance = D.dot(N) - m_radius, clearance.scale = 1 / m_radius, clearance.found = true;
}

Cylinder::Cylinder(double radius) : m_radius(radius) {
    requireLength(radius, "cylinder: radius");
}

std::string Cylinder::getDescription() const {
    return describeShape("cylinder(radius=", m_radius, ")");
}

double Cylinder::calcHeight(const Vec3& p_S, Vec3& N_S) const {
    const double rho = p_S.head<2>().norm();
    N_S = rho > 0 ? Vec3(p_S.x() / rho, p_S.y() / rho, 0) : Vec3(Vec3::UnitX());
    return rho - m_radius;
}

SurfacePoint Cylinder::findSurfacePoint(const Vec3& p_S) const {
    Vec3 N;
    calcHeight(p_S, N);
    return {Vec3(m_radius * N.x(), m_radius * N.y(), p_S.z())};
}

/** N turns by the part of a displacement that is across the axis, over rho. */
DarbouxFrame Cylinder::calcFrame(const SurfacePoint& point, const Vec3& direction_S) const {
    DarbouxFrame frame;
    const double rho = point.p.head<2>().norm();
    frame.x = point.p, frame.N = Vec3(point.p.x() / rho, point.p.y() / rho, 0);
    frame.t = makeTangent(direction_S, frame.N), frame.B = frame.t.cross(frame.N);
    const Vec2 dN_t = frame.t.head<2>() / rho, dN_B = frame.B.head<2>() / rho;
    frame.kappaN = -frame.t.head<2>().dot(dN_t), frame.tauG = frame.B.head<2>().dot(dN_t);
    frame.kappaB = -frame.B.head<2>().dot(dN_B);
    return frame;
}

void Cylinder::shootGeodesic(const GeodesicStart& start, const GeodesicOptions&, Geodesic& geodesic) const {
    geodesic.P = Cylinder::calcFrame(start.point, start.tangent);
    const DarbouxFrame& P = geodesic.P;
    const double hoop = P.t.y() * P.N.x() - P.t.x() * P.N.y();  // of t along the parallel
    const double angle = hoop * start.length / m_radius, c = std::cos(angle), s = std::sin(angle);
    const auto turn = [c, s](const Vec3& v) { return Vec3(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()); };
    geodesic.Q = P;
    geodesic.Q.x = turn(P.x) + P.t.z() * start.length * Vec3::UnitZ();
    geodesic.Q.t = turn(P.t), geodesic.Q.N = turn(P.N), geodesic.Q.B = turn(P.B);
    geodesic.endPoint = {geodesic.Q.x};
    geodesic.length = geodesic.r = start.length;
    geodesic.a = 1, geodesic.aDot = 0, geodesic.rDot = 1;
    geodesic.steps = 0, geodesic.converged = true, geodesic.hasConjugatePoint = false;
    geodesic.maxKappaN = P.kappaN;
}

void Cylinder::findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const {
    // D and the axis point nearest it span the common normal of line and axis.
    const double sine2 = e_S.x() * e_S.x() + e_S.y() * e_S.y();
    const bool isAlongAxis = sine2 < 1e-24;
    const double s = isAlongAxis ? 0 : -(A_S.x() * e_S.x() + A_S.y() * e_S.y()) / sine2;
    const Vec3 D = A_S + s * e_S;
    Vec3 N = isAlongAxis ? makeOrthogonalUnit(Vec3::UnitZ(), D) : Vec3(e_S.y(), -e_S.x(), 0).normalized();
    const double side = clearance.N.allFinite() ? N.dot(clearance.N) : N.dot(D);
    if (side < 0) N = -N;
    const Vec3 C(m_radius * N.x(), m_radius * N.y(), D.z());
    // kappa_n along the line vanishes with sine2; 1/size stands in for it then.
    clearance.C = {C}, clearance.N = N, clearance.lineCoordinate = s;
    clearance.distance = (D - C).dot(N), clearance.scale = 1 / m_radius, clearance.found = true;
}

Ellipsoid::Ellipsoid(const Vec3& semiAxes)
    : CentralQuadric(semiAxes.cwiseProduct(semiAxes).cwiseInverse(), semiAxes.minCoeff()), m_semiAxes(semiAxes) {
    requireLength(semiAxes.x(), "ellipsoid: semi-axis x");
    requireLength(semiAxes.y(), "ellipsoid: semi-axis y");
    requireLength(semiAxes.z(), "ellipsoid: semi-axis z");
}

std::string Ellipsoid::getDescription() const {
    return describeShape("ellipsoid(semi-axes=", m_semiAxes.x(), ", ", m_semiAxes.y(), ", ", m_semiAxes.z(), ")");
}

double Sphere::findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const {
    return std::clamp(-A_S.dot(e_S), 0.0, length);
}

double Cylinder::findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const {
    const double sine2 = e_S.head<2>().squaredNorm();
    return sine2 > 0 ? std::clamp(-A_S.head<2>().dot(e_S.head<2>()) / sine2, 0.0, length) : 0;
}

Torus::Torus(double ringRadius, double tubeRadius) : m_ringRadius(ringRadius), m_tubeRadius(tubeRadius) {
    requireLength(ringRadius, "torus: ring radius");
    requireLength(tubeRadius, "torus: tube radius");
    require(tubeRadius < ringRadius, "torus: tube radius ", tubeRadius, " must be less than the ring radius ",
            ringRadius);
}

std::string Torus::getDescription() const {
    return describeShape("torus(ring radius=", m_ringRadius, ", tube radius=", m_tubeRadius, ")");
}

double Torus::calcHeight(const Vec3& p_S, Vec3& N_S) const {
    const double rho = std::hypot(p_S.x(), p_S.y());
    const Vec3 radial = rho > 0 ? Vec3(p_S.x() / rho, p_S.y() / rho, 0) : Vec3(Vec3::UnitX());
    const Vec3 fromTube = p_S - m_ringRadius * radial;
    const double distance = fromTube.norm();
    N_S = distance > 0 ? Vec3(fromTube / distance) : Vec3(Vec3::UnitZ());
    return distance - m_tubeRadius;
}

}  // namespace tautline
