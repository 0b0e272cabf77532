// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/scalar_function.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace tautline::models {
namespace {

/** Equal abscissae are kept this far apart, small beside any knot spacing of a joint or a muscle. */
constexpr double kLeastKnotSpacing = 1e-7;

void requireFinite(const std::vector<double>& numbers) {
    for (double number : numbers)
        if (!std::isfinite(number)) throw std::invalid_argument("a number is not finite");
}

void requireKnots(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() != y.size()) {
        throw std::invalid_argument(std::to_string(x.size()) + " abscissae for " + std::to_string(y.size()) +
                                    " ordinates");
    }
    if (x.size() < 2) throw std::invalid_argument("fewer than two knots");
    requireFinite(x);
    requireFinite(y);
    const auto decrease = std::adjacent_find(x.begin(), x.end(), std::greater<double>());
    if (decrease != x.end()) throw std::invalid_argument("the abscissae decrease after " + std::to_string(*decrease));
}

std::vector<double> separateKnots(std::vector<double> x) {
    for (std::size_t i = 1; i < x.size(); ++i) x[i] = std::max(x[i], x[i - 1] + kLeastKnotSpacing);
    return x;
}

std::vector<double> calcSpacings(const std::vector<double>& x) {
    std::vector<double> h(x.size() - 1);
    for (std::size_t i = 0; i < h.size(); ++i) h[i] = x[i + 1] - x[i];
    return h;
}

std::vector<double> calcSlopes(const std::vector<double>& h, const std::vector<double>& y) {
    std::vector<double> m(h.size());
    for (std::size_t i = 0; i < m.size(); ++i) m[i] = (y[i + 1] - y[i]) / h[i];
    return m;
}

/** Third divided difference over the knots first..first+3, from the slopes of their intervals. */
double calcThirdDifference(const std::vector<double>& h, const std::vector<double>& m, std::size_t first) {
    const double h0 = h[first], h1 = h[first + 1], h2 = h[first + 2];
    const double left = (m[first + 1] - m[first]) / (h0 + h1);
    const double right = (m[first + 2] - m[first + 1]) / (h1 + h2);
    return (right - left) / (h0 + h1 + h2);
}

/** The sixth parts g_i of the second derivatives at the knots. Row i of the tridiagonal system is lower[i] g_{i-1} +
diagonal[i] g_i + upper[i] g_{i+1} = g[i]. The end rows are scaled by the end spacings: then eliminating downwards needs
no pivoting. */
std::vector<double> solveForCurvatures(const std::vector<double>& h, const std::vector<double>& m) {
    const std::size_t n = h.size() + 1;
    std::vector<double> lower(n), diagonal(n), upper(n), g(n);
    diagonal[0] = h[0];
    upper[0] = -h[0];
    lower[n - 1] = -h[n - 2];
    diagonal[n - 1] = h[n - 2];
    if (n > 3) {
        g[0] = -h[0] * h[0] * calcThirdDifference(h, m, 0);
        g[n - 1] = h[n - 2] * h[n - 2] * calcThirdDifference(h, m, n - 4);
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        lower[i] = h[i - 1];
        diagonal[i] = 2 * (h[i - 1] + h[i]);
        upper[i] = h[i];
        g[i] = m[i] - m[i - 1];
    }
    for (std::size_t i = 1; i < n; ++i) {
        const double ratio = lower[i] / diagonal[i - 1];
        diagonal[i] -= ratio * upper[i - 1];
        g[i] -= ratio * g[i - 1];
    }
    g[n - 1] /= diagonal[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) g[i] = (g[i] - upper[i] * g[i + 1]) / diagonal[i];
    return g;
}

}  // namespace

ScalarFunction::ScalarFunction() : m_form(Polynomial{{0.0}}) {}

ScalarFunction ScalarFunction::constant(double value) {
    return polynomial({value});
}

ScalarFunction ScalarFunction::linear(double slope, double intercept) {
    return polynomial({slope, intercept});
}

ScalarFunction ScalarFunction::polynomial(std::vector<double> coefficients) {
    if (coefficients.empty()) throw std::invalid_argument("no coefficients");
    requireFinite(coefficients);
    ScalarFunction function;
    function.m_form = Polynomial{std::move(coefficients)};
    return function;
}

ScalarFunction ScalarFunction::piecewiseLinear(std::vector<double> x, std::vector<double> y) {
    requireKnots(x, y);
    Cubics lines{};
    lines.x = separateKnots(std::move(x));
    lines.y = std::move(y);
    lines.b = calcSlopes(calcSpacings(lines.x), lines.y);
    lines.c.assign(lines.b.size(), 0.0);
    lines.e.assign(lines.b.size(), 0.0);
    lines.endSlope = lines.b.back();
    ScalarFunction function;
    function.m_form = std::move(lines);
    return function;
}

