// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/multivariate_function.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tautline::models {
namespace {

/** How often each argument is differentiated by. */
std::vector<int> countOrders(const std::vector<int>& arguments, std::size_t numArguments) {
    std::vector<int> orders(numArguments, 0);
    for (int argument : arguments) ++orders[static_cast<std::size_t>(argument)];
    return orders;
}

/** The derivative of x^exponent. */
double calcPower(int exponent, int order, double x) {
    double factor = 1.0;
    for (int i = 0; i < order; ++i) factor *= exponent - i;
    if (factor == 0.0) return 0.0;
    for (int i = order; i < exponent; ++i) factor *= x;
    return factor;
}

/** The exponents after `exponents`, the last counting fastest; false if there are none. */
bool advance(std::vector<int>& exponents, int order) {
    int sum = 0;
    for (int exponent : exponents) sum += exponent;
    for (std::size_t i = exponents.size(); i-- > 0;) {
        if (sum < order) {
            ++exponents[i];
            return true;
        }
        sum -= exponents[i];
        exponents[i] = 0;
    }
    return false;
}

/** Most arguments of a polynomial that is evaluated nested; OpenSim's have four at most. */
constexpr int kMostNested = 6;

/** Where the evaluation of a nested polynomial is. */
struct Reading {
    const int* count;
    const double* coefficient;
};

/** Horner's rule for a polynomial of `size` arguments and its derivatives by them. */
template <int size>
struct Horner {
    static double calc(Reading& at, const double* x, double* gradient) {
        double value = 0;
        for (int i = 0; i < size; ++i) gradient[i] = 0;
        for (int n = *at.count++; n > 0; --n) {
            double inner[size - 1];
            const double next = Horner<size - 1>::calc(at, x + 1, inner);
            gradient[0] = gradient[0] * x[0] + value;
            value = value * x[0] + next;
            for (int i = 1; i < size; ++i) gradient[i] = gradient[i] * x[0] + inner[i - 1];
        }
        return value;
    }
};
template <>
struct Horner<1> {
    static double calc(Reading& at, const double* x, double* gradient) {
        double value = 0, slope = 0;
        for (int n = *at.count++; n > 0; --n) {
            slope = slope * *x + value;
            value = value * *x + *at.coefficient++;
        }
        *gradient = slope;
        return value;
    }
};

using Evaluation = double (*)(Reading&, const double*, double*);
constexpr Evaluation kEvaluations[kMostNested] = {Horner<1>::calc, Horner<2>::calc, Horner<3>::calc,
                                                  Horner<4>::calc, Horner<5>::calc, Horner<6>::calc};

}  // namespace

MultivariateFunction::MultivariateFunction() : m_form(Linear{{}, 0.0}) {}

MultivariateFunction::MultivariateFunction(ScalarFunction function) : m_form(Product{{std::move(function)}}) {}

MultivariateFunction MultivariateFunction::linear(std::vector<double> slopes, double intercept) {
    MultivariateFunction function;
    function.m_form = Linear{std::move(slopes), intercept};
    return function;
}

MultivariateFunction MultivariateFunction::polynomial(int numArguments, int order,
                                                      const std::vector<double>& coefficients) {
    if (numArguments < 1 || order < 0) throw std::invalid_argument("a polynomial needs arguments and an order");
    Polynomial polynomial{numArguments, {}, {}, {}};
    std::vector<int> exponents(static_cast<std::size_t>(numArguments), 0);
    bool hasMore = true;
    for (double coefficient : coefficients) {
        if (!hasMore) throw std::invalid_argument("more coefficients than the order has exponents");
        if (coefficient != 0.0) polynomial.monomials.push_back({exponents, coefficient});
        hasMore = advance(exponents, order);
    }
    if (hasMore) throw std::invalid_argument("fewer coefficients than the order has exponents");
    nest(0, 0, polynomial.monomials.size(), polynomial);
    MultivariateFunction function;
    function.m_form = std::move(polynomial);
    return function;
}

MultivariateFunction MultivariateFunction::product(std::vector<ScalarFunction> factors) {
    MultivariateFunction function;
    function.m_form = Product{std::move(factors)};
    return function;
}

MultivariateFunction MultivariateFunction::scaledBy(double factor) const {
    MultivariateFunction scaled = *this;
    scaled.m_factor *= factor;
    return scaled;
}

ScalarFunction MultivariateFunction::asScalar() const {
    return std::get<Product>(m_form).factors.at(0).scaledBy(m_factor);
}

int MultivariateFunction::getNumArguments() const {
    if (const auto* linear = std::get_if<Linear>(&m_form)) return static_cast<int>(linear->slopes.size());
    if (const auto* product = std::get_if<Product>(&m_form)) return static_cast<int>(product->factors.size());
    return std::get<Polynomial>(m_form).numArguments;
}

