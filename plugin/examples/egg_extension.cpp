// SPDX-License-Identifier: Apache-2.0
// A surface and a force law of one's own for model files: `tautline --load egg_extension.so run egg.osim`.
#include <tautline/models/extensions.h>
#include <tautline/surfaces/function_surface.h>

#include <cmath>

using namespace tautline;

namespace {

/** <WrapEgg>: (x^2 + y^2) / radius^2 (1 + taper z / half_length) + z^2 / half_length^2 = 1, blunt below for a taper
above 0. */
std::shared_ptr<const Surface> readEgg(models::ElementProperties& element) {
    const double radius = element.requirePositive("radius"), halfLength = element.requirePositive("half_length");
    const double taper = element.getNumberOr("taper", 0.2);
    if (std::abs(taper) > 0.5) element.fail("its taper is " + std::to_string(taper) + ", beyond 0.5");
    auto egg = makeImplicitSurface("egg", std::max(radius, halfLength), [=](auto x, auto y, auto z) {
        return (x * x + y * y) * (1 / (radius * radius)) * (1 + (taper / halfLength) * z) +
               z * z * (1 / (halfLength * halfLength)) - 1;
    });
    return std::make_shared<ImplicitFunctionSurface>(egg);
}

/** tension = scale (exp(rise strain) - 1) with strain = length / resting length - 1, while it is longer than that. */
class ExponentialLigament : public CableForceLaw {
public:
    ExponentialLigament(const Cable& cable, double restingLength, double scale, double rise)
        : CableForceLaw(cable), m_restingLength(restingLength), m_scale(scale), m_rise(rise) {}

    double calcTension(const SimTK::State& state) const override {
        return std::max(0.0, m_scale * std::expm1(m_rise * calcStrain(state)));
    }
    double calcPotentialEnergy(const SimTK::State& state) const override {
        const double strain = std::max(0.0, calcStrain(state));
        return m_scale * m_restingLength * (std::expm1(m_rise * strain) / m_rise - strain);
    }

private:
    double calcStrain(const SimTK::State& state) const { return getCable().getLength(state) / m_restingLength - 1; }

    double m_restingLength, m_scale, m_rise;
};

models::ForceLawMaker readExponentialLigament(models::ElementProperties& element) {
    const double restingLength = element.requirePositive("resting_length"), scale = element.requirePositive("scale");
    const double rise = element.requirePositive("rise");
    return [=](const Cable& cable) { return std::make_unique<ExponentialLigament>(cable, restingLength, scale, rise); };
}

}  // namespace

TAUTLINE_EXTENSION(extensions) {
    extensions.addSurface("WrapEgg", readEgg);
    extensions.addForceLaw("ExponentialLigament", readExponentialLigament);
}
