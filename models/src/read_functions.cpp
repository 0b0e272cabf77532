// SPDX-License-Identifier: Apache-2.0
#include "read_functions.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace tautline::models {
namespace {

/** Functions inside functions; deeper nesting is not a model but an attack on the stack. */
constexpr int kDeepestNesting = 16;

MultivariateFunction readAtDepth(Element element, std::size_t numArguments, int depth);

/** The only function in a wrapper, or an element that is false. */
Element findWrapped(const Element& wrapper) {
    const std::vector<Element> children = wrapper.getChildren();
    if (children.size() > 1) children[1].fail("a second function in " + wrapper.describe());
    return children.empty() ? Element(wrapper.updReading(), pugi::xml_node()) : children[0];
}

Element requireWrapped(const Element& wrapper, const std::string& owner) {
    const Element wrapped = findWrapped(wrapper);
    if (!wrapped) wrapper.fail("no function in " + owner);
    return wrapped;
}

using FunctionReader = MultivariateFunction (*)(Element&, std::size_t numArguments, int depth);

MultivariateFunction readConstant(Element& element, std::size_t numArguments, int) {
    const double value = element.getNumberOr("value", 0.0);
    if (numArguments == 1) return ScalarFunction::constant(value);
    return MultivariateFunction::linear(std::vector<double>(numArguments, 0.0), value);
}

/** A slope for each argument, then the intercept. */
MultivariateFunction readLinear(Element& element, std::size_t numArguments, int) {
    std::vector<double> coefficients = element.require("coefficients").getNumbers(numArguments + 1);
    const double intercept = coefficients.back();
    if (numArguments == 1) return ScalarFunction::linear(coefficients[0], intercept);
    coefficients.pop_back();
    return MultivariateFunction::linear(std::move(coefficients), intercept);
}

MultivariateFunction readMultiplier(Element& element, std::size_t numArguments, int depth) {
    const Element wrapped = requireWrapped(element.require("function"), element.describe());
    return readAtDepth(wrapped, numArguments, depth + 1).scaledBy(element.getNumberOr("scale", 1.0));
}

MultivariateFunction readMultivariatePolynomial(Element& element, std::size_t numArguments, int) {
    const Element dimension = element.require("dimension");
    if (dimension.getNumber() != static_cast<double>(numArguments)) {
        dimension.fail("the dimension of " + element.describe() + " is " + dimension.getText() + ", but it has " +
                       std::to_string(numArguments) + " arguments");
    }
    const Element order = element.require("order");
    constexpr double kHighestOrder = 20;
    const double value = order.getNumber();
    if (value < 0 || value > kHighestOrder || value != static_cast<int>(value))
        order.fail("the order of " + element.describe() + " is " + order.getText() + ", not one of 0 to 20");
    std::vector<double> coefficients = element.require("coefficients").getNumbers();
    const MultivariateFunction polynomial =
        MultivariateFunction::polynomial(static_cast<int>(numArguments), static_cast<int>(value), coefficients);
    if (numArguments > 1) return polynomial;
    // Of one argument, and then the lowest power stands first.
    std::reverse(coefficients.begin(), coefficients.end());
    return ScalarFunction::polynomial(std::move(coefficients));
}

/** A function of the first argument only, as all of one variable are. */
void requireOneArgument(const Element& element, std::size_t numArguments) {
    if (numArguments != 1) element.fail(element.describe() + " has one argument, not " + std::to_string(numArguments));
}

MultivariateFunction readPolynomial(Element& element, std::size_t numArguments, int) {
    requireOneArgument(element, numArguments);
    return ScalarFunction::polynomial(element.require("coefficients").getNumbers());
}

/** Each number is 1, 1, 0, 0 where the file leaves it out. */
MultivariateFunction readSine(Element& element, std::size_t numArguments, int) {
    requireOneArgument(element, numArguments);
    return ScalarFunction::sine(element.getNumberOr("amplitude", 1.0), element.getNumberOr("omega", 1.0),
                                element.getNumberOr("phase", 0.0), element.getNumberOr("offset", 0.0));
}

template <ScalarFunction (*make)(std::vector<double>, std::vector<double>)>
MultivariateFunction readKnots(Element& element, std::size_t numArguments, int) {
    requireOneArgument(element, numArguments);
    std::vector<double> x = element.require("x").getNumbers();
    std::vector<double> y = element.require("y").getNumbers();
    return make(std::move(x), std::move(y));
}

const std::map<std::string, FunctionReader>& getFunctionReaders() {
    static const std::map<std::string, FunctionReader> kReaders{
        {"Constant", readConstant},
        {"LinearFunction", readLinear},
        {"PolynomialFunction", readPolynomial},
        {"MultivariatePolynomialFunction", readMultivariatePolynomial},
        {"MultiplierFunction", readMultiplier},
        {"Sine", readSine},
        {"PiecewiseLinearFunction", readKnots<ScalarFunction::piecewiseLinear>},
        {"SimmSpline", readKnots<ScalarFunction::simmSpline>},
        {"NaturalCubicSpline", readKnots<ScalarFunction::simmSpline>},
        {"natCubicSpline", readKnots<ScalarFunction::simmSpline>}};
    return kReaders;
}

MultivariateFunction readAtDepth(Element element, std::size_t numArguments, int depth) {
    if (depth > kDeepestNesting) element.fail("functions are nested too deeply");
    const auto reader = getFunctionReaders().find(element.getTag());
    if (reader == getFunctionReaders().end()) {
        element.refuseForGood("function", "what it moves cannot be known without it");
        return MultivariateFunction::product(std::vector<ScalarFunction>(numArguments));
    }
    try {
        const MultivariateFunction function = reader->second(element, numArguments, depth);
        element.refuseUnknown();
        return function;
    } catch (const std::invalid_argument& error) {
        element.fail(element.describe() + ": " + error.what());
    }
}

}  // namespace

MultivariateFunction readFunction(Element element, std::size_t numArguments) {
    return readAtDepth(element, numArguments, 0);
}

std::optional<ScalarFunction> readWrappedFunction(const Element& wrapper) {
    const Element wrapped = findWrapped(wrapper);
    if (!wrapped) return std::nullopt;
    return readAtDepth(wrapped, 1, 0).asScalar();
}

ScalarFunction requireWrappedFunction(const Element& wrapper) {
    return readAtDepth(requireWrapped(wrapper, wrapper.describe()), 1, 0).asScalar();
}

MultivariateFunction requireWrappedFunction(const Element& wrapper, std::size_t numArguments) {
    return readAtDepth(requireWrapped(wrapper, wrapper.describe()), numArguments, 0);
}

}  // namespace tautline::models
