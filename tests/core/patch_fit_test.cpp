// SPDX-License-Identifier: Apache-2.0
/** Patches: what they reproduce, how they fit, how they go on beyond their edges. */
#include "tautline/surfaces/patch_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "support/surface_cases.h"
#include "tautline/error.h"

namespace tautline {
namespace {

/** The 121 points of thesis Fig. 3.9. */
std::vector<Vector3> makeSineCloud() {
    std::vector<Vector3> points;
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j) {
            const double u = kPi * (0.1 + 0.08 * i), v = kPi * (0.1 + 0.08 * j);
            points.push_back({u, v, std::sin(u) * std::sin(v)});
        }
    return points;
}

TEST(PatchFit, HasTheResidualsOfTheThesis) {
    const auto points = makeSineCloud();
    const FitReport two = fitPolynomialHeights(points, 2, 2, PolynomialTerms::TotalDegree).report;
    const FitReport five = fitPolynomialHeights(points, 5, 5, PolynomialTerms::TotalDegree).report;
    EXPECT_EQ(two.numUnknowns, 6);
    EXPECT_EQ(five.numUnknowns, 21);
    EXPECT_NEAR(two.sumOfSquares, 0.44123, 5e-6);
    EXPECT_NEAR(five.sumOfSquares, 0.001274, 5e-7);
    EXPECT_EQ(five.residuals.size(), 121u);
    EXPECT_NEAR(five.rms, std::sqrt(five.sumOfSquares / 121), 1e-15);
    // More terms fit better.
    EXPECT_LT(fitPolynomialHeights(points, 5, 5, PolynomialTerms::Tensor).report.sumOfSquares, five.sumOfSquares);
}

TEST(PatchFit, RecoversAPolynomial) {
    Eigen::MatrixXd p(3, 4);
    p << 0.1, -0.2, 0.3, 0.05, 0.4, 0.1, -0.1, 0.02, 0.3, -0.3, 0.2, 0.01;
    const ParameterDomain domain{Vector2(1, -2), Vector2(3, 1)};
    const PolynomialPatch patch = PolynomialPatch::makeHeightPatch(domain, p);
    std::vector<Vector3> points;
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) {
            const double u = 1 + 2 * i / 6.0, v = -2 + 3 * j / 6.0;
            double z = 0;
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 4; ++l) z += p(k, l) * std::pow(u, k) * std::pow(v, l);
            points.push_back({u, v, z});
            EXPECT_LT((patch.calcParametric(Vector2(u, v), 0).x - points.back()).norm(), 1e-13);
        }
    const PolynomialFit fit = fitPolynomialHeights(points, 2, 3, PolynomialTerms::Tensor);
    EXPECT_LT(fit.report.largest, 1e-13);
    EXPECT_LT((fit.patch.getCoefficients() - patch.getCoefficients()).norm(), 1e-12);
}

TEST(PatchFit, BSplineFitsBetterWithMoreCells) {
    const auto points = makeSineCloud();
    const double few = fitBSplineHeights(points, 4, 4).report.rms, more = fitBSplineHeights(points, 7, 7).report.rms;
    EXPECT_LT(more, 0.1 * few);
    const BSplineFit gaps = fitBSplineHeights(points, 20, 20);  // more unknowns than points
    EXPECT_LT(gaps.report.largest, 1e-10);
    EXPECT_LT((gaps.patch.calcParametric(Vector2(1.2345, 0.7), 0).x.head<2>() - Vector2(1.2345, 0.7)).norm(), 1e-13);
}

/** Points of a curved sheet in space, no height patch: polynomial in (u, v) of orders 2 and 3, on scattered (u, v). */
struct SheetCloud {
    std::vector<Vector2> uv;
    std::vector<Vector3> points;

    static Vector3 calcPoint(const Vector2& uv) {
        const double u = uv[0], v = uv[1];
        return {u + 0.2 * v * v, 0.5 * v - 0.1 * u * u, 0.3 * u * v * v * v - 0.2 * u * u + 0.1};
    }
    SheetCloud() {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int k = 0; k < 200; ++k) {
            uv.push_back({1 + 2 * uniform(random), -1 + 1.5 * uniform(random)});
            points.push_back(calcPoint(uv.back()));
        }
    }
};

