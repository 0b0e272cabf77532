// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/contact_geometry_surface.h"

#include <cmath>

#include "tautline/error.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/patch_shape.h"

namespace tautline {

/** z = f(x, y) of a bicubic surface, outward up, with the continuation beyond its edges that all patches have. */
class HeightMapPatch final : public PatchShape<HeightMapPatch> {
public:
    explicit HeightMapPatch(const SimTK::BicubicSurface& surface)
        : PatchShape(calcDomain(surface), true, 1), m_surface(surface) {
        measure();
    }

    std::string getDescription() const override { return "height_map"; }

    void calcPartials(const Vec2& uv, PatchPartials& partials) const {
        SimTK::BicubicSurface::PatchHint hint;
        const SimTK::Vec2 xy(uv.x(), uv.y());
        partials.setZero();
        partials.col(0).head<2>() = uv;
        partials(0, 3) = partials(1, 1) = 1;
        partials(2, 0) = m_surface.calcValue(xy, hint);
        // The fourth derivative, which matters beyond a corner only, is not to be had.
        for (int i = 0; i < 3; ++i)
            for (int j = i == 0; j < 3 && i + j < 4; ++j) {
                SimTK::Array_<int> components(i, 0);
                components.insert(components.end(), j, 1);
                partials(2, 3 * i + j) = m_surface.calcDerivative(components, xy, hint);
            }
    }

    /** f = z - height(x, y). */
    ImplicitValue calcImplicit(const Vec3& p_S) const {
        const ParametricValue s = calcParametric(p_S.head<2>(), 0);
        Mat3 hessian = Mat3::Zero();
        hessian(0, 0) = -s.xuu.z(), hessian(1, 1) = -s.xvv.z();
        hessian(0, 1) = hessian(1, 0) = -s.xuv.z();
        return {p_S.z() - s.x.z(), Vec3(-s.xu.z(), -s.xv.z(), 1), hessian};
    }

private:
    static ParameterDomain calcDomain(const SimTK::BicubicSurface& surface) {
        const SimTK::Vec2 min = surface.getMinXY(), max = surface.getMaxXY();
        return {Vec2(min[0], min[1]), Vec2(max[0], max[1])};
    }

    SimTK::BicubicSurface m_surface;
};

namespace {

/** How far a surface is from a point next to it [m]. */
double calcOffset(const ContactGeometrySurface& surface, const Vec3& p_S) {
    const ImplicitValue value = surface.calcImplicit(p_S);
    return std::abs(value.f) / value.gradient.norm();
}

/** The smallest radius of curvature where the way down from (1, 1, 1) meets the surface: a length that goes
with the geometry's own. */
double calcSmallestRadius(const Surface& surface) {
    const DarbouxFrame frame = surface.calcFrame(surface.findSurfacePoint(Vec3::Ones()), Vec3(1, -2, 0.5));
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
        if (calcOffset(*this, findSurfacePoint(Vec3::Ones()).p) < kOnSurface * m_size) return calcSmallestRadius(*this);
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

double ContactGeometrySurface::calcHeightAndNormal(const Vec3& p_S, Vec3& N_S) const {
    return m_heightMap ? m_heightMap->calcHeightAndNormal(p_S, N_S) : ImplicitSurface::calcHeightAndNormal(p_S, N_S);
}

ImplicitValue ContactGeometrySurface::calcImplicit(const Vec3& p_S) const {
    if (m_heightMap) return m_heightMap->calcImplicit(p_S);
    const SimTK::Vec3 p = toSimTK(p_S);
    return {-m_geometry.calcSurfaceValue(p), -toEigen(m_geometry.calcSurfaceGradient(p)),
            -toEigen(m_geometry.calcSurfaceHessian(p))};
}

}  // namespace tautline
