// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/scaled_surface.h"

#include "tautline/error.h"

namespace tautline {
namespace {

/** A surface of unknown class, of which the scaled forms ask what they ask of one that is known. */
class SharedSurface {
public:
    explicit SharedSurface(std::shared_ptr<const Surface> surface) : m_surface(std::move(surface)) {}

    double getSize() const { return m_surface->getSize(); }
    std::string getDescription() const { return m_surface->getDescription(); }
    bool isConvex() const { return m_surface->isConvex(); }
    double calcDomainMargin(const SurfacePoint& point) const { return m_surface->calcDomainMargin(point); }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const { return m_surface->calcHeight(p_S, N_S); }
    Vec3 getHoleAxis() const { return m_surface->getHoleAxis(); }
    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const { return m_surface->countHoleCrossings(A_S, B_S); }

protected:
    std::shared_ptr<const Surface> m_surface;
};

class SharedImplicitSurface : public SharedSurface {
public:
    using SharedSurface::SharedSurface;

    ImplicitValue calcImplicit(const Vec3& p_S) const {
        ImplicitValue value;
        m_surface->calcImplicitForm(p_S, value);
        return value;
    }
};

/** The charts are those of the base's own feet. */
class SharedParametricSurface : public SharedSurface {
public:
    explicit SharedParametricSurface(std::shared_ptr<const Surface> surface) : SharedSurface(std::move(surface)) {
        const SurfacePoint point = m_surface->findSurfacePoint(Vec3::Constant(getSize()));
        const ParametricValue s = calcParametric(point.uv, point.chart);
        m_normalSign = s.xu.cross(s.xv).dot(m_surface->calcFrame(point, s.xu).N) < 0 ? -1 : 1;
    }
    ParametricValue calcParametric(const Vec2& uv, int chart) const {
        ParametricValue value;
        m_surface->calcParametricForm({Vec3::Constant(kNaN), uv, chart}, value);
        return value;
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int /*chart*/) const { return m_surface->findSurfacePoint(p_S).uv; }
    double getNormalSign() const { return m_normalSign; }
    int chooseChart(const Vec3& p_S, const Vec3& /*t_S*/, int /*current*/) const {
        return m_surface->findSurfacePoint(p_S).chart;
    }

private:
    double m_normalSign;
};

}  // namespace

std::shared_ptr<const Surface> makeScaledSurface(std::shared_ptr<const Surface> base, const LinearMap& map) {
    require(base != nullptr, "scaled surface: needs a base surface");
    const SurfacePoint point = base->findSurfacePoint(Vec3::Constant(base->getSize()));
    ImplicitValue implicitValue;
    if (base->calcImplicitForm(point.p, implicitValue))
        return std::make_shared<ScaledImplicitSurface<SharedImplicitSurface>>(SharedImplicitSurface(base), map);
    ParametricValue parametricValue;
    require(base->calcParametricForm(point, parametricValue), "scaled surface: ", base->getDescription(),
            " has neither an implicit nor a parametric form");
    return std::make_shared<ScaledParametricSurface<SharedParametricSurface>>(SharedParametricSurface(base), map);
}

}  // namespace tautline