TEST(PatchFit, PatchInSpaceRecoversAPolynomialSheet) {
    const SheetCloud cloud;
    const ParameterDomain domain{Vector2(1, -1), Vector2(3, 0.5)};
    const PolynomialFit fit = fitPolynomialPatch(cloud.uv, cloud.points, 2, 3, PolynomialTerms::Tensor, domain, -1);
    EXPECT_EQ(fit.report.numUnknowns, 12);
    EXPECT_LT(fit.report.largest, 1e-13);
    EXPECT_FALSE(fit.patch.isHeightPatch());
    EXPECT_EQ(fit.patch.getNormalSign(), -1);
    for (double u = 1; u <= 3; u += 0.37)
        for (double v = -1; v <= 0.5; v += 0.29)
            EXPECT_LT((fit.patch.calcParametric(Vector2(u, v), 0).x - SheetCloud::calcPoint(Vector2(u, v))).norm(),
                      1e-13);
    // Without the terms of degree four the rest is the best of what is left, and said.
    const PolynomialFit less = fitPolynomialPatch(cloud.uv, cloud.points, 2, 3, PolynomialTerms::TotalDegree, domain);
    EXPECT_EQ(less.report.numUnknowns, 9);
    EXPECT_GT(less.report.rms, 1e-4);
    EXPECT_NEAR(less.report.rms, std::sqrt(less.report.sumOfSquares / 200), 1e-15);
}

TEST(PatchFit, BSplinePatchInSpaceRecoversACubicSheetAndFitsAShellBetterWithMoreCells) {
    const SheetCloud cloud;
    const ParameterDomain domain{Vector2(1, -1), Vector2(3, 0.5)};
    const BSplineFit fit = fitBSplinePatch(cloud.uv, cloud.points, 5, 4, domain, -1);
    EXPECT_EQ(fit.report.numUnknowns, 20);
    EXPECT_LT(fit.report.largest, 1e-12);
    EXPECT_EQ(fit.patch.getNormalSign(), -1);
    EXPECT_LT((fit.patch.calcParametric(Vector2(2.2, 0.1), 0).x - SheetCloud::calcPoint(Vector2(2.2, 0.1))).norm(),
              1e-12);

    std::vector<Vector2> uv;
    std::vector<Vector3> shell;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
            uv.push_back({0.1 * i, 0.05 * j});
            shell.push_back({std::cos(uv.back()[0]), std::sin(uv.back()[0]), uv.back()[1]});
        }
    const double few = fitBSplinePatch(uv, shell, 5, 4, findDomain(uv)).report.rms,
                 more = fitBSplinePatch(uv, shell, 9, 4, findDomain(uv)).report.rms;
    EXPECT_LT(more, 0.1 * few);  // error of cubics: h^4
}

TEST(PatchFit, PatchInSpaceRefusesCoordinatesThatDoNotMatch) {
    SheetCloud cloud;
    const ParameterDomain domain = findDomain(cloud.uv);
    cloud.uv.pop_back();
    EXPECT_THROW(fitPolynomialPatch(cloud.uv, cloud.points, 2, 2, PolynomialTerms::Tensor, domain), InvalidInput);
    EXPECT_THROW(fitBSplinePatch(cloud.uv, cloud.points, 4, 4, domain), InvalidInput);
    cloud.points.pop_back();
    EXPECT_THROW(fitBSplinePatch(cloud.uv, cloud.points, 3, 4, domain), InvalidInput);
    cloud.uv[7][1] = kNaN;
    EXPECT_THROW(fitPolynomialPatch(cloud.uv, cloud.points, 2, 2, PolynomialTerms::Tensor, domain), InvalidInput);
}

TEST(PatchFit, RefusesWhatItCannotFit) {
    std::vector<Vector3> points = makeSineCloud();
    EXPECT_THROW(fitPolynomialHeights({points.begin(), points.begin() + 5}, 2, 2, PolynomialTerms::TotalDegree),
                 InvalidInput);
    std::vector<Vector3> line;
    for (int i = 0; i < 30; ++i) line.push_back({0.1 * i, 0.2 * i, 1});
    EXPECT_THROW(fitPolynomialHeights(line, 2, 2, PolynomialTerms::TotalDegree), InvalidInput);
    points[3].z() = kNaN;
    EXPECT_THROW(fitPolynomialHeights(points, 2, 2, PolynomialTerms::TotalDegree), InvalidInput);
    EXPECT_THROW(fitPolynomialHeights({}, 2, 2, PolynomialTerms::TotalDegree), InvalidInput);
}

