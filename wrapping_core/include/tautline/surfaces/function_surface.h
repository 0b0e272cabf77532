// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Surfaces from functions that the user hands over, without writing a class. */
#include <array>
#include <functional>

#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_surface.h"
#include "tautline/surfaces/second_order.h"

namespace tautline {

/** f(p) = 0 from functions; f > 0 outside. Derivatives that are not given come from central differences of sixth order,
with steps of 1% of the size for first and 3% for second derivatives: good to some 1e-12 for functions that are
smooth on the scale of the size, at 19 evaluations for a gradient, 55 for gradient and Hessian. `makeImplicitSurface`
derives exact ones from one formula. */
class ImplicitFunctionSurface final : public ImplicitShape<ImplicitFunctionSurface> {
public:
    using ValueFunction = std::function<double(const Vector3& p_S)>;
    using GradientFunction = std::function<Vector3(const Vector3& p_S)>;
    using HessianFunction = std::function<Matrix3(const Vector3& p_S)>;
    using FullFunction = std::function<ImplicitValue(const Vector3& p_S)>;

    /** @param description   for messages
    @param size          characteristic length [m], positive; InvalidInput otherwise, or if `value` is empty
    @param gradient, hessian   may be empty */
    ImplicitFunctionSurface(std::string description, double size, ValueFunction value, GradientFunction gradient = {},
                            HessianFunction hessian = {});
    /** All in one call. */
    ImplicitFunctionSurface(std::string description, double size, FullFunction full);

    double getSize() const override { return m_size; }
    std::string getDescription() const override { return m_description; }
    bool isConvex() const override { return m_isConvex; }
    /** Promises that the solid is convex: some checks are then skipped. */
    ImplicitFunctionSurface& setConvex(bool isConvex) {
        m_isConvex = isConvex;
        return *this;
    }
    /** Without the Hessian, if that has to come from differences. */
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override;
    ImplicitValue calcImplicit(const Vector3& p) const;

private:
    Vector3 calcGradient(const Vector3& p) const;
    Matrix3 calcHessian(const Vector3& p, double f) const;

    std::string m_description;
    double m_size;
    bool m_isConvex = false;
    ValueFunction m_value;
    GradientFunction m_gradient;
    HessianFunction m_hessian;
    FullFunction m_full;
};

extern template class ImplicitShape<ImplicitFunctionSurface>;

/** An implicit surface with exact derivatives from one formula, callable with three numbers of any type:

    makeImplicitSurface("egg", 0.1, [](auto x, auto y, auto z) { return x * x + y * y + exp(z) - 2; }) */
template <class Formula>
ImplicitFunctionSurface makeImplicitSurface(std::string description, double size, Formula formula) {
    using Number = SecondOrder<3>;
    return ImplicitFunctionSurface(std::move(description), size,
                                   ImplicitFunctionSurface::FullFunction([formula](const Vector3& p) -> ImplicitValue {
                                       const Number f =
                                           formula(Number::makeVariable(p.x(), 0), Number::makeVariable(p.y(), 1),
                                                   Number::makeVariable(p.z(), 2));
                                       return {f.value, f.gradient, f.hessian};
                                   }));
}

/** x(u, v) over a rectangle from functions. From the position alone, derivatives come from central differences of sixth
order with steps of 0.5% of the domain (first) and 1% (second), so x must be defined a little beyond it. */
class ParametricFunctionSurface final : public ParametricShape<ParametricFunctionSurface> {
public:
    using PositionFunction = std::function<Vector3(const Vector2& uv)>;
    using FullFunction = std::function<ParametricValue(const Vector2& uv)>;

    /** @param size         characteristic length [m], positive; InvalidInput otherwise
    @param domain       finite and not empty
    @param normalSign   +1 if xu x xv points outward, else -1 */
    ParametricFunctionSurface(std::string description, double size, const ParameterDomain& domain, FullFunction full,
                              double normalSign = 1);
    static ParametricFunctionSurface fromPosition(std::string description, double size, const ParameterDomain& domain,
                                                  PositionFunction position, double normalSign = 1);

    double getSize() const override { return m_size; }
    std::string getDescription() const override { return m_description; }
    double getNormalSign() const { return m_normalSign; }
    const ParameterDomain& getDomain() const { return m_domain; }
    double calcDomainMargin(const SurfacePoint& point) const override { return m_domain.calcMargin(resolve(point).uv); }
    ParametricValue calcParametric(const Vector2& uv, int) const { return m_full(uv); }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const { return m_grid.findNearest(p_S); }

private:
    std::string m_description;
    double m_size, m_normalSign;
    ParameterDomain m_domain;
    FullFunction m_full;
    NearbyGrid m_grid;
};

extern template class ParametricShape<ParametricFunctionSurface>;

/** A parametric surface with exact derivatives from one formula, callable with two numbers of any type, that returns
the three coordinates as std::array. */
template <class Formula>
ParametricFunctionSurface makeParametricSurface(std::string description, double size, const ParameterDomain& domain,
                                                Formula formula, double normalSign = 1) {
    using Number = SecondOrder<2>;
    const auto full = [formula](const Vector2& uv) {
        const std::array<Number, 3> x = formula(Number::makeVariable(uv[0], 0), Number::makeVariable(uv[1], 1));
        ParametricValue s;
        for (int i = 0; i < 3; ++i) {
            s.x[i] = x[i].value;
            s.xu[i] = x[i].gradient[0], s.xv[i] = x[i].gradient[1];
            s.xuu[i] = x[i].hessian(0, 0), s.xuv[i] = x[i].hessian(0, 1), s.xvv[i] = x[i].hessian(1, 1);
        }
        return s;
    };
    return ParametricFunctionSurface(std::move(description), size, domain, full, normalSign);
}

}  // namespace tautline