double MultivariateFunction::calcDerivative(const std::vector<int>& arguments, const double* x) const {
    return m_factor * std::visit([&](const auto& form) { return calc(form, arguments, x); }, m_form);
}

double MultivariateFunction::calcValueAndGradient(const double* x, double* gradient) const {
    const double value = std::visit([&](const auto& form) { return calcAll(form, x, gradient); }, m_form);
    for (int i = 0; i < getNumArguments(); ++i) gradient[i] *= m_factor;
    return m_factor * value;
}

bool MultivariateFunction::dependsOn(int argument) const {
    const auto i = static_cast<std::size_t>(argument);
    if (m_factor == 0.0) return false;
    if (const auto* linear = std::get_if<Linear>(&m_form)) return linear->slopes[i] != 0.0;
    if (const auto* product = std::get_if<Product>(&m_form)) return !product->factors[i].isConstant();
    const auto& monomials = std::get<Polynomial>(m_form).monomials;
    return std::any_of(monomials.begin(), monomials.end(),
                       [i](const Monomial& monomial) { return monomial.exponents[i] > 0; });
}

double MultivariateFunction::calc(const Linear& linear, const std::vector<int>& arguments, const double* x) {
    if (arguments.size() == 1) return linear.slopes[static_cast<std::size_t>(arguments[0])];
    if (!arguments.empty()) return 0.0;
    double value = linear.intercept;
    for (std::size_t i = 0; i < linear.slopes.size(); ++i) value += linear.slopes[i] * x[i];
    return value;
}

double MultivariateFunction::calc(const Polynomial& polynomial, const std::vector<int>& arguments, const double* x) {
    const auto numArguments = static_cast<std::size_t>(polynomial.numArguments);
    const std::vector<int> orders = countOrders(arguments, numArguments);
    double value = 0.0;
    for (const Monomial& monomial : polynomial.monomials) {
        double term = monomial.coefficient;
        for (std::size_t i = 0; i < numArguments; ++i) term *= calcPower(monomial.exponents[i], orders[i], x[i]);
        value += term;
    }
    return value;
}

double MultivariateFunction::calc(const Product& product, const std::vector<int>& arguments, const double* x) {
    const std::vector<int> orders = countOrders(arguments, product.factors.size());
    double value = 1.0;
    for (std::size_t i = 0; i < orders.size(); ++i) value *= product.factors[i].calcDerivativeOfOrder(orders[i], x[i]);
    return value;
}

/** Appends the polynomial of this argument and those after it that has the monomials from `begin` to `end`, which agree
in the exponents of the arguments before it. */
void MultivariateFunction::nest(std::size_t argument, std::size_t begin, std::size_t end, Polynomial& polynomial) {
    const std::vector<Monomial>& monomials = polynomial.monomials;  // by ascending exponents
    const int highest = begin == end ? -1 : monomials[end - 1].exponents[argument];
    polynomial.counts.push_back(highest + 1);
    const bool isInnermost = argument + 1 == static_cast<std::size_t>(polynomial.numArguments);
    for (int power = highest; power >= 0; --power) {
        std::size_t first = end;
        while (first > begin && monomials[first - 1].exponents[argument] == power) --first;
        if (isInnermost)
            polynomial.coefficients.push_back(first == end ? 0.0 : monomials[first].coefficient);
        else
            nest(argument + 1, first, end, polynomial);
        end = first;
    }
}

double MultivariateFunction::calcAll(const Linear& linear, const double* x, double* gradient) {
    std::copy(linear.slopes.begin(), linear.slopes.end(), gradient);
    return calc(linear, {}, x);
}

double MultivariateFunction::calcAll(const Polynomial& polynomial, const double* x, double* gradient) {
    if (polynomial.numArguments <= kMostNested) {
        Reading begin{polynomial.counts.data(), polynomial.coefficients.data()};
        return kEvaluations[polynomial.numArguments - 1](begin, x, gradient);
    }
    for (int i = 0; i < polynomial.numArguments; ++i) gradient[i] = calc(polynomial, {i}, x);
    return calc(polynomial, {}, x);
}

double MultivariateFunction::calcAll(const Product& product, const double* x, double* gradient) {
    const std::vector<ScalarFunction>& factors = product.factors;
    double value = 1.0;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const double factor = factors[i].calcValue(x[i]);
        gradient[i] = value * factors[i].calcDerivativeOfOrder(1, x[i]);
        for (std::size_t j = 0; j < i; ++j) gradient[j] *= factor;
        value *= factor;
    }
    return value;
}

}  // namespace tautline::models
