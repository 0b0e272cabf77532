#include "tautline/simbody/contact_geometry_surface.h"

#include <cmath>

#include "tautline/error.h"
#include "tautline/simbody/conversions.h"

namespace tautline {
namespace {

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
    if (size == 0) m_size = calcSmallestRadius(*this);
    require(std::isfinite(m_size) && m_size > 0, "contact geometry surface: size must be positive and finite, but is ",
            m_size);
}

std::string ContactGeometrySurface::getDescription() const {
    std::ostringstream text;
    text << "contact_geometry(size=" << m_size << ")";
    return text.str();
}

ImplicitValue ContactGeometrySurface::calcImplicit(const Vec3& p_S) const {
    const SimTK::Vec3 p = toSimTK(p_S);
    return {-m_geometry.calcSurfaceValue(p), -toEigen(m_geometry.calcSurfaceGradient(p)),
            -toEigen(m_geometry.calcSurfaceHessian(p))};
}

}  // namespace tautline
