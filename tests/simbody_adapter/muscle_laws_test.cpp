// SPDX-License-Identifier: Apache-2.0
/** What holds for every muscle model, whatever its equations:
(1) for all arguments, also far beyond sense, every result is finite, and tendons only pull;
(2) fiber and tendon pull alike, and their powers add up to that at the path, tension times shortening speed;
(3) the fiber's velocity is that at which its force-velocity law holds;
(4) the rates of the stored energies are the powers of the elastic parts;
(5) an equilibrium is where the fiber would stay;
(6) over a cycle the work at the path is what the active part gives less what the damping takes;
(7) a path shorter than tendon and shortest fiber is slack. */
#include <gtest/gtest.h>

#include <cmath>

#include "muscle_cases.h"
#include "support/random.h"

namespace tautline::testing {
namespace {

class MuscleLaws : public ::testing::TestWithParam<MuscleCase> {
protected:
    const MuscleModel& model = *GetParam().model;
    const MuscleParameters& p = model.getParameters();
    bool isRigid() const { return model.hasRigidTendon(); }
    /** Path length of a fiber at l_0 times `fiber` and a tendon stretched by `strain`. */
    double makePathLength(double fiber, double strain) const {
        const double height = std::sin(p.pennationAtOptimal);
        const double along = std::sqrt(std::max(0.0, fiber * fiber - height * height));
        return along * p.optimalFiberLength + p.tendonSlackLength * (1 + (isRigid() ? 0 : strain));
    }
};

void expectFinite(const MuscleDynamics& d) {
    for (double value :
         {d.lengths.fiberLength, d.lengths.normFiberLength, d.lengths.sinPennation, d.lengths.cosPennation,
          d.lengths.tendonLength, d.fiberVelocity, d.tendonVelocity, d.activeFiberForce, d.passiveFiberForce,
          d.dampingFiberForce, d.tendonForce, d.fiberActivePower, d.fiberPassivePower, d.tendonPower, d.musclePower})
        ASSERT_TRUE(std::isfinite(value));
    ASSERT_GE(d.tendonForce, 0);
}

TEST_P(MuscleLaws, EveryResultIsFinite) {
    Random random(71);
    for (int i = 0; i < 3000; ++i) {
        const double length = random.integer(0, 3) == 0 ? -random.logUniform(1e-9, 100) : random.logUniform(1e-9, 100);
        const double rate = (random.integer(0, 1) ? 1 : -1) * random.logUniform(1e-6, 1e4);
        const double fiber = (random.integer(0, 9) ? 1 : -1) * random.logUniform(1e-9, 100);
        const double activation = random.uniform(-0.5, 1.5);
        SCOPED_TRACE(std::to_string(length) + " " + std::to_string(fiber) + " " + std::to_string(activation));
        const MuscleDynamics d = model.calcDynamics(length, rate, activation, fiber);
        ASSERT_NO_FATAL_FAILURE(expectFinite(d));
        const MuscleEnergy energy = model.calcEnergy(d.lengths);
        ASSERT_TRUE(std::isfinite(energy.fiber) && std::isfinite(energy.tendon));
        ASSERT_TRUE(std::isfinite(model.calcActivationRate(random.uniform(0, 1), model.clampActivation(activation))));
        const MuscleEquilibrium found = model.findEquilibrium(length, activation);
        ASSERT_TRUE(std::isfinite(found.fiberLength) && std::isfinite(found.tendonForce));
        ASSERT_GE(found.tendonForce, 0);
    }
}

TEST_P(MuscleLaws, ForcesAgreeAndPowersAddUp) {
    Random random(72);
    for (int i = 0; i < 1000; ++i) {
        const double length = makePathLength(random.uniform(0.5, 1.7), random.uniform(-0.02, 0.06));
        const double fiber = p.optimalFiberLength * random.uniform(0.3, 1.8), rate = random.uniform(-1, 1);
        const MuscleDynamics d = model.calcDynamics(length, rate, random.uniform(0, 1), fiber);
        const double scale = p.maxIsometricForce * (1 + d.tendonForce / p.maxIsometricForce);
        EXPECT_NEAR(d.calcFiberForce() * d.lengths.cosPennation, d.tendonForce, 1e-12 * scale);
        EXPECT_NEAR(d.fiberActivePower + d.fiberPassivePower + d.fiberDampingPower + d.tendonPower, d.musclePower,
                    1e-11 * scale * (1 + std::abs(d.fiberVelocity)));
        EXPECT_EQ(d.musclePower, -d.tendonForce * rate);
        EXPECT_NEAR(d.lengths.tendonLength + d.lengths.fiberLength * d.lengths.cosPennation, length, 1e-15);
    }
}

TEST_P(MuscleLaws, VelocityFollowsTheForceVelocityLaw) {
    if (GetParam().name == "Thelen2003Deprecated") return;  // its damping has no place in f_V: tested by its equation
    if (GetParam().name == "Millard2012 rigid") return;     // never inverts its flat ends
    Random random(73);
    for (int i = 0; i < 1000; ++i) {
        const double a = random.uniform(0.02, 1), fL = random.uniform(0.1, 1), f = random.uniform(-0.2, 2);
        const double v = model.calcFiberVelocity(f, a, fL);
        if (std::abs(v) == MuscleModel::kFastest) continue;
        EXPECT_NEAR(a * fL * model.calcForceVelocity(v, a) + p.fiberDamping * v, f, 1e-10)
            << "a " << a << " fL " << fL << " f " << f << " v " << v;
    }
}

TEST_P(MuscleLaws, EnergiesAreIntegralsOfTheForces) {
    const double h = 1e-5;
    for (double l = 0.45; l < 2; l += 0.0173) {
        const double slope = (model.calcPassiveEnergy(l + h) - model.calcPassiveEnergy(l - h)) / (2 * h);
        EXPECT_NEAR(slope, model.calcPassiveForceLength(l), 1e-6 * (1 + slope)) << "fiber " << l;
    }
    if (isRigid()) return;
    for (double l = 0.95; l < 1.1; l += 0.00171) {
        const double slope = (model.calcTendonEnergy(l + h) - model.calcTendonEnergy(l - h)) / (2 * h);
        EXPECT_NEAR(slope, model.calcTendonForceLength(l), 2e-6 * (1 + slope)) << "tendon " << l;
    }
}

TEST_P(MuscleLaws, FibersStayWhereTheyAreInEquilibrium) {
    Random random(74);
    int numFound = 0;
    for (int i = 0; i < 500; ++i) {
        const double length = makePathLength(random.uniform(0.2, 1.9), random.uniform(-0.05, 0.1));
        const double activation = random.integer(0, 3) ? random.uniform(0.01, 1) : 0.01;
        const MuscleEquilibrium found = model.findEquilibrium(length, activation);
        const MuscleDynamics d = model.calcDynamics(length, 0, activation, found.fiberLength);
        EXPECT_EQ(d.tendonForce, found.tendonForce);
        EXPECT_NEAR(d.normFiberVelocity, 0, 1e-7)
            << "path " << length << " activation " << activation << " " << getName(found.status);
        numFound += found.status == EquilibriumStatus::Found;
    }
    EXPECT_GT(numFound, 250);
}

/** What is integrated over a cycle. */
struct Books {
    double fiber = 0, path = 0, active = 0, damping = 0;
};

TEST_P(MuscleLaws, EnergyIsBalancedOverACycle) {
    const double period = 0.5, middle = makePathLength(1.05, 0.01), amplitude = 0.15 * p.optimalFiberLength;
    const double pi = std::acos(-1);
    const auto calcRates = [&](double t, const Books& books) {
        const double w = 2 * pi / period, activation = 0.4 + 0.3 * std::cos(w * t + 1);
        const MuscleDynamics d = model.calcDynamics(middle + amplitude * std::sin(w * t),
                                                    amplitude * w * std::cos(w * t), activation, books.fiber);
        return Books{d.fiberVelocity, d.musclePower, d.fiberActivePower, d.fiberDampingPower};
    };
    const auto add = [](const Books& a, double s, const Books& b) {
        return Books{a.fiber + s * b.fiber, a.path + s * b.path, a.active + s * b.active, a.damping + s * b.damping};
    };
    Books books;
    books.fiber = model.findEquilibrium(middle, 0.4 + 0.3 * std::cos(1.0)).fiberLength;
    const auto calcStored = [&](double pathLength) {
        const MuscleEnergy energy = model.calcEnergy(model.calcLengths(pathLength, books.fiber));
        return energy.fiber + energy.tendon;
    };
    const double before = calcStored(middle);
    const int steps = 40000;
    const double h = period / steps;
    for (int i = 0; i < steps; ++i) {  // the classical Runge-Kutta method
        const double t = i * h;
        const Books k1 = calcRates(t, books), k2 = calcRates(t + h / 2, add(books, h / 2, k1));
        const Books k3 = calcRates(t + h / 2, add(books, h / 2, k2)), k4 = calcRates(t + h, add(books, h, k3));
        books = add(add(add(add(books, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
    const double stored = calcStored(middle) - before, turnover = p.maxIsometricForce * amplitude;
    EXPECT_GT(std::abs(books.path), 1e-3 * turnover);
    EXPECT_LE(books.damping, 0);
    EXPECT_NEAR(books.path, books.active + books.damping - stored, 1e-6 * turnover);
}

TEST_P(MuscleLaws, ShortPathsAreSlack) {
    if (GetParam().name == "Thelen2003Deprecated") return;  // its tendon always pulls a little
    const double shortest = makePathLength(std::max(model.calcMinimumFiberLength(), std::sin(p.pennationAtOptimal)), 0);
    for (double activation : {0.01, 0.3, 1.0}) {
        const MuscleEquilibrium found = model.findEquilibrium(0.99 * shortest - 1e-6, activation);
        EXPECT_EQ(found.status, EquilibriumStatus::FiberAtLowerBound);
        EXPECT_EQ(found.tendonForce, 0);
        EXPECT_EQ(found.fiberLength, model.calcMinimumFiberLength() * p.optimalFiberLength);
    }
}

TEST(MusclePennation, FibersStopAtTheMaximalPennation) {
    auto p = makeTypical<Thelen2003Parameters>();
    EXPECT_NEAR(Thelen2003(p).calcMinimumFiberLength(), std::sin(0.3) / std::sqrt(0.99), 1e-15);
    EXPECT_NEAR(Thelen2003(p).calcLengths(0, 0).cosPennation, 0.1, 1e-15);
    p.maximumPennation = std::acos(0.0);  // as files give it; something is left along the tendon
    EXPECT_NEAR(Thelen2003(p).calcLengths(0, 0).cosPennation, 0.01, 1e-6);
    p.maximumPennation = 0;  // less than at the optimal length: that is the steepest then
    EXPECT_EQ(Thelen2003(p).calcMinimumFiberLength(), 1);
    p.pennationAtOptimal = 0;
    EXPECT_EQ(Thelen2003(p).calcMinimumFiberLength(), 0);
}

INSTANTIATE_TEST_SUITE_P(AllModels, MuscleLaws, ::testing::ValuesIn(makeMuscleCases()), [](const auto& each) {
    std::string name = each.param.name;
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
});

}  // namespace
}  // namespace tautline::testing
