#include <Eigen/LU>
#include <algorithm>

#include "shape_checks.h"
#include "tautline/bspline_patch.h"
#include "tautline/polynomial_patch.h"

namespace tautline {
namespace {

void checkPatch(const ParameterDomain& domain, const Eigen::Matrix3Xd& coefficients, Eigen::Index expected,
                double normalSign, const char* what) {
    for (int i = 0; i < 2; ++i)
        require(std::isfinite(domain.min[i]) && std::isfinite(domain.max[i]) && domain.min[i] < domain.max[i], what,
                ": domain of ", "uv"[i], " must be finite and not empty, but is [", domain.min[i], ", ", domain.max[i],
                "]");
    require(coefficients.cols() == expected, what, ": needs ", expected, " coefficient columns, got ",
            coefficients.cols());
    require(coefficients.allFinite(), what, ": all coefficients must be finite");
    require(normalSign == 1 || normalSign == -1, what, ": normal sign must be 1 or -1, but is ", normalSign);
}

/** Row k: k-th derivatives of 1, s, s^2, ... by the plain coordinate, ds/du = slope. */
void calcPowers(double s, double slope, int order, Eigen::Matrix<double, 3, PolynomialPatch::kMaxOrder + 1>& powers) {
    powers.col(0) = Vec3(1, 0, 0);
    for (int i = 1; i <= order; ++i) {
        powers(0, i) = s * powers(0, i - 1);
        powers(1, i) = i * slope * powers(0, i - 1);
        powers(2, i) = i * slope * powers(1, i - 1);
    }
}

/** Control points of the cubic spline through n values at its knots, for each column of `values` (n x k). */
Eigen::MatrixXd interpolateCurve(const Eigen::MatrixXd& values) {
    const Eigen::Index n = values.rows();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 2, n + 2), right = Eigen::MatrixXd::Zero(n + 2, values.cols());
    for (Eigen::Index k = 0; k < n; ++k) matrix.row(k).segment<3>(k) << 1.0 / 6, 4.0 / 6, 1.0 / 6;
    right.topRows(n) = values;
    // Third derivatives of the first two cells agree, and those of the last two.
    matrix.row(n).head<5>() << -1, 4, -6, 4, -1;
    matrix.row(n + 1).tail<5>() << -1, 4, -6, 4, -1;
    return matrix.partialPivLu().solve(right);
}

}  // namespace

PolynomialPatch::PolynomialPatch(const ParameterDomain& domain, int orderU, int orderV,
                                 const Eigen::Matrix3Xd& coefficients, bool isHeightPatch, double normalSign)
    : PatchShape(domain, isHeightPatch, normalSign),
      m_orderU(orderU),
      m_orderV(orderV),
      m_coefficients(coefficients),
      m_middle(0.5 * (domain.min + domain.max)),
      m_inverseHalf((0.5 * (domain.max - domain.min)).cwiseInverse()) {
    require(orderU >= 1 && orderU <= kMaxOrder, "polynomial patch: order in u must be in [1, ", int(kMaxOrder),
            "], but is ", orderU);
    require(orderV >= 1 && orderV <= kMaxOrder, "polynomial patch: order in v must be in [1, ", int(kMaxOrder),
            "], but is ", orderV);
    checkPatch(domain, coefficients, (orderU + 1) * (orderV + 1), normalSign, "polynomial patch");
    measure();
}

PolynomialPatch PolynomialPatch::makeHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& p,
                                                 double normalSign) {
    const int n = static_cast<int>(p.rows()) - 1, m = static_cast<int>(p.cols()) - 1;
    require(n >= 1 && m >= 1, "polynomial patch: needs orders of at least 1, got ", n, " and ", m);
    const Vec2 middle = 0.5 * (domain.min + domain.max), half = 0.5 * (domain.max - domain.min);
    // Row i: u^i = (middle + half s)^i in powers of s.
    const auto calcExpansion = [](int order, double a, double b) {
        Eigen::MatrixXd expansion = Eigen::MatrixXd::Zero(order + 1, order + 1);
        expansion(0, 0) = 1;
        for (int i = 1; i <= order; ++i)
            for (int k = 0; k <= i; ++k)
                expansion(i, k) = a * expansion(i - 1, k) + (k > 0 ? b * expansion(i - 1, k - 1) : 0);
        return expansion;
    };
    const Eigen::MatrixXd scaled =
        calcExpansion(n, middle[0], half[0]).transpose() * p * calcExpansion(m, middle[1], half[1]);
    Eigen::Matrix3Xd coefficients = Eigen::Matrix3Xd::Zero(3, (n + 1) * (m + 1));
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) coefficients(2, i * (m + 1) + j) = scaled(i, j);
    coefficients(0, 0) = middle[0], coefficients(0, m + 1) = half[0];
    coefficients(1, 0) = middle[1], coefficients(1, 1) = half[1];
    return PolynomialPatch(domain, n, m, coefficients, true, normalSign);
}

std::string PolynomialPatch::getDescription() const {
    return describeShape("polynomial patch(orders=", m_orderU, ", ", m_orderV, ")");
}

