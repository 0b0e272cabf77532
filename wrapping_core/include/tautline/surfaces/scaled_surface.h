// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Surfaces under a linear map: p = M q with q on the base surface, as models are scaled to subjects. A model that is
scaled by the factors s along the axes of a body scales a surface whose frame S lies in the body by the rotation R_BS by

    M = R_BS^T diag(s) R_BS,

so that S keeps its orientation. Convex bases stay convex; holes and domains go along. */
#include <memory>
#include <utility>

#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/linear_map.h"
#include "tautline/surfaces/parametric_surface.h"
#include "tautline/surfaces/surface_decorator.h"

namespace tautline {

/** What scaled surfaces of both forms share; `Form` is the ImplicitShape or ParametricShape that they derive from. */
template <class Form, class Base>
class ScaledForm : public SurfaceDecorator<Form, Base> {
public:
    const Matrix3& getMatrix() const { return m_map.getMatrix(); }
    double getSize() const override { return this->getBase().getSize() * m_map.getLeastFactor(); }
    std::string getDescription() const override {
        return this->getBase().getDescription() + " scaled by " + m_map.getDescription();
    }
    std::optional<Hole> getHole() const override {
        const std::optional<Hole> hole = this->getBase().getHole();
        return hole ? std::make_optional(hole->mappedBy(m_map.getInverse())) : std::nullopt;
    }
    double calcDomainMargin(const SurfacePoint& point) const override {
        return this->getBase().calcDomainMargin({m_map.mapBack(point.p), point.uv, point.chart});
    }
    /** A height of the base is a function whose gradient there is unit: first order, and exact in sign. */
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        const double height = this->getBase().calcHeightAndNormal(m_map.mapBack(p_S), N_S);
        N_S = m_map.mapGradient(N_S);
        const double slope = N_S.norm();
        N_S /= slope;
        return height / slope;
    }

protected:
    ScaledForm(Base base, const LinearMap& map) : SurfaceDecorator<Form, Base>(std::move(base)), m_map(map) {}

    LinearMap m_map;
};

/** An implicit surface under a linear map: f(M^-1 p) = 0. `Base` is an ImplicitShape (Sphere, Torus, ...), by value. */
template <class Base>
class ScaledImplicitSurface final : public ScaledForm<ImplicitShape<ScaledImplicitSurface<Base>>, Base> {
public:
    /** @param map   M or three factors along x, y, z of S; InvalidInput as LinearMap says */
    ScaledImplicitSurface(Base base, const LinearMap& map)
        : ScaledForm<ImplicitShape<ScaledImplicitSurface>, Base>(std::move(base), map) {}

    /** By the chain rule; f stays a length by the least factor. */
    ImplicitValue calcImplicit(const Vector3& p) const {
        const ImplicitValue base = this->getBase().calcImplicit(this->m_map.mapBack(p));
        const double least = this->m_map.getLeastFactor();
        return {least * base.f, least * this->m_map.mapGradient(base.gradient),
                least * this->m_map.mapHessian(base.hessian)};
    }
};

/** A parametric surface under a linear map: M x(u, v). `Base` is a ParametricShape, by value. */
template <class Base>
class ScaledParametricSurface final : public ScaledForm<ParametricShape<ScaledParametricSurface<Base>>, Base> {
public:
    /** @param map   M or three factors along x, y, z of S; InvalidInput as LinearMap says */
    ScaledParametricSurface(Base base, const LinearMap& map)
        : ScaledForm<ParametricShape<ScaledParametricSurface>, Base>(std::move(base), map) {}

    ParametricValue calcParametric(const Vector2& uv, int chart) const {
        const ParametricValue s = this->getBase().calcParametric(uv, chart);
        const LinearMap& map = this->m_map;
        return {map.map(s.x), map.map(s.xu), map.map(s.xv), map.map(s.xuu), map.map(s.xuv), map.map(s.xvv)};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int chart) const {
        return this->getBase().calcNearbyParameters(this->m_map.mapBack(p_S), chart);
    }
    double getNormalSign() const { return this->getBase().getNormalSign(); }
    int chooseChart(const Vector3& p_S, const Vector3& t_S, int current) const {
        return this->getBase().chooseChart(this->m_map.mapBack(p_S), this->m_map.mapBack(t_S), current);
    }
};

/** Any surface under a linear map, a user's own included, in the form that it has (the implicit one if both).
@throws InvalidInput if base is null or has neither form, and as LinearMap */
std::shared_ptr<const Surface> makeScaledSurface(const std::shared_ptr<const Surface>& base, const LinearMap& map);

}  // namespace tautline
