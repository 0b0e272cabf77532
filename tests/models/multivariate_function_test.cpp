// SPDX-License-Identifier: Apache-2.0
/** Values and gradients in one go against sums over monomials, and against difference quotients. */
#include "tautline/models/multivariate_function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeded_random.h"

namespace tautline::models {
namespace {

using tautline::testing::SeededRandom;

int countExponents(int numArguments, int order) {
    double count = 1;
    for (int i = 1; i <= numArguments; ++i) count = count * (order + i) / i;
    return static_cast<int>(std::lround(count));
}

/** @param share   of the coefficients that are not 0 */
MultivariateFunction makePolynomial(SeededRandom& random, int numArguments, int order, double share) {
    std::vector<double> coefficients;
    for (int i = 0; i < countExponents(numArguments, order); ++i)
        coefficients.push_back(random.uniform(0, 1) < share ? random.uniform(-1, 1) : 0.0);
    return MultivariateFunction::polynomial(numArguments, order, coefficients);
}

/** The derivatives one by one are sums over monomials: another way to the same numbers. */
void expectGradient(const MultivariateFunction& function, const std::vector<double>& x) {
    std::vector<double> gradient(x.size(), -7.0);
    const double value = function.calcValueAndGradient(x.data(), gradient.data());
    EXPECT_NEAR(value, function.calcValue(x.data()), 1e-12 * (1 + std::abs(value)));
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double one = function.calcDerivative({static_cast<int>(i)}, x.data());
        EXPECT_NEAR(gradient[i], one, 1e-12 * (1 + std::abs(one))) << "argument " << i << " of " << x.size();
        constexpr double kStep = 1e-5;
        std::vector<double> above = x, below = x;
        above[i] += kStep;
        below[i] -= kStep;
        const double quotient = (function.calcValue(above.data()) - function.calcValue(below.data())) / (2 * kStep);
        EXPECT_NEAR(gradient[i], quotient, 1e-8 * (1 + std::abs(one))) << "argument " << i << " of " << x.size();
    }
}

TEST(MultivariateFunction, GradientsOfPolynomialsAreTheirDerivatives) {
    SeededRandom random(20261127);
    for (int numArguments = 1; numArguments <= 8; ++numArguments)
        for (int order = 0; order <= (numArguments <= 5 ? 5 : 3); ++order)
            for (const double share : {0.0, 0.1, 0.4, 1.0}) {
                const MultivariateFunction polynomial = makePolynomial(random, numArguments, order, share);
                std::vector<double> x;
                for (int i = 0; i < numArguments; ++i) x.push_back(random.uniform(-1.2, 1.2));
                expectGradient(polynomial, x);
                expectGradient(polynomial.scaledBy(-2.5), x);
                expectGradient(polynomial, std::vector<double>(x.size(), 0.0));
            }
}

/** 2 + 3 y - x y^2, by hand. */
TEST(MultivariateFunction, GradientOfAPolynomialByHand) {
    // Exponents in lexicographic order: 1, y, y^2, y^3, x, x y, x y^2, x^2, x^2 y, x^3.
    const MultivariateFunction f = MultivariateFunction::polynomial(2, 3, {2, 3, 0, 0, 0, 0, -1, 0, 0, 0});
    const double x[] = {5, 7};
    double gradient[2];
    EXPECT_EQ(f.calcValueAndGradient(x, gradient), 2 + 3 * 7 - 5 * 49);
    EXPECT_EQ(gradient[0], -49);
    EXPECT_EQ(gradient[1], 3 - 2 * 5 * 7);
}

TEST(MultivariateFunction, GradientsOfProductsAndLines) {
    const MultivariateFunction product =
        MultivariateFunction::product({ScalarFunction::sine(0.7, 1.3, 0.2, 0.1), ScalarFunction::polynomial({1, -2, 3}),
                                       ScalarFunction::linear(-1.5, 0.4)});
    expectGradient(product, {0.3, -0.8, 0.5});
    expectGradient(product, {0.3, -0.8, 0.4 / 1.5});  // a factor of 0
    expectGradient(MultivariateFunction::linear({1.5, -2.0, 0.25}, 0.7).scaledBy(3), {0.1, 0.2, 0.3});
}

}  // namespace
}  // namespace tautline::models
