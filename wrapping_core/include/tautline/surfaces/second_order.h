// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Numbers that carry their first and second derivatives by n variables through a formula (forward
differentiation): exact but for rounding. */
#include <Eigen/Core>
#include <cmath>

namespace tautline {

template <int n>
struct SecondOrder {
    using Gradient = Eigen::Matrix<double, n, 1>;
    using Hessian = Eigen::Matrix<double, n, n>;

    double value = 0;
    Gradient gradient = Gradient::Zero();
    Hessian hessian = Hessian::Zero();

    SecondOrder() = default;
    SecondOrder(double constant) : value(constant) {}  // implicit: constants mix with variables in formulas
    SecondOrder(double v, const Gradient& g, const Hessian& H) : value(v), gradient(g), hessian(H) {}

    /** The variable number `index` itself. */
    static SecondOrder makeVariable(double value, int index) { return {value, Gradient::Unit(index), Hessian::Zero()}; }

    /** A function of one variable applied to this, with value f and derivatives f1, f2 (chain rule). */
    SecondOrder chain(double f, double f1, double f2) const {
        return {f, f1 * gradient, f1 * hessian + f2 * gradient * gradient.transpose()};
    }

    friend SecondOrder operator+(const SecondOrder& a, const SecondOrder& b) {
        return {a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian};
    }
    friend SecondOrder operator-(const SecondOrder& a, const SecondOrder& b) {
        return {a.value - b.value, a.gradient - b.gradient, a.hessian - b.hessian};
    }
    friend SecondOrder operator-(const SecondOrder& a) { return {-a.value, -a.gradient, -a.hessian}; }
    friend SecondOrder operator*(const SecondOrder& a, const SecondOrder& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient,
                a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                    b.gradient * a.gradient.transpose()};
    }
    friend SecondOrder operator/(const SecondOrder& a, const SecondOrder& b) {
        const double w = 1 / b.value;
        return a * b.chain(w, -w * w, 2 * w * w * w);
    }
    SecondOrder& operator+=(const SecondOrder& b) { return *this = *this + b; }
    SecondOrder& operator-=(const SecondOrder& b) { return *this = *this - b; }
    SecondOrder& operator*=(const SecondOrder& b) { return *this = *this * b; }

    friend SecondOrder sin(const SecondOrder& a) {
        const double s = std::sin(a.value);
        return a.chain(s, std::cos(a.value), -s);
    }
    friend SecondOrder cos(const SecondOrder& a) {
        const double c = std::cos(a.value);
        return a.chain(c, -std::sin(a.value), -c);
    }
    friend SecondOrder exp(const SecondOrder& a) {
        const double e = std::exp(a.value);
        return a.chain(e, e, e);
    }
    friend SecondOrder log(const SecondOrder& a) {
        return a.chain(std::log(a.value), 1 / a.value, -1 / (a.value * a.value));
    }
    friend SecondOrder sqrt(const SecondOrder& a) {
        const double r = std::sqrt(a.value);
        return a.chain(r, 0.5 / r, -0.25 / (r * a.value));
    }
    friend SecondOrder pow(const SecondOrder& a, double exponent) {
        return a.chain(std::pow(a.value, exponent), exponent * std::pow(a.value, exponent - 1),
                       exponent * (exponent - 1) * std::pow(a.value, exponent - 2));
    }
};

}  // namespace tautline
