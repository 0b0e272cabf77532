// SPDX-License-Identifier: Apache-2.0
/** Each muscle model against its published equations, written here a second time and solved by other means, in long
double: laws that the code inverts in closed form by bisection, equilibria by bisection over the fiber's length, motions
by the classical Runge-Kutta method, De Groote's with the force of the tendon for a state. */
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "muscle_cases.h"
#include "support/random.h"

namespace tautline::testing {
namespace {

using Long = long double;

/** Where an ascending function is zero. */
Long bisect(const std::function<Long(Long)>& f, Long low, Long high) {
    for (int i = 0; i < 130; ++i) (f((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    return (low + high) / 2;
}

/** The equations of one model, normalized. */
struct Equations {
    std::function<Long(Long)> active, passive, tendon;
    /** Of active and damping part. */
    std::function<Long(Long force, Long activation, Long active)> velocity;
    std::function<Long(Long excitation, Long activation)> activationRate;
};

struct Unit {  // a muscle's dimensions
    explicit Unit(const MuscleParameters& p)
        : force(p.maxIsometricForce),
          fiber(p.optimalFiberLength),
          tendon(p.tendonSlackLength),
          height(std::sin(static_cast<Long>(p.pennationAtOptimal))),
          speed(static_cast<Long>(p.maxContractionVelocity) * p.optimalFiberLength) {}
    Long calcCos(Long l) const { return std::sqrt(1 - height * height / (l * l)); }
    Long calcTendon(Long path, Long l) const { return (path - fiber * l * calcCos(l)) / tendon; }
    Long force, fiber, tendon, height, speed;
};

Equations makeThelen(const Thelen2003Parameters& p) {
    Equations e;
    e.active = [=](Long l) { return std::exp(-(l - 1) * (l - 1) / p.activeWidth); };
    e.passive = [=](Long l) -> Long {
        const Long k = p.passiveShape;
        return l > 1 ? (std::exp(k * (l - 1) / p.passiveStrain) - 1) / (std::exp(k) - 1) : 0;
    };
    // The toe ends where exponential and line have one slope: found here, not by its formula.
    const auto excess = [=](Long toe) {
        const Long slope = 0.33L * 3 / toe * std::exp(3.0L) / (std::exp(3.0L) - 1);
        return slope * (p.tendonStrain - toe) - 0.67L;
    };
    const Long toe = bisect([&](Long t) { return -excess(t); }, 1e-4L * p.tendonStrain, p.tendonStrain);
    e.tendon = [=](Long lT) -> Long {
        const Long strain = lT - 1;
        if (strain > toe) return 0.33L + 0.67L * (strain - toe) / (p.tendonStrain - toe);
        return strain > 0 ? 0.33L * (std::exp(3 * strain / toe) - 1) / (std::exp(3.0L) - 1) : 0;
    };
    e.velocity = [=](Long F, Long a, Long fL) {
        const Long peak = a * fL, af = p.velocityShape, flen = p.lengtheningForce, s = 0.25L + 0.75L * a;
        const auto calc = [&](Long f) {
            const Long b = f <= peak ? peak + f / af : (2 + 2 / af) * (peak * flen - f) / (flen - 1);
            return s * (f - peak) / b;
        };
        const Long last = p.linearThreshold * flen * peak, h = 1e-7L * peak;
        if (F < 0) return calc(0) + F * (-3 * calc(0) + 4 * calc(h) - calc(2 * h)) / (2 * h);
        if (F > last)
            return calc(last) + (F - last) * (3 * calc(last) - 4 * calc(last - h) + calc(last - 2 * h)) / (2 * h);
        return calc(F);
    };
    e.activationRate = [=](Long u, Long a) {
        const Long z = 0.5L + 1.5L * a;
        return u > a ? (u - a) / (p.activationTime * z) : (u - a) * z / p.deactivationTime;
    };
    return e;
}

/** As makeThelen, with what is different in the deprecated form. */
Equations makeDeprecated(const Thelen2003DeprecatedParameters& p) {
    Equations e;
    e.active = [=](Long l) { return std::exp(-(l - 1) * (l - 1) / p.activeWidth); };
    e.passive = [=](Long l) -> Long {
        const Long k = p.passiveShape, e0 = p.passiveStrain;
        return l > 1 + e0 ? 1 + k / e0 * (l - 1 - e0) : std::exp(k * (l - 1) / e0) / std::exp(k);
    };
    e.tendon = [=](Long lT) -> Long {
        const Long strain = lT - 1, toe = 0.609L * p.tendonStrain, low = 0.001L * (1 + strain);
        if (strain > toe) return low + 1.712L / p.tendonStrain * (strain - toe) + 0.333333L;
        return low + (strain > 0 ? 0.333333L * (std::exp(3 * strain / toe) - 1) / (std::exp(3.0L) - 1) : 0);
    };
    e.velocity = [=](Long F, Long a, Long fL) {
        const Long peak = a * fL, af = p.velocityShape, flen = p.lengtheningForce;
        const Long vmax = p.velocityAtRest + a * (p.maxContractionVelocity - p.velocityAtRest);
        const auto calc = [&](Long f) {
            const Long b = f <= peak ? peak + f / af : (2 + 2 / af) * (peak * flen - f) / (flen - 1);
            return vmax / p.maxContractionVelocity * (f - peak) / (b + p.damping);
        };
        const Long last = 0.95L * flen * peak, h = 1e-7L * peak;
        if (F < 0) return calc(0) + F * (-3 * calc(0) + 4 * calc(h) - calc(2 * h)) / (2 * h);
        if (F > last)
            return calc(last) + (F - last) * (3 * calc(last) - 4 * calc(last - h) + calc(last - 2 * h)) / (2 * h);
        return calc(F);
    };
    e.activationRate = [=](Long u, Long a) { return (u - a) / (u >= a ? p.activationTime : p.deactivationTime); };
    return e;
}

Equations makeDeGroote(const DeGrooteFregly2016Parameters& p) {
    Equations e;
    e.active = [=](Long l) {
        const Long x = (l - 1) / p.activeForceWidthScale + 1;
        const auto bell = [x](Long b1, Long b2, Long b3, Long b4) {
            return b1 * std::exp(-(x - b2) * (x - b2) / (2 * (b3 + b4 * x) * (b3 + b4 * x)));
        };
        return bell(0.8150671134243542L, 1.055033428970575L, 0.162384573599574L, 0.063303448465465L) +
               bell(0.433004984392647L, 0.716775413397760L, -0.029947116970696L, 0.200356847296188L) +
               bell(0.1L, 1, 0.353553390593274L, 0);
    };
    e.passive = [=](Long l) {
        const Long offset = std::exp(4 * (0.2L - 1) / p.passiveFiberStrain);
        return (std::exp(4 * (l - 1) / p.passiveFiberStrain) - offset) / (std::exp(4.0L) - offset);
    };
    e.tendon = [=](Long lT) {
        const Long kT = std::log(6.0L) / p.tendonStrain;
        return lT > 1 ? 0.2L * std::exp(kT * (lT - 1)) - 0.2L : 0;
    };
    e.velocity = [=](Long F, Long a, Long fL) {
        const auto calcForce = [&](Long v) {
            const Long x = -8.149L * v - 0.374L;
            const Long f = -0.3211346127989808L * std::log(x + std::sqrt(x * x + 1)) + 0.8825327733249912L;
            return a * fL * f + p.fiberDamping * v - F;
        };
        return bisect(calcForce, -1e3L, 1e3L);
    };
    e.activationRate = [=](Long u, Long a) {
        const Long f = 0.5L * std::tanh(0.1L * (u - a)), z = 0.5L + 1.5L * a;
        return ((f + 0.5L) / (p.activationTime * z) + (0.5L - f) * z / p.deactivationTime) * (u - a);
    };
    return e;
}

/** With the curves of muscle_curves_test.cpp, which tests them. */
Equations makeMillard(const Millard2012& model) {
    Equations e;
    e.active = [&](Long l) { return model.calcActiveForceLength(static_cast<double>(l)); };
    e.passive = [&](Long l) { return model.calcPassiveForceLength(static_cast<double>(l)); };
    e.tendon = [&](Long l) { return model.calcTendonForceLength(static_cast<double>(l)); };
    e.velocity = [&](Long F, Long a, Long fL) {
        return bisect(
            [&](Long v) {
                return a * fL * model.calcForceVelocity(static_cast<double>(v), 1) +
                       model.getParameters().fiberDamping * v - F;
            },
            -1e3L, 1e3L);
    };
    const MuscleParameters& p = model.getParameters();
    e.activationRate = [&](Long u, Long a) {
        const Long z = 0.5L + 1.5L * a;
        return u > a ? (u - a) / (p.activationTime * z) : (u - a) * z / p.deactivationTime;
    };
    return e;
}

/** Schutte 1992: quadratic equations for the velocity, solved there in closed form, here not at all. */
Equations makeSchutte(const Schutte1993& model) {
    const CurveMuscleParameters& p = model.getParameters();
    Equations e;
    e.active = [&](Long l) { return p.activeForceLength(static_cast<double>(l)); };
    e.passive = [&](Long l) { return p.passiveForceLength(static_cast<double>(l)); };
    e.tendon = [&](Long l) { return l > 1 ? p.tendonForceStrain(static_cast<double>(l - 1)) : 0; };
    e.velocity = [&](Long F, Long a, Long fL) -> Long {
        const Long kv = 0.15L, slope = 0.13L, fmax = 1.4L, d = p.fiberDamping, peak = a * fL;
        if (F < -d) return F / d;
        if (F < peak) {
            const Long c = kv * (F - peak) / d, b = -kv * (F / kv + peak + d) / d;
            return (-b - std::sqrt(b * b - 4 * c)) / 2;
        }
        const Long m = slope * kv / (kv + 1), c = -m / d * (F - peak), b = -(F / d - fmax * peak / d - m);
        return (-b + std::sqrt(b * b - 4 * c)) / 2;
    };
    e.activationRate = [&](Long u, Long a) {
        return (u - a) * (u >= a ? p.activation1 * u + p.activation2 : static_cast<Long>(p.activation2)) / p.timeScale;
    };
    return e;
}

struct Pair {
    std::string name;
    std::shared_ptr<const MuscleModel> model;
    Equations equations;
};

std::vector<Pair> makePairs() {
    std::vector<Pair> pairs;
    const auto thelen = makeTypical<Thelen2003Parameters>();
    pairs.push_back({"Thelen2003", std::make_shared<Thelen2003>(thelen), makeThelen(thelen)});
    auto arm26 = makeTypical<Thelen2003Parameters>();  // the parameters of arm26's muscles
    arm26.tendonStrain = 0.033, arm26.activeWidth = 0.5, arm26.passiveShape = 4, arm26.velocityShape = 0.3;
    arm26.lengtheningForce = 1.8, arm26.activationTime = 0.01, arm26.deactivationTime = 0.04;
    pairs.push_back({"Thelen2003 of arm26", std::make_shared<Thelen2003>(arm26), makeThelen(arm26)});
    const auto deprecated = makeTypical<Thelen2003DeprecatedParameters>();
    pairs.push_back(
        {"Thelen2003Deprecated", std::make_shared<Thelen2003Deprecated>(deprecated), makeDeprecated(deprecated)});
    auto deGroote = makeTypical<DeGrooteFregly2016Parameters>();
    pairs.push_back({"DeGrooteFregly2016", std::make_shared<DeGrooteFregly2016>(deGroote), makeDeGroote(deGroote)});
    deGroote.fiberDamping = 0.07, deGroote.activeForceWidthScale = 1.3;
    pairs.push_back(
        {"DeGrooteFregly2016 damped", std::make_shared<DeGrooteFregly2016>(deGroote), makeDeGroote(deGroote)});
    auto millard = makeTypical<Millard2012Parameters>();
    const auto damped = std::make_shared<Millard2012>(millard);
    pairs.push_back({"Millard2012", damped, makeMillard(*damped)});
    millard.fiberDamping = 0;
    const auto classic = std::make_shared<Millard2012>(millard);
    pairs.push_back({"Millard2012 classic", classic, makeMillard(*classic)});
    const auto schutte = std::make_shared<Schutte1993>(makeTypicalCurves());
    pairs.push_back({"Schutte1993", schutte, makeSchutte(*schutte)});
    return pairs;
}

TEST(MuscleEquations, CurvesAndVelocitiesAgree) {
    for (const Pair& pair : makePairs()) {
        SCOPED_TRACE(pair.name);
        Random random(81);
        for (int i = 0; i < 1000; ++i) {
            const double l = random.uniform(0.45, 1.8), lT = random.uniform(0.97, 1.08);
            EXPECT_NEAR(pair.model->calcActiveForceLength(l), static_cast<double>(pair.equations.active(l)), 1e-13);
            EXPECT_NEAR(pair.model->calcPassiveForceLength(l), static_cast<double>(pair.equations.passive(l)), 1e-12);
            EXPECT_NEAR(pair.model->calcTendonForceLength(lT), static_cast<double>(pair.equations.tendon(lT)), 1e-12);
            const double a = random.uniform(0.02, 1), fL = random.uniform(0.1, 1), f = random.uniform(-0.3, 2) * a * fL;
            const double v = pair.model->calcFiberVelocity(f, a, fL);
            EXPECT_NEAR(v, static_cast<double>(pair.equations.velocity(f, a, fL)), 1e-8 * (1 + std::abs(v)))
                << a << " " << fL << " " << f;
            const double u = random.uniform(0.02, 1);
            EXPECT_NEAR(pair.model->calcActivationRate(u, a), static_cast<double>(pair.equations.activationRate(u, a)),
                        1e-11);
        }
    }
}

TEST(MuscleEquations, EquilibriaAgree) {
    for (const Pair& pair : makePairs()) {
        SCOPED_TRACE(pair.name);
        Random random(82);
        const MuscleParameters& p = pair.model->getParameters();
        const Unit unit(p);
        for (int i = 0; i < 300; ++i) {
            const double path = p.tendonSlackLength + p.optimalFiberLength * random.uniform(0.6, 1.7);
            const double a = random.integer(0, 2) ? random.uniform(0.01, 1) : 1;
            const auto excess = [&](Long l) {
                return (a * pair.equations.active(l) + pair.equations.passive(l)) * unit.calcCos(l) -
                       pair.equations.tendon(unit.calcTendon(path, l));
            };
            const Long slack = std::hypot((path - unit.tendon) / unit.fiber, unit.height);
            const Long l = bisect(excess, 1.001L * unit.height, 1.01L * slack);
            const MuscleEquilibrium found = pair.model->findEquilibrium(path, a);
            if (found.status == EquilibriumStatus::FiberAtLowerBound) continue;
            EXPECT_NEAR(found.fiberLength, static_cast<double>(l * unit.fiber), 1e-12);
            EXPECT_NEAR(found.tendonForce,
                        static_cast<double>(unit.force * pair.equations.tendon(unit.calcTendon(path, l))), 1e-8);
        }
    }
}

/** A path that swings and an excitation that is switched on and off smoothly. */
struct Course {
    Long calcPath(Long t) const { return middle + amplitude * std::sin(20 * t); }
    Long calcRate(Long t) const { return amplitude * 20 * std::cos(20 * t); }
    Long calcExcitation(Long t) const { return 0.5L + 0.4L * std::sin(9 * t); }
    Long middle, amplitude;
};

TEST(MuscleEquations, MotionsAgree) {
    for (const Pair& pair : makePairs()) {
        SCOPED_TRACE(pair.name);
        const MuscleParameters& p = pair.model->getParameters();
        const Unit unit(p);
        const Course course{unit.tendon * 1.02L + unit.fiber, 0.1L * unit.fiber};
        const Equations& e = pair.equations;
        const auto calcFiberRate = [&](Long t, Long a, Long length) {
            const Long l = length / unit.fiber, cosine = unit.calcCos(l);
            const Long f = e.tendon(unit.calcTendon(course.calcPath(t), l)) / cosine - e.passive(l);
            return unit.speed * e.velocity(f, a, e.active(l));
        };
        const auto calcModelRate = [&](Long t, Long a, Long length) {
            return pair.model
                ->calcDynamics(static_cast<double>(course.calcPath(t)), static_cast<double>(course.calcRate(t)),
                               static_cast<double>(a), static_cast<double>(length))
                .fiberVelocity;
        };
        Long time = 0, a1 = 0.3L, a2 = 0.3L, l1 = 1.01L * unit.fiber, l2 = l1;
        const Long h = 1e-5L;
        const auto step = [&](Long& a, Long& l, const auto& rateOfA, const auto& rateOfL) {
            const Long b1 = rateOfA(time, a), k1 = rateOfL(time, a, l);
            const Long b2 = rateOfA(time + h / 2, a + h / 2 * b1),
                       k2 = rateOfL(time + h / 2, a + h / 2 * b1, l + h / 2 * k1);
            const Long b3 = rateOfA(time + h / 2, a + h / 2 * b2),
                       k3 = rateOfL(time + h / 2, a + h / 2 * b2, l + h / 2 * k2);
            const Long b4 = rateOfA(time + h, a + h * b3), k4 = rateOfL(time + h, a + h * b3, l + h * k3);
            a += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4), l += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        };
        for (int i = 0; i < 5000; ++i) {
            step(
                a1, l1, [&](Long t, Long a) { return e.activationRate(course.calcExcitation(t), a); }, calcFiberRate);
            step(
                a2, l2,
                [&](Long t, Long a) {
                    return static_cast<Long>(pair.model->calcActivationRate(
                        static_cast<double>(course.calcExcitation(t)), static_cast<double>(a)));
                },
                calcModelRate);
            time += h;
        }
        EXPECT_NEAR(static_cast<double>(a2), static_cast<double>(a1), 1e-10);
        EXPECT_NEAR(static_cast<double>(l2 / unit.fiber), static_cast<double>(l1 / unit.fiber), 1e-9);
    }
}

/** The paper's own form: the state is the tendon's force, dF/dt = f_T'(l_T) (path rate - fiber rate/cos(alpha))/l_S. */
TEST(MuscleEquations, DeGrootesTendonForceMovesTheSameFiber) {
    const auto p = makeTypical<DeGrooteFregly2016Parameters>();
    const DeGrooteFregly2016 model(p);
    const Equations e = makeDeGroote(p);
    const Unit unit(p);
    const Course course{unit.tendon * 1.02L + unit.fiber, 0.1L * unit.fiber};
    const Long activation = 0.4L, kT = std::log(6.0L) / p.tendonStrain, h = 1e-5L;
    const auto calcTendon = [&](Long F) { return unit.tendon * (1 + std::log((F + 0.2L) / 0.2L) / kT); };
    const auto calcForceRate = [&](Long t, Long F) {
        const Long along = (course.calcPath(t) - calcTendon(F)) / unit.fiber, l = std::hypot(along, unit.height);
        const Long cosine = along / l;
        const Long v = unit.speed * e.velocity(F / cosine - e.passive(l), activation, e.active(l));
        return kT * (F + 0.2L) * (course.calcRate(t) - v / cosine) / unit.tendon;
    };
    const auto calcFiberRate = [&](Long t, Long l) -> Long {
        return model
            .calcDynamics(static_cast<double>(course.calcPath(t)), 0, static_cast<double>(activation),
                          static_cast<double>(l))
            .fiberVelocity;
    };
    const auto step = [h](Long t, Long& x, const auto& rate) {
        const Long k1 = rate(t, x), k2 = rate(t + h / 2, x + h / 2 * k1), k3 = rate(t + h / 2, x + h / 2 * k2);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(t + h, x + h * k3));
    };
    Long force = 0.3L;
    Long fiber = unit.fiber * std::hypot((course.calcPath(0) - calcTendon(force)) / unit.fiber, unit.height);
    for (int i = 0; i < 5000; ++i) {
        step(i * h, force, calcForceRate);
        step(i * h, fiber, calcFiberRate);
    }
    const MuscleDynamics d = model.calcDynamics(static_cast<double>(course.calcPath(5000 * h)), 0,
                                                static_cast<double>(activation), static_cast<double>(fiber));
    EXPECT_NEAR(d.tendonForce / p.maxIsometricForce, static_cast<double>(force), 1e-9);
}

// Published figures.

TEST(MuscleFigures, ThelensCurvesMeetTheirNamedPoints) {
    const Thelen2003Parameters p;
    const Thelen2003 muscle(p);
    EXPECT_EQ(muscle.calcActiveForceLength(1), 1);
    EXPECT_NEAR(muscle.calcActiveForceLength(1 + std::sqrt(0.45)), std::exp(-1.0), 1e-15);
    EXPECT_NEAR(muscle.calcPassiveForceLength(1.6), 1, 1e-15);
    EXPECT_EQ(muscle.calcPassiveForceLength(1), 0);
    EXPECT_NEAR(muscle.calcTendonForceLength(1.04), 1, 1e-14);
    EXPECT_NEAR(muscle.calcTendonForceLength(1 + 0.609 * 0.04), 0.33, 1e-3);  // the paper's rounded end of the toe
    EXPECT_NEAR((muscle.calcTendonForceLength(1.05) - 1) / 0.01, 1.712 / 0.04, 0.1);  // and its slope
    EXPECT_EQ(muscle.calcForceVelocity(0, 0.3), 1);
    EXPECT_NEAR(muscle.calcForceVelocity(-1, 1), 0, 1e-15);
    EXPECT_NEAR(muscle.calcForceVelocity(-0.25 - 0.75 * 0.2, 0.2), 0, 1e-15);
    EXPECT_NEAR(muscle.calcForceVelocity(-0.5, 1), 0.5 / 3, 1e-15);
}

TEST(MuscleFigures, DeGrootesCurvesMeetTheirNamedPoints) {
    const DeGrooteFregly2016 muscle{DeGrooteFregly2016Parameters()};
    EXPECT_NEAR(muscle.calcActiveForceLength(1), 1, 1e-8);
    EXPECT_NEAR(muscle.calcPassiveForceLength(1.6), 1, 1e-15);
    EXPECT_NEAR(muscle.calcPassiveForceLength(0.2), 0, 1e-15);
    EXPECT_NEAR(muscle.calcPassiveForceLength(1), 0.018, 1e-3);  // not zero, as the paper's Fig. 3 has it
    EXPECT_NEAR(muscle.calcTendonForceLength(1.049), 1, 1e-14);
    EXPECT_EQ(muscle.calcTendonForceLength(1), 0);
    EXPECT_NEAR(muscle.calcForceVelocity(-1, 1), 0, 1e-8);
    EXPECT_NEAR(muscle.calcForceVelocity(0, 1), 1, 1e-8);
    EXPECT_NEAR(muscle.calcForceVelocity(1, 1), 1.794, 1e-3);
}

TEST(MuscleFigures, MillardsParametersAreAdjustedToTheKindOfMuscle) {
    Millard2012Parameters p;
    EXPECT_EQ(Millard2012(p).calcActiveForceLength(0.4), 0);
    EXPECT_EQ(Millard2012(p).calcForceVelocity(-2, 1), 0);
    p.fiberDamping = 0.0009;
    const Millard2012 classic(p);
    EXPECT_EQ(classic.getParameters().fiberDamping, 0);
    EXPECT_EQ(classic.calcActiveForceLength(0.4), 0.1);
    EXPECT_NEAR(classic.calcForceVelocity(-2, 1), -0.125, 1e-15);
    p.minimumActivation = 0;
    EXPECT_EQ(Millard2012(p).clampActivation(0), 0.01);
    p.ignoresTendonCompliance = true;
    EXPECT_EQ(Millard2012(p).clampActivation(0), 0);
    EXPECT_EQ(Millard2012(p).calcActiveForceLength(0.4), 0);
    EXPECT_EQ(Millard2012(p).calcMinimumFiberLength(), 0.4441);
}

TEST(MuscleFigures, SchuttesPassiveForceIsOneAtOneAndAHalf) {
    CurveMuscleParameters p = makeTypicalCurves();
    p.passiveForceLength = nullptr;
    const Schutte1993 muscle(p);
    EXPECT_NEAR(muscle.calcPassiveForceLength(1.5), 1, 1e-15);
    EXPECT_EQ(muscle.calcForceVelocity(-1, 1), 0);
    EXPECT_EQ(muscle.calcForceVelocity(0, 1), 1);
    EXPECT_EQ(muscle.getParameters().maxContractionVelocity, 10);
}

}  // namespace
}  // namespace tautline::testing
