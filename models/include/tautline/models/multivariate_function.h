// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <variant>
#include <vector>

#include "tautline/models/scalar_function.h"

namespace tautline::models {

/** A function of several variables with its partial derivatives, as a value. `x` always points to as many numbers as
the function has arguments. */
class MultivariateFunction {
public:
    /** The zero function of no argument. */
    MultivariateFunction();
    /** f(x[0]) */
    MultivariateFunction(ScalarFunction function);

    /** slopes . x + intercept */
    static MultivariateFunction linear(std::vector<double> slopes, double intercept);
    /** The sum over all exponents e with e[0] + e[1] + ... <= order of c_e x[0]^e[0] x[1]^e[1] ...; the exponents in
    lexicographic order, the last counting fastest.
    @throws std::invalid_argument if the number of coefficients is another than that of the exponents */
    static MultivariateFunction polynomial(int numArguments, int order, const std::vector<double>& coefficients);
    /** The product of f_i(x[i]). */
    static MultivariateFunction product(std::vector<ScalarFunction> factors);

    MultivariateFunction scaledBy(double factor) const;
    /** Of a function that was made from one of one argument. */
    ScalarFunction asScalar() const;

    int getNumArguments() const;
    double calcValue(const double* x) const { return calcDerivative({}, x); }
    /** Of a function of one argument at x, of one of none anywhere. */
    double calcValue(double x) const { return calcValue(&x); }
    /** @param arguments   by which to differentiate, one after the other */
    double calcDerivative(const std::vector<int>& arguments, const double* x) const;
    /** The value and all first derivatives in one go, which is many times as fast as one by one.
    @param gradient   room for getNumArguments() numbers */
    double calcValueAndGradient(const double* x, double* gradient) const;
    /** False if the function is constant in this argument by construction. */
    bool dependsOn(int argument) const;

private:
    struct Linear {
        std::vector<double> slopes;
        double intercept;
    };
    struct Monomial {
        std::vector<int> exponents;
        double coefficient;
    };
    struct Polynomial {
        int numArguments;
        std::vector<Monomial> monomials;
        /** The same nested: a polynomial of the first argument whose coefficients are polynomials of the next one, and
        so on. For each of them, depth first, how many coefficients it has, which come from the highest power down. */
        std::vector<int> counts;
        std::vector<double> coefficients;  ///< of the innermost polynomials
    };
    struct Product {
        std::vector<ScalarFunction> factors;
    };

    static void nest(std::size_t argument, std::size_t begin, std::size_t end, Polynomial& polynomial);
    static double calc(const Linear& linear, const std::vector<int>& arguments, const double* x);
    static double calc(const Polynomial& polynomial, const std::vector<int>& arguments, const double* x);
    static double calc(const Product& product, const std::vector<int>& arguments, const double* x);
    static double calcAll(const Linear& linear, const double* x, double* gradient);
    static double calcAll(const Polynomial& polynomial, const double* x, double* gradient);
    static double calcAll(const Product& product, const double* x, double* gradient);

    std::variant<Linear, Polynomial, Product> m_form;
    double m_factor = 1.0;
};

}  // namespace tautline::models
