// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/contact_geometry_surface.h"

#include <cmath>

#include "height_map_patch.h"
#include "tautline/error.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/half_space.h"
#include "tautline/surfaces/scaled_surface.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline {

namespace {

/** How far a surface is from a point next to it [m]. */
double calcOffset(const ContactGeometrySurface& surface, const Vector3& p_S) {
    const ImplicitValue value = surface.calcImplicit(p_S);
    return std::abs(value.f) / value.gradient.norm();
}

/** The smallest radius of curvature where the way down from (1, 1, 1) meets the surface: a length that goes
with the geometry's own. */
double calcSmallestRadius(const Surface& surface) {
    const DarbouxFrame frame = surface.calcFrame(surface.findSurfacePoint(Vector3::Ones()), Vector3(1, -2, 0.5));
    // The eigenvalues of the second fundamental form lie within its row sums.
    return 1 / std::max(std::abs(frame.kappaN) + std::abs(frame.tauG), std::abs(frame.kappaB) + std::abs(frame.tauG));
}

}  // namespace

ContactGeometrySurface::ContactGeometrySurface(const SimTK::ContactGeometry& geometry, double size)
    : m_geometry(geometry), m_size(size == 0 ? 1 : size) {
    require(!geometry.isEmptyHandle(), "contact geometry surface: the geometry is an empty handle");
    require(geometry.isSmooth(), "contact geometry surface: the geometry is not smooth");
    if (SimTK::ContactGeometry::SmoothHeightMap::isInstance(geometry))
        m_heightMap = std::make_shared<HeightMapPatch>(
            SimTK::ContactGeometry::SmoothHeightMap::getAs(geometry).getBicubicSurface());
    if (size == 0) m_size = m_heightMap ? m_heightMap->getSize() : findSize();
    require(std::isfinite(m_size) && m_size > 0, "contact geometry surface: size must be positive and finite, but is ",
            m_size);
}

/** The way down is made of steps no longer than the size, of which there is a limited number: it has to be large
enough. */
double ContactGeometrySurface::findSize() {
    constexpr double kLargest = 1e12, kOnSurface = 1e-6;
    for (m_size = 1; m_size < kLargest; m_size *= 10)
        if (calcOffset(*this, findSurfacePoint(Vector3::Ones()).p) < kOnSurface * m_size)
            return calcSmallestRadius(*this);
    return kNaN;
}

std::string ContactGeometrySurface::getDescription() const {
    std::ostringstream text;
    text << "contact_geometry(size=" << m_size << ")";
    return text.str();
}

double ContactGeometrySurface::calcDomainMargin(const SurfacePoint& point) const {
    return m_heightMap ? m_heightMap->calcDomainMargin({point.p, point.p.head<2>(), 0}) : kInfinity;
}

double ContactGeometrySurface::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    return m_heightMap ? m_heightMap->calcHeightAndNormal(p_S, N_S) : ImplicitSurface::calcHeightAndNormal(p_S, N_S);
}

ImplicitValue ContactGeometrySurface::calcImplicit(const Vector3& p_S) const {
    if (m_heightMap) return m_heightMap->calcImplicit(p_S);
    const SimTK::Vec3 p = toSimTK(p_S);
    return {-m_geometry.calcSurfaceValue(p), -toEigen(m_geometry.calcSurfaceGradient(p)),
            -toEigen(m_geometry.calcSurfaceHessian(p))};
}

namespace {

/** Simbody's half space is x > 0. */
std::shared_ptr<const Surface> makePlane(double size) {
    Matrix3 turned;  // z to -x, x to z
    turned << 0, 0, -1, 0, 1, 0, 1, 0, 0;
    return makeScaledSurface(std::make_shared<HalfSpace>(size), turned);
}

}  // namespace

std::shared_ptr<const Surface> makeSurface(const SimTK::ContactGeometry& geometry) {
    using SimTK::ContactGeometry;
    require(!geometry.isEmptyHandle(), "contact geometry: the handle is empty");
    if (ContactGeometry::Sphere::isInstance(geometry))
        return std::make_shared<Sphere>(ContactGeometry::Sphere::getAs(geometry).getRadius());
    if (ContactGeometry::Cylinder::isInstance(geometry))
        return std::make_shared<Cylinder>(ContactGeometry::Cylinder::getAs(geometry).getRadius());
    if (ContactGeometry::Ellipsoid::isInstance(geometry))
        return std::make_shared<Ellipsoid>(toEigen(ContactGeometry::Ellipsoid::getAs(geometry).getRadii()));
    if (ContactGeometry::Torus::isInstance(geometry)) {
        const auto& torus = ContactGeometry::Torus::getAs(geometry);
        return std::make_shared<Torus>(torus.getTorusRadius(), torus.getTubeRadius());
    }
    if (ContactGeometry::HalfSpace::isInstance(geometry)) return makePlane(1);
    if (ContactGeometry::SmoothHeightMap::isInstance(geometry))
        return std::make_shared<HeightMapPatch>(ContactGeometry::SmoothHeightMap::getAs(geometry).getBicubicSurface());
    return std::make_shared<ContactGeometrySurface>(geometry);
}

}  // namespace tautline