void PolynomialPatch::calcPartials(const Vec2& uv, PatchPartials& partials) const {
    Eigen::Matrix<double, 3, kMaxOrder + 1> powersU, powersV;
    const Vec2 s = (uv - m_middle).cwiseProduct(m_inverseHalf);
    calcPowers(s[0], m_inverseHalf[0], m_orderU, powersU);
    calcPowers(s[1], m_inverseHalf[1], m_orderV, powersV);
    partials.setZero();
    for (int i = 0; i <= m_orderU; ++i) {
        Mat3 inV = Mat3::Zero();  // column l: l-th derivative by v of the coefficient of u^i
        for (int j = 0; j <= m_orderV; ++j)
            inV += m_coefficients.col(i * (m_orderV + 1) + j) * powersV.col(j).transpose();
        for (int k = 0; k < 3; ++k) partials.middleCols<3>(3 * k) += powersU(k, i) * inV;
    }
}

BSplinePatch::BSplinePatch(const ParameterDomain& domain, int numU, int numV, const Eigen::Matrix3Xd& controlPoints,
                           bool isHeightPatch, double normalSign)
    : PatchShape(domain, isHeightPatch, normalSign), m_numU(numU), m_numV(numV), m_controlPoints(controlPoints) {
    require(numU >= 4, "B-spline patch: needs at least 4 control points in u, got ", numU);
    require(numV >= 4, "B-spline patch: needs at least 4 control points in v, got ", numV);
    checkPatch(domain, controlPoints, Eigen::Index(numU) * numV, normalSign, "B-spline patch");
    measure();
}

BSplinePatch BSplinePatch::interpolate(const ParameterDomain& domain, int numU, int numV,
                                       const Eigen::Matrix3Xd& points, bool isHeightPatch, double normalSign) {
    require(numU >= 4 && numV >= 4, "B-spline patch: a grid needs at least 4 points in each direction, got ", numU,
            " by ", numV);
    checkPatch(domain, points, Eigen::Index(numU) * numV, normalSign, "B-spline patch");
    Eigen::Matrix3Xd controls(3, (numU + 2) * (numV + 2));
    for (int c = 0; c < 3; ++c) {
        Eigen::MatrixXd grid(numU, numV);
        for (int i = 0; i < numU; ++i)
            for (int j = 0; j < numV; ++j) grid(i, j) = points(c, i * numV + j);
        const Eigen::MatrixXd inU = interpolateCurve(grid);
        const Eigen::MatrixXd inUV = interpolateCurve(inU.transpose());  // (numV + 2) x (numU + 2)
        for (int i = 0; i < numU + 2; ++i)
            for (int j = 0; j < numV + 2; ++j) controls(c, i * (numV + 2) + j) = inUV(j, i);
    }
    return BSplinePatch(domain, numU + 2, numV + 2, controls, isHeightPatch, normalSign);
}

BSplinePatch BSplinePatch::interpolateHeights(const ParameterDomain& domain, const Eigen::MatrixXd& heights,
                                              double normalSign) {
    const int numU = static_cast<int>(heights.rows()), numV = static_cast<int>(heights.cols());
    Eigen::Matrix3Xd points(3, numU * numV);
    for (int i = 0; i < numU; ++i)
        for (int j = 0; j < numV; ++j) {
            const Vec2 at(numU > 1 ? i / (numU - 1.0) : 0, numV > 1 ? j / (numV - 1.0) : 0);
            const Vec2 uv = domain.min + at.cwiseProduct(domain.max - domain.min);
            points.col(i * numV + j) = Vec3(uv[0], uv[1], heights(i, j));
        }
    return interpolate(domain, numU, numV, points, true, normalSign);
}

std::string BSplinePatch::getDescription() const {
    return describeShape("B-spline patch(", m_numU, " x ", m_numV, " control points)");
}

BSplinePatch::Basis BSplinePatch::calcBasis(double coordinate, double min, double max, int numControls) {
    const int cells = numControls - 3;
    const double inverse = cells / (max - min), s = (coordinate - min) * inverse;
    const double inside = s > 0 ? std::min(s, double(cells)) : 0;  // NaN: 0
    const int cell = std::min(static_cast<int>(inside), cells - 1);
    const double t = inside - cell, w = 1 - t;
    Basis basis;
    basis.first = cell;
    basis.value.row(0) << w * w * w / 6, ((3 * t - 6) * t * t + 4) / 6, ((3 * w - 6) * w * w + 4) / 6, t * t * t / 6;
    basis.value.row(1) << -0.5 * w * w, (1.5 * t - 2) * t, -(1.5 * w - 2) * w, 0.5 * t * t;
    basis.value.row(2) << w, 3 * t - 2, 3 * w - 2, t;
    basis.value.row(1) *= inverse;
    basis.value.row(2) *= inverse * inverse;
    return basis;
}

void BSplinePatch::calcPartials(const Vec2& uv, PatchPartials& partials) const {
    const ParameterDomain& domain = getDomain();
    const Basis inU = calcBasis(uv[0], domain.min[0], domain.max[0], m_numU);
    const Basis inV = calcBasis(uv[1], domain.min[1], domain.max[1], m_numV);
    partials.setZero();
    for (int i = 0; i < 4; ++i) {
        const Mat3 row = m_controlPoints.middleCols<4>((inU.first + i) * m_numV + inV.first) * inV.value.transpose();
        for (int k = 0; k < 3; ++k) partials.middleCols<3>(3 * k) += inU.value(k, i) * row;
    }
}

}  // namespace tautline
