// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <variant>
#include <vector>

namespace tautline::models {

/** A function of one variable with two derivatives, as a value.

Outside its knots a spline and a piecewise linear function go on straight with their end slopes. Where a derivative
jumps (the knots of a piecewise linear function) the value to the right is given; a spline counts its end knots as
inside.

The makers throw std::invalid_argument if the data make no function: no coefficients, lists of different lengths, fewer
than two knots, abscissae that decrease, numbers that are not finite. */
class ScalarFunction {
public:
    /** The zero function. */
    ScalarFunction();

    static ScalarFunction constant(double value);
    static ScalarFunction linear(double slope, double intercept);
    /** Coefficients with the highest power first. */
    static ScalarFunction polynomial(std::vector<double> coefficients);
    static ScalarFunction piecewiseLinear(std::vector<double> x, std::vector<double> y);
    /** The cubic spline whose third derivative on the first interval is that of the cubic through the first four knots,
    likewise at the end; a parabola for three knots, a line for two. */
    static ScalarFunction simmSpline(std::vector<double> x, std::vector<double> y);
    /** amplitude sin(omega x + phase) + offset */
    static ScalarFunction sine(double amplitude, double omega, double phase, double offset);

    /** This function times a factor. */
    ScalarFunction scaledBy(double factor) const;

    double calcValue(double x) const { return calcDerivativeOfOrder(0, x); }
    double calcDerivative(double x) const { return calcDerivativeOfOrder(1, x); }
    double calcSecondDerivative(double x) const { return calcDerivativeOfOrder(2, x); }
    /** @param order 0 (the value), 1 or 2. */
    double calcDerivativeOfOrder(int order, double x) const;

    /** Whether the function is constant by construction. */
    bool isConstant() const;

private:
    struct Polynomial {
        std::vector<double> coefficients;
    };
    /** On [x_i, x_{i+1}], with d = x - x_i: y_i + d (b_i + d (c_i + d e_i)). */
    struct Cubics {
        std::vector<double> x, y, b, c, e;
        double endSlope;
    };

    struct Wave {
        double amplitude, omega, phase, offset;
    };

    static double calcPolynomial(const Polynomial& polynomial, int order, double x);
    static double calcCubics(const Cubics& cubics, int order, double x);
    static double calcWave(const Wave& wave, int order, double x);

    std::variant<Polynomial, Cubics, Wave> m_form;
    double m_factor = 1.0;
};

}  // namespace tautline::models