/** Bicubic data are reproduced everywhere, and grid points of others are met. */
TEST(BSplinePatch, InterpolatesItsGridAndReproducesCubics) {
    const auto cubic = [](double x, double y) { return 0.2 * x * x * x - 0.4 * x * y * y + y * y * y * x * x + x - 1; };
    const int n = 6, m = 5;
    Eigen::MatrixXd heights(n, m);
    const ParameterDomain domain{Vector2(-1, 0), Vector2(1, 2)};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) heights(i, j) = cubic(-1 + 2.0 * i / (n - 1), 2.0 * j / (m - 1));
    const BSplinePatch patch = BSplinePatch::interpolateHeights(domain, heights);
    for (double x = -1; x <= 1; x += 0.13)
        for (double y = 0; y <= 2; y += 0.17)
            EXPECT_LT((patch.calcParametric(Vector2(x, y), 0).x - Vector3(x, y, cubic(x, y))).norm(), 1e-13);
    const BSplinePatch bumps = testing::makeBumpPatch(7);
    for (int i = 0; i < 7; ++i) {
        const double x = -1 + i / 3.0, y = -1 + 2 / 3.0;
        EXPECT_NEAR(bumps.calcParametric(Vector2(x, y), 0).x.z(), testing::calcBumps(x, y), 1e-14);
    }
}

/** Value and both derivatives are continuous across knots and across the edge of the domain. */
TEST(BSplinePatch, IsTwiceContinuouslyDifferentiable) {
    const BSplinePatch patch = testing::makeBumpPatch(9);
    const double h = 1e-9;
    for (const Vector2& uv :
         {Vector2(1, 0.3), Vector2(-1, 0.3), Vector2(0.3, 1), Vector2(1, 1), Vector2(0.25, 0.1), Vector2(0.25, 0.5)})
        for (const Vector2& d : {Vector2(h, 0), Vector2(0, h), Vector2(h, h)}) {
            const ParametricValue a = patch.calcParametric(uv - d, 0), b = patch.calcParametric(uv + d, 0);
            EXPECT_LT((a.x - b.x).norm() + (a.xu - b.xu).norm() + (a.xv - b.xv).norm(), 1e-7);
            EXPECT_LT((a.xuu - b.xuu).norm() + (a.xuv - b.xuv).norm() + (a.xvv - b.xvv).norm(), 1e-7);
        }
}

/** Derivatives are those of the position, inside and beyond the edges. */
/** Heights that both kinds of patch have exactly, with noise, and every eighth point far off, most of them to one side.
 */
std::vector<Vector3> makeNoisyHeights(double noise, std::vector<int>& sound) {
    std::mt19937 random(20261127);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Vector3> points;
    for (int i = 0; i < 800; ++i) {
        const double x = 0.1 * uniform(random), y = 0.15 * uniform(random);
        const double off = i % 8 > 0 ? noise * normal(random) : 0.02 + 0.02 * uniform(random);
        points.push_back({x, y, 0.3 * x - 2 * x * x + 3 * x * y * y + off});
        if (i % 8 > 0) sound.push_back(i);
    }
    return points;
}

TEST(PatchFit, LeavesOutWhatLiesFarOff) {
    std::vector<int> sound, kept;
    std::vector<Vector3> points = makeNoisyHeights(0, sound);
    const PolynomialFit polynomial = fitPolynomialHeightsRobustly(points, 3, 3, PolynomialTerms::TotalDegree, &kept);
    EXPECT_EQ(kept, sound);
    EXPECT_EQ(polynomial.report.leftOut, 100);
    EXPECT_LT(polynomial.report.largest, 1e-15);
    const BSplineFit spline = fitBSplineHeightsRobustly(points, 5, 5, &kept);
    EXPECT_EQ(kept, sound);
    EXPECT_LT(spline.report.largest, 1e-14);
    sound.clear();
    points = makeNoisyHeights(1e-4, sound);
    const PolynomialFit noisy = fitPolynomialHeightsRobustly(points, 3, 3, PolynomialTerms::TotalDegree, &kept);
    EXPECT_NEAR(noisy.report.leftOut, 100, 5);
    EXPECT_NEAR(noisy.report.rms, 1e-4, 1e-5);
    EXPECT_GT(fitPolynomialHeights(points, 3, 3, PolynomialTerms::TotalDegree).report.rms, 50e-4);
}

