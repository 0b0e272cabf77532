// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/bspline_patch.h"

#include <Eigen/LU>
#include <algorithm>

#include "surfaces/cubic_bspline.h"
#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ParametricShape<BSplinePatch>;

namespace {

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

BSplinePatch::BSplinePatch(const ParameterDomain& domain, int numU, int numV, const Eigen::Matrix3Xd& controlPoints,
                           bool isHeightPatch, double normalSign)
    : PatchShape(domain, isHeightPatch, normalSign), m_numU(numU), m_numV(numV), m_controlPoints(controlPoints) {
    require(numU >= 4, "B-spline patch: needs at least 4 control points in u, got ", numU);
    require(numV >= 4, "B-spline patch: needs at least 4 control points in v, got ", numV);
    requirePatch(domain, controlPoints, Eigen::Index(numU) * numV, normalSign, "B-spline patch");
    measure();
}

BSplinePatch BSplinePatch::interpolate(const ParameterDomain& domain, int numU, int numV,
                                       const Eigen::Matrix3Xd& points, bool isHeightPatch, double normalSign) {
    require(numU >= 4 && numV >= 4, "B-spline patch: a grid needs at least 4 points in each direction, got ", numU,
            " by ", numV);
    requirePatch(domain, points, Eigen::Index(numU) * numV, normalSign, "B-spline patch");
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
            const Vector2 at(numU > 1 ? i / (numU - 1.0) : 0, numV > 1 ? j / (numV - 1.0) : 0);
            const Vector2 uv = domain.min + at.cwiseProduct(domain.max - domain.min);
            points.col(i * numV + j) = Vector3(uv[0], uv[1], heights(i, j));
        }
    return interpolate(domain, numU, numV, points, true, normalSign);
}

/** x = u and y = v where the control points lie at the Greville abscissae, equal steps beyond the domain included. */
BSplinePatch BSplinePatch::makeHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& heights,
                                           double normalSign) {
    const int numU = static_cast<int>(heights.rows()), numV = static_cast<int>(heights.cols());
    require(numU >= 4 && numV >= 4, "B-spline patch: needs at least 4 control points in each direction, got ", numU,
            " by ", numV);
    const Vector2 cell = (domain.max - domain.min).cwiseQuotient(Vector2(numU - 3, numV - 3));
    Eigen::Matrix3Xd controls(3, numU * numV);
    for (int i = 0; i < numU; ++i)
        for (int j = 0; j < numV; ++j) {
            const Vector2 uv = domain.min + cell.cwiseProduct(Vector2(i - 1, j - 1));
            controls.col(i * numV + j) = Vector3(uv[0], uv[1], heights(i, j));
        }
    return BSplinePatch(domain, numU, numV, controls, true, normalSign);
}

std::string BSplinePatch::getDescription() const {
    return describeShape("B-spline patch(", m_numU, " x ", m_numV, " control points)");
}

BSplinePatch::Basis BSplinePatch::calcBasis(double coordinate, double min, double max, int numControls) {
    const int cells = numControls - 3;
    const double inverse = cells / (max - min), s = (coordinate - min) * inverse;
    const double inside = s > 0 ? std::min(s, double(cells)) : 0;  // NaN: 0
    const int cell = std::min(static_cast<int>(inside), cells - 1);
    Basis basis;
    basis.first = cell;
    basis.value = calcCubicBSplines(inside - cell);
    basis.value.row(1) *= inverse;
    basis.value.row(2) *= inverse * inverse;
    return basis;
}

void BSplinePatch::calcPartials(const Vector2& uv, PatchPartials& partials) const {
    const ParameterDomain& domain = getDomain();
    const Basis inU = calcBasis(uv[0], domain.min[0], domain.max[0], m_numU);
    const Basis inV = calcBasis(uv[1], domain.min[1], domain.max[1], m_numV);
    partials.setZero();
    for (int i = 0; i < 4; ++i) {
        const Matrix3 row = m_controlPoints.middleCols<4>((inU.first + i) * m_numV + inV.first) * inV.value.transpose();
        for (int k = 0; k < 3; ++k) partials.middleCols<3>(3 * k) += inU.value(k, i) * row;
    }
}

}  // namespace tautline
