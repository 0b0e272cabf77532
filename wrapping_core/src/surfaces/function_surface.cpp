// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/function_surface.h"

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<ImplicitFunctionSurface>;
template class ParametricShape<ParametricFunctionSurface>;

namespace {

constexpr double kFirstStep = 0.01, kSecondStep = 0.03;  ///< over the size: see the header

/** First derivative of a function of one number at 0: central, sixth order. */
template <class Function>
auto differentiate(const Function& function, double h) {
    using Value = decltype(function(0.0));
    return Value((45 * (function(h) - function(-h)) - 9 * (function(2 * h) - function(-2 * h)) +
                  (function(3 * h) - function(-3 * h))) /
                 (60 * h));
}

/** Second derivative at 0, whose function value is `middle`. */
template <class Function, class Value>
Value differentiateTwice(const Function& function, const Value& middle, double h) {
    return Value((270 * (function(h) + function(-h)) - 27 * (function(2 * h) + function(-2 * h)) +
                  2 * (function(3 * h) + function(-3 * h)) - 490 * middle) /
                 (180 * h * h));
}

}  // namespace

ImplicitFunctionSurface::ImplicitFunctionSurface(std::string description, double size, ValueFunction value,
                                                 GradientFunction gradient, HessianFunction hessian)
    : m_description(std::move(description)),
      m_size(size),
      m_value(std::move(value)),
      m_gradient(std::move(gradient)),
      m_hessian(std::move(hessian)) {
    requireLength(size, "implicit function surface: size");
    require(m_value != nullptr, "implicit function surface: needs a function");
}

ImplicitFunctionSurface::ImplicitFunctionSurface(std::string description, double size, FullFunction full)
    : m_description(std::move(description)), m_size(size), m_full(std::move(full)) {
    requireLength(size, "implicit function surface: size");
    require(m_full != nullptr, "implicit function surface: needs a function");
}

Vector3 ImplicitFunctionSurface::calcGradient(const Vector3& p) const {
    if (m_gradient) return m_gradient(p);
    Vector3 gradient;
    for (int i = 0; i < 3; ++i)
        gradient[i] = differentiate([&](double h) { return m_value(p + h * Vector3::Unit(i)); }, kFirstStep * m_size);
    return gradient;
}

/** From the gradient if there is one; else second differences along axes and diagonals:
4 f_xy = f'' along (1, 1) - f'' along (1, -1). */
Matrix3 ImplicitFunctionSurface::calcHessian(const Vector3& p, double f) const {
    if (m_hessian) return m_hessian(p);
    Matrix3 hessian;
    if (m_gradient) {
        for (int i = 0; i < 3; ++i)
            hessian.col(i) =
                differentiate([&](double h) { return m_gradient(p + h * Vector3::Unit(i)); }, kFirstStep * m_size);
        return 0.5 * (hessian + hessian.transpose());
    }
    const auto along = [&](const Vector3& direction) {
        return differentiateTwice([&](double h) { return m_value(p + h * direction); }, f, kSecondStep * m_size);
    };
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        hessian(i, i) = along(Vector3::Unit(i));
        hessian(i, j) = hessian(j, i) =
            0.25 * (along(Vector3::Unit(i) + Vector3::Unit(j)) - along(Vector3::Unit(i) - Vector3::Unit(j)));
    }
    return hessian;
}

ImplicitValue ImplicitFunctionSurface::calcImplicit(const Vector3& p) const {
    if (m_full) return m_full(p);
    const double f = m_value(p);
    return {f, calcGradient(p), calcHessian(p, f)};
}

double ImplicitFunctionSurface::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    if (m_full) return ImplicitShape::calcHeightAndNormal(p_S, N_S);
    const Vector3 gradient = calcGradient(p_S);
    const double slope = gradient.norm();
    N_S = slope > 0 ? Vector3(gradient / slope) : Vector3(Vector3::UnitX());
    return slope > 0 ? m_value(p_S) / slope : -m_size;
}

ParametricFunctionSurface::ParametricFunctionSurface(std::string description, double size,
                                                     const ParameterDomain& domain, FullFunction full,
                                                     double normalSign)
    : m_description(std::move(description)),
      m_size(size),
      m_normalSign(normalSign),
      m_domain(domain),
      m_full(std::move(full)) {
    requireLength(size, "parametric function surface: size");
    require(m_full != nullptr, "parametric function surface: needs a function");
    requireNormalSign(normalSign, "parametric function surface");
    requireDomain(domain, "parametric function surface");
    m_grid.build(domain, [this](const Vector2& uv) { return m_full(uv).x; });
}

ParametricFunctionSurface ParametricFunctionSurface::fromPosition(std::string description, double size,
                                                                  const ParameterDomain& domain,
                                                                  PositionFunction position, double normalSign) {
    require(position != nullptr, "parametric function surface: needs a function");
    const Vector2 extent = domain.max - domain.min, first = 0.5 * kFirstStep * extent, second = kFirstStep * extent;
    const auto full = [position, first, second](const Vector2& uv) {
        const auto line = [&](const Vector2& step) {
            return [&position, uv, step](double s) { return position(uv + s * step); };
        };
        const Vector2 u(1, 0), v(0, 1);
        ParametricValue value;
        value.x = position(uv);
        value.xu = differentiate(line(u), first[0]);
        value.xv = differentiate(line(v), first[1]);
        value.xuu = differentiateTwice(line(u), value.x, second[0]);
        value.xvv = differentiateTwice(line(v), value.x, second[1]);
        const Vector2 plus(second[0], second[1]), minus(second[0], -second[1]);
        value.xuv = (differentiateTwice(line(plus), value.x, 1) - differentiateTwice(line(minus), value.x, 1)) /
                    (4 * second[0] * second[1]);
        return value;
    };
    return ParametricFunctionSurface(std::move(description), size, domain, full, normalSign);
}

}  // namespace tautline