TEST(PatchShape, HeightPatchesAreMadeFromTheirHeights) {
    std::vector<int> sound;
    const std::vector<Vector3> points = makeNoisyHeights(1e-3, sound);
    const PolynomialPatch polynomial = fitPolynomialHeights(points, 4, 3, PolynomialTerms::Tensor).patch;
    const BSplinePatch spline = fitBSplineHeights(points, 6, 5).patch;
    Eigen::MatrixXd p(5, 4), heights(6, 5);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 4; ++j) p(i, j) = polynomial.getCoefficients()(2, 4 * i + j);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 5; ++j) heights(i, j) = spline.getControlPoints()(2, 5 * i + j);
    const auto again = PolynomialPatch::makeScaledHeightPatch(polynomial.getDomain(), p);
    const auto splineAgain = BSplinePatch::makeHeightPatch(spline.getDomain(), heights);
    for (const Vector3& point : points) {
        const Vector2 uv = point.head<2>();
        EXPECT_LT((again.calcParametric(uv, 0).x - polynomial.calcParametric(uv, 0).x).norm(), 1e-14);
        EXPECT_LT((splineAgain.calcParametric(uv, 0).x - spline.calcParametric(uv, 0).x).norm(), 1e-14);
    }
}

TEST(PatchShape, DerivativesAreDifferencesEverywhere) {
    const PolynomialPatch polynomial = testing::makePolynomialPatch(6);
    const BSplinePatch spline = testing::makeShellPatch();
    const double h = 1e-4;
    const auto check = [&](const auto& patch, const Vector2& uv) {
        const auto at = [&](double du, double dv) { return patch.calcParametric(uv + Vector2(du, dv), 0); };
        const ParametricValue s = at(0, 0);
        EXPECT_LT(((at(h, 0).x - at(-h, 0).x) / (2 * h) - s.xu).norm(), 1e-6);
        EXPECT_LT(((at(0, h).x - at(0, -h).x) / (2 * h) - s.xv).norm(), 1e-6);
        EXPECT_LT(((at(h, 0).xu - at(-h, 0).xu) / (2 * h) - s.xuu).norm(), 1e-4);
        EXPECT_LT(((at(0, h).xu - at(0, -h).xu) / (2 * h) - s.xuv).norm(), 1e-4);
        EXPECT_LT(((at(0, h).xv - at(0, -h).xv) / (2 * h) - s.xvv).norm(), 1e-4);
    };
    for (const Vector2& uv : {Vector2(0.3, 0.4), Vector2(-0.91, 0.2), Vector2(1.2, 0.3), Vector2(0.21, -1.7),
                              Vector2(1.4, 1.9), Vector2(-3, 2)}) {
        check(polynomial, uv);
        check(spline, uv);
    }
}

TEST(PatchShape, KnowsItsDomain) {
    const BSplinePatch height = testing::makeBumpPatch(8), shell = testing::makeShellPatch();
    EXPECT_TRUE(height.isInDomain(height.findSurfacePoint(Vector3(0.9, -0.9, 3))));
    EXPECT_FALSE(height.isInDomain(height.findSurfacePoint(Vector3(1.5, 0, 0))));
    EXPECT_TRUE(shell.isInDomain(shell.findSurfacePoint(Vector3(0.4, 0.1, 0.3))));
    EXPECT_FALSE(shell.isInDomain(shell.findSurfacePoint(Vector3(0.4, 0.1, 0.9))));
}

TEST(PatchShape, RefusalsNameTheValue) {
    const ParameterDomain empty{Vector2(1, 0), Vector2(1, 1)}, unit{Vector2(0, 0), Vector2(1, 1)};
    EXPECT_THROW(PolynomialPatch(empty, 1, 1, Eigen::Matrix3Xd::Zero(3, 4)), InvalidInput);
    EXPECT_THROW(PolynomialPatch(unit, 1, 1, Eigen::Matrix3Xd::Zero(3, 3)), InvalidInput);
    EXPECT_THROW(PolynomialPatch(unit, 0, 1, Eigen::Matrix3Xd::Zero(3, 2)), InvalidInput);
    EXPECT_THROW(BSplinePatch(unit, 3, 4, Eigen::Matrix3Xd::Zero(3, 12)), InvalidInput);
    EXPECT_THROW(BSplinePatch(unit, 4, 4, Eigen::Matrix3Xd::Constant(3, 16, kNaN)), InvalidInput);
    EXPECT_THROW(BSplinePatch::interpolateHeights(unit, Eigen::MatrixXd::Zero(3, 3)), InvalidInput);
}

}  // namespace
}  // namespace tautline
