// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/patch_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>

#include "surfaces/shape_checks.h"

namespace tautline {
namespace {

void checkCloud(const std::vector<Vector2>& uv, const std::vector<Vector3>& points) {
    require(uv.size() == points.size(), "patch fit: ", uv.size(), " coordinates for ", points.size(), " points");
    require(!points.empty(), "patch fit: needs points");
    for (std::size_t k = 0; k < points.size(); ++k)
        require(uv[k].allFinite() && points[k].allFinite(), "patch fit: point ", k, " is not finite");
}

std::vector<Vector2> takeHeads(const std::vector<Vector3>& points) {
    std::vector<Vector2> uv;
    for (const Vector3& p : points) uv.push_back(p.head<2>());
    return uv;
}

Eigen::MatrixX3d stack(const std::vector<Vector3>& points) {
    Eigen::MatrixX3d rows(points.size(), 3);
    for (std::size_t k = 0; k < points.size(); ++k) rows.row(k) = points[k].transpose();
    return rows;
}

template <class Patch>
FitReport calcReport(const Patch& patch, const std::vector<Vector2>& uv, const std::vector<Vector3>& points,
                     int numUnknowns) {
    FitReport report;
    report.numUnknowns = numUnknowns;
    for (std::size_t k = 0; k < points.size(); ++k)
        report.residuals.push_back((patch.calcParametric(uv[k], 0).x - points[k]).norm());
    report.sumUp();
    return report;
}

PolynomialFit fitPolynomial(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int orderU, int orderV,
                            PolynomialTerms terms, const ParameterDomain& domain, bool isHeightPatch,
                            double normalSign) {
    checkCloud(uv, points);
    require(std::min(orderU, orderV) >= 1 && std::max(orderU, orderV) <= PolynomialPatch::kMaxOrder,
            "patch fit: orders must be in [1, ", int(PolynomialPatch::kMaxOrder), "], but are ", orderU, " and ",
            orderV);
    std::vector<int> columns;  // of the coefficient matrix that are fitted
    for (int i = 0; i <= orderU; ++i)
        for (int j = 0; j <= orderV; ++j)
            if (terms == PolynomialTerms::Tensor || i + j <= std::max(orderU, orderV))
                columns.push_back(i * (orderV + 1) + j);
    const Eigen::Index count = static_cast<Eigen::Index>(columns.size()),
                       numPoints = static_cast<Eigen::Index>(uv.size());
    require(numPoints >= count, "patch fit: ", numPoints, " points for ", count, " polynomial terms");
    const Vector2 middle = 0.5 * (domain.min + domain.max), half = 0.5 * (domain.max - domain.min);
    Eigen::MatrixXd design(numPoints, count);
    for (Eigen::Index k = 0; k < numPoints; ++k) {
        const Vector2 s = (uv[k] - middle).cwiseQuotient(half);
        for (Eigen::Index c = 0; c < count; ++c)
            design(k, c) = std::pow(s[0], columns[c] / (orderV + 1)) * std::pow(s[1], columns[c] % (orderV + 1));
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
    require(qr.rank() == count, "patch fit: the points determine only ", qr.rank(), " of ", count, " polynomial terms");
    const Eigen::MatrixX3d solution = qr.solve(stack(points));
    Eigen::Matrix3Xd coefficients = Eigen::Matrix3Xd::Zero(3, (orderU + 1) * (orderV + 1));
    for (Eigen::Index c = 0; c < count; ++c) coefficients.col(columns[c]) = solution.row(c).transpose();
    PolynomialPatch patch(domain, orderU, orderV, coefficients, isHeightPatch, normalSign);
    FitReport report = calcReport(patch, uv, points, static_cast<int>(count));
    return {std::move(patch), std::move(report)};
}

BSplineFit fitBSpline(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int numU, int numV,
                      const ParameterDomain& domain, bool isHeightPatch, double normalSign) {
    checkCloud(uv, points);
    require(numU >= 4 && numV >= 4, "patch fit: needs at least 4 control points in each direction, got ", numU, " by ",
            numV);
    Eigen::MatrixXd design = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(uv.size()), Eigen::Index(numU) * numV);
    for (std::size_t k = 0; k < uv.size(); ++k) {
        const auto inU = BSplinePatch::calcBasis(uv[k][0], domain.min[0], domain.max[0], numU);
        const auto inV = BSplinePatch::calcBasis(uv[k][1], domain.min[1], domain.max[1], numV);
        for (int i = 0; i < 4; ++i)
            design.row(k).segment<4>((inU.first + i) * numV + inV.first) = inU.value(0, i) * inV.value.row(0);
    }
    const Eigen::Matrix3Xd controls = design.completeOrthogonalDecomposition().solve(stack(points)).transpose();
    // x = u, y = v exactly, also where the data leave gaps.
    const Eigen::RowVectorXd heights = controls.row(2);
    BSplinePatch patch = isHeightPatch
                             ? BSplinePatch::makeHeightPatch(
                                   domain, Eigen::MatrixXd(heights.reshaped<Eigen::RowMajor>(numU, numV)), normalSign)
                             : BSplinePatch(domain, numU, numV, controls, false, normalSign);
    FitReport report = calcReport(patch, uv, points, numU * numV);
    return {std::move(patch), std::move(report)};
}

double findMedian(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

/** @param fit   of points, to a patch of heights */
template <class Fit>
auto fitRobustly(const std::vector<Vector3>& points, std::vector<int>* keptNumbers, Fit&& fit) {
    constexpr int kMostRounds = 50;       // the points that are left mostly stay the same after five
    constexpr double kDeviations = 3.5;   // of a normal distribution one point in 2000 is farther out
    constexpr double kOfMedian = 1.4826;  // standard deviation of a normal distribution over its median residual
    constexpr double kRounding = 1e-9;    // of the domain's diagonal: less is no deviation
    std::vector<int> kept(points.size()), next;
    std::iota(kept.begin(), kept.end(), 0);
    for (int round = 0;; ++round) {
        std::vector<Vector3> used;
        for (const int i : kept) used.push_back(points[static_cast<std::size_t>(i)]);
        auto result = fit(used);
        const FitReport all = calcReport(result.patch, takeHeads(points), points, 0);
        const ParameterDomain& domain = result.patch.getDomain();
        const double limit =
            std::max(kDeviations * kOfMedian * findMedian(all.residuals), kRounding * (domain.max - domain.min).norm());
        next.clear();
        for (std::size_t i = 0; i < points.size(); ++i)
            if (all.residuals[i] <= limit) next.push_back(static_cast<int>(i));
        if (next == kept || round == kMostRounds) {
            result.report.leftOut = static_cast<int>(points.size() - kept.size());
            if (keptNumbers) *keptNumbers = std::move(kept);
            return result;
        }
        kept.swap(next);
    }
}

}  // namespace

ParameterDomain findDomain(const std::vector<Vector2>& uv) {
    require(!uv.empty(), "patch fit: needs points");
    ParameterDomain domain{uv.front(), uv.front()};
    for (const Vector2& at : uv) domain.min = domain.min.cwiseMin(at), domain.max = domain.max.cwiseMax(at);
    return domain;
}

PolynomialFit fitPolynomialPatch(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int orderU,
                                 int orderV, PolynomialTerms terms, const ParameterDomain& domain, double normalSign) {
    return fitPolynomial(uv, points, orderU, orderV, terms, domain, false, normalSign);
}

/** x and y are polynomials of order 1 in u = x, v = y, so the fit of all three components is that of z. */
PolynomialFit fitPolynomialHeights(const std::vector<Vector3>& points, int orderU, int orderV, PolynomialTerms terms,
                                   double normalSign) {
    const std::vector<Vector2> uv = takeHeads(points);
    return fitPolynomial(uv, points, orderU, orderV, terms, findDomain(uv), true, normalSign);
}

PolynomialFit fitPolynomialHeightsRobustly(const std::vector<Vector3>& points, int orderU, int orderV,
                                           PolynomialTerms terms, std::vector<int>* kept) {
    return fitRobustly(points, kept, [&](const std::vector<Vector3>& used) {
        return fitPolynomialHeights(used, orderU, orderV, terms);
    });
}

BSplineFit fitBSplineHeightsRobustly(const std::vector<Vector3>& points, int numU, int numV, std::vector<int>* kept) {
    return fitRobustly(points, kept,
                       [&](const std::vector<Vector3>& used) { return fitBSplineHeights(used, numU, numV); });
}

BSplineFit fitBSplinePatch(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int numU, int numV,
                           const ParameterDomain& domain, double normalSign) {
    return fitBSpline(uv, points, numU, numV, domain, false, normalSign);
}

BSplineFit fitBSplineHeights(const std::vector<Vector3>& points, int numU, int numV, double normalSign) {
    const std::vector<Vector2> uv = takeHeads(points);
    return fitBSpline(uv, points, numU, numV, findDomain(uv), true, normalSign);
}

}  // namespace tautline
