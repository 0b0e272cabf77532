// SPDX-License-Identifier: Apache-2.0
#include "read_functions.h"

#include <stdexcept>

namespace tautline::models {
namespace {

/** Functions inside functions; deeper nesting is not a model but an attack on the stack. */
constexpr int kDeepestNesting = 16;

std::optional<ScalarFunction> readWrapped(const Element& wrapper, int depth);

ScalarFunction readLinear(Element element) {
    const std::vector<double> coefficients = element.require("coefficients").getNumbers(2);
    return ScalarFunction::linear(coefficients[0], coefficients[1]);
}

ScalarFunction readMultiplier(Element element, int depth) {
    const Element wrapper = element.require("function");
    const std::optional<ScalarFunction> inner = readWrapped(wrapper, depth);
    if (!inner) wrapper.fail("no function in " + element.describe());
    return inner->scaledBy(element.getNumberOr("scale", 1.0));
}

/** Each number is 1, 1, 0, 0 where the file leaves it out. */
ScalarFunction readSine(Element element) {
    return ScalarFunction::sine(element.getNumberOr("amplitude", 1.0), element.getNumberOr("omega", 1.0),
                                element.getNumberOr("phase", 0.0), element.getNumberOr("offset", 0.0));
}

ScalarFunction readKnown(Element& element, int depth) {
    const std::string tag = element.getTag();
    if (tag == "Constant") return ScalarFunction::constant(element.getNumberOr("value", 0.0));
    if (tag == "LinearFunction") return readLinear(element);
    if (tag == "Sine") return readSine(element);
    if (tag == "MultiplierFunction") return readMultiplier(element, depth);
    if (tag == "PolynomialFunction") return ScalarFunction::polynomial(element.require("coefficients").getNumbers());
    const bool lines = tag == "PiecewiseLinearFunction";
    if (!lines && tag != "SimmSpline" && tag != "NaturalCubicSpline" && tag != "natCubicSpline")
        element.fail("unknown function " + element.describe());
    std::vector<double> x = element.require("x").getNumbers();
    std::vector<double> y = element.require("y").getNumbers();
    return lines ? ScalarFunction::piecewiseLinear(std::move(x), std::move(y))
                 : ScalarFunction::simmSpline(std::move(x), std::move(y));
}

void refuseUnknownParts(Element element) {
    for (const char* tag :
         {"value", "coefficients", "function", "scale", "x", "y", "amplitude", "omega", "phase", "offset"})
        element.acceptTag(tag);
    element.refuseUnknown();
}

ScalarFunction readAtDepth(Element element, int depth) {
    if (depth > kDeepestNesting) element.fail("functions are nested too deeply");
    try {
        const ScalarFunction function = readKnown(element, depth);
        refuseUnknownParts(element);
        return function;
    } catch (const std::invalid_argument& error) {
        element.fail(element.describe() + ": " + error.what());
    }
}

std::optional<ScalarFunction> readWrapped(const Element& wrapper, int depth) {
    const std::vector<Element> children = wrapper.getChildren();
    if (children.size() > 1) children[1].fail("a second function in " + wrapper.describe());
    if (children.empty()) return std::nullopt;
    return readAtDepth(children[0], depth + 1);
}

}  // namespace

ScalarFunction readFunction(Element element) {
    return readAtDepth(element, 0);
}

std::optional<ScalarFunction> readWrappedFunction(const Element& wrapper) {
    return readWrapped(wrapper, 0);
}

ScalarFunction requireWrappedFunction(const Element& wrapper) {
    const std::optional<ScalarFunction> function = readWrappedFunction(wrapper);
    if (!function) wrapper.fail("no function in " + wrapper.describe());
    return *function;
}

}  // namespace tautline::models
