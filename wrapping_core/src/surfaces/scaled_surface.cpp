// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/scaled_surface.h"

#include "tautline/error.h"

namespace tautline {
namespace {

/** A shared surface of unknown class in one of its forms: what the scaled forms need by value. */
template <class Form>
class SharedForm : public SurfaceDecorator<Form, std::shared_ptr<const Surface>> {
public:
    using SurfaceDecorator<Form, std::shared_ptr<const Surface>>::SurfaceDecorator;

    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        return this->getBase().calcHeightAndNormal(p_S, N_S);
    }
};

class SharedImplicitSurface final : public SharedForm<ImplicitShape<SharedImplicitSurface>> {
public:
    explicit SharedImplicitSurface(std::shared_ptr<const Surface> surface) : SharedForm(std::move(surface)) {}

    ImplicitValue calcImplicit(const Vector3& p_S) const {
        ImplicitValue value;
        getBase().calcImplicitForm(p_S, value);
        return value;
    }
};

/** The charts are those of the base's own feet. */
class SharedParametricSurface final : public SharedForm<ParametricShape<SharedParametricSurface>> {
public:
    explicit SharedParametricSurface(std::shared_ptr<const Surface> surface) : SharedForm(std::move(surface)) {
        const SurfacePoint point = getBase().findSurfacePoint(Vector3::Constant(getSize()));
        const ParametricValue s = calcParametric(point.uv, point.chart);
        m_normalSign = s.xu.cross(s.xv).dot(getBase().calcFrame(point, s.xu).N) < 0 ? -1 : 1;
    }
    ParametricValue calcParametric(const Vector2& uv, int chart) const {
        ParametricValue value;
        getBase().calcParametricForm({Vector3::Constant(kNaN), uv, chart}, value);
        return value;
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int /*chart*/) const { return getBase().findSurfacePoint(p_S).uv; }
    double getNormalSign() const { return m_normalSign; }
    int chooseChart(const Vector3& p_S, const Vector3& /*t_S*/, int /*current*/) const {
        return getBase().findSurfacePoint(p_S).chart;
    }

private:
    double m_normalSign;
};

}  // namespace

std::shared_ptr<const Surface> makeScaledSurface(const std::shared_ptr<const Surface>& base, const LinearMap& map) {
    require(base != nullptr, "scaled surface: needs a base surface");
    const SurfacePoint point = base->findSurfacePoint(Vector3::Constant(base->getSize()));
    ImplicitValue implicitValue;
    if (base->calcImplicitForm(point.p, implicitValue))
        return std::make_shared<ScaledImplicitSurface<SharedImplicitSurface>>(SharedImplicitSurface(base), map);
    ParametricValue parametricValue;
    require(base->calcParametricForm(point, parametricValue), "scaled surface: ", base->getDescription(),
            " has neither an implicit nor a parametric form");
    return std::make_shared<ScaledParametricSurface<SharedParametricSurface>>(SharedParametricSurface(base), map);
}

}  // namespace tautline
