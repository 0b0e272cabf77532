// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/polynomial_patch.h"

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ParametricShape<PolynomialPatch>;

namespace {

/** Row k: k-th derivatives of 1, s, s^2, ... by the plain coordinate, ds/du = slope. */
void calcPowers(double s, double slope, int order, Eigen::Matrix<double, 3, PolynomialPatch::kMaxOrder + 1>& powers) {
    powers.col(0) = Vector3(1, 0, 0);
    for (int i = 1; i <= order; ++i) {
        powers(0, i) = s * powers(0, i - 1);
        powers(1, i) = i * slope * powers(0, i - 1);
        powers(2, i) = i * slope * powers(1, i - 1);
    }
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
    requirePatch(domain, coefficients, (orderU + 1) * (orderV + 1), normalSign, "polynomial patch");
    measure();
}

PolynomialPatch PolynomialPatch::makeHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& p,
                                                 double normalSign) {
    const int n = static_cast<int>(p.rows()) - 1, m = static_cast<int>(p.cols()) - 1;
    require(n >= 1 && m >= 1, "polynomial patch: needs orders of at least 1, got ", n, " and ", m);
    const Vector2 middle = 0.5 * (domain.min + domain.max), half = 0.5 * (domain.max - domain.min);
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
    return makeScaledHeightPatch(domain, scaled, normalSign);
}

PolynomialPatch PolynomialPatch::makeScaledHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& p,
                                                       double normalSign) {
    const int n = static_cast<int>(p.rows()) - 1, m = static_cast<int>(p.cols()) - 1;
    require(n >= 1 && m >= 1, "polynomial patch: needs orders of at least 1, got ", n, " and ", m);
    const Vector2 middle = 0.5 * (domain.min + domain.max), half = 0.5 * (domain.max - domain.min);
    Eigen::Matrix3Xd coefficients = Eigen::Matrix3Xd::Zero(3, (n + 1) * (m + 1));
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) coefficients(2, i * (m + 1) + j) = p(i, j);
    coefficients(0, 0) = middle[0], coefficients(0, m + 1) = half[0];
    coefficients(1, 0) = middle[1], coefficients(1, 1) = half[1];
    return PolynomialPatch(domain, n, m, coefficients, true, normalSign);
}

std::string PolynomialPatch::getDescription() const {
    return describeShape("polynomial patch(orders=", m_orderU, ", ", m_orderV, ")");
}

void PolynomialPatch::calcPartials(const Vector2& uv, PatchPartials& partials) const {
    Eigen::Matrix<double, 3, kMaxOrder + 1> powersU, powersV;
    const Vector2 s = (uv - m_middle).cwiseProduct(m_inverseHalf);
    calcPowers(s[0], m_inverseHalf[0], m_orderU, powersU);
    calcPowers(s[1], m_inverseHalf[1], m_orderV, powersV);
    partials.setZero();
    for (int i = 0; i <= m_orderU; ++i) {
        Matrix3 inV = Matrix3::Zero();  // column l: l-th derivative by v of the coefficient of u^i
        for (int j = 0; j <= m_orderV; ++j)
            inV += m_coefficients.col(i * (m_orderV + 1) + j) * powersV.col(j).transpose();
        for (int k = 0; k < 3; ++k) partials.middleCols<3>(3 * k) += powersU(k, i) * inV;
    }
}

}  // namespace tautline