ScalarFunction ScalarFunction::simmSpline(std::vector<double> x, std::vector<double> y) {
    requireKnots(x, y);
    if (x.size() == 2) return piecewiseLinear(std::move(x), std::move(y));
    Cubics spline{};
    spline.x = separateKnots(std::move(x));
    spline.y = std::move(y);
    const std::vector<double> h = calcSpacings(spline.x);
    const std::vector<double> m = calcSlopes(h, spline.y);
    const std::vector<double> g = solveForCurvatures(h, m);
    for (std::size_t i = 0; i < h.size(); ++i) {
        spline.b.push_back(m[i] - h[i] * (g[i + 1] + 2 * g[i]));
        spline.c.push_back(3 * g[i]);
        spline.e.push_back((g[i + 1] - g[i]) / h[i]);
    }
    spline.endSlope = m.back() + h.back() * (g[g.size() - 2] + 2 * g.back());
    ScalarFunction function;
    function.m_form = std::move(spline);
    return function;
}

ScalarFunction ScalarFunction::sine(double amplitude, double omega, double phase, double offset) {
    requireFinite({amplitude, omega, phase, offset});
    ScalarFunction function;
    function.m_form = Wave{amplitude, omega, phase, offset};
    return function;
}

ScalarFunction ScalarFunction::scaledBy(double factor) const {
    if (!std::isfinite(factor)) throw std::invalid_argument("a number is not finite");
    ScalarFunction scaled = *this;
    scaled.m_factor *= factor;
    return scaled;
}

double ScalarFunction::calcDerivativeOfOrder(int order, double x) const {
    if (const auto* polynomial = std::get_if<Polynomial>(&m_form))
        return m_factor * calcPolynomial(*polynomial, order, x);
    if (const auto* wave = std::get_if<Wave>(&m_form)) return m_factor * calcWave(*wave, order, x);
    return m_factor * calcCubics(std::get<Cubics>(m_form), order, x);
}

bool ScalarFunction::isConstant() const {
    const auto* polynomial = std::get_if<Polynomial>(&m_form);
    if (m_factor == 0.0) return true;
    if (const auto* wave = std::get_if<Wave>(&m_form)) return wave->amplitude == 0.0 || wave->omega == 0.0;
    if (!polynomial) return false;
    const auto& coefficients = polynomial->coefficients;
    return std::all_of(coefficients.begin(), coefficients.end() - 1,
                       [](double coefficient) { return coefficient == 0.0; });
}

double ScalarFunction::calcPolynomial(const Polynomial& polynomial, int order, double x) {
    // Horner's rule for the value and the derivatives side by side; `half` is f''/2.
    double value = 0.0, slope = 0.0, half = 0.0;
    for (double coefficient : polynomial.coefficients) {
        half = half * x + slope;
        slope = slope * x + value;
        value = value * x + coefficient;
    }
    return order == 0 ? value : order == 1 ? slope : 2 * half;
}

double ScalarFunction::calcWave(const Wave& wave, int order, double x) {
    const double angle = wave.omega * x + wave.phase, slope = wave.amplitude * wave.omega;
    if (order == 0) return wave.amplitude * std::sin(angle) + wave.offset;
    return order == 1 ? slope * std::cos(angle) : -slope * wave.omega * std::sin(angle);
}

double ScalarFunction::calcCubics(const Cubics& cubics, int order, double x) {
    const bool before = x < cubics.x.front();
    if (before || x > cubics.x.back()) {
        const double slope = before ? cubics.b.front() : cubics.endSlope;
        const double x0 = before ? cubics.x.front() : cubics.x.back();
        const double y0 = before ? cubics.y.front() : cubics.y.back();
        return order == 0 ? y0 + slope * (x - x0) : order == 1 ? slope : 0.0;
    }
    const auto right = std::upper_bound(cubics.x.begin() + 1, cubics.x.end() - 1, x);
    const auto i = static_cast<std::size_t>(right - cubics.x.begin()) - 1;
    const double d = x - cubics.x[i], b = cubics.b[i], c = cubics.c[i], e = cubics.e[i];
    if (order == 0) return cubics.y[i] + d * (b + d * (c + d * e));
    return order == 1 ? b + d * (2 * c + d * 3 * e) : 2 * c + d * 6 * e;
}

}  // namespace tautline::models
