// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/linear_map.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "tautline/error.h"

namespace tautline {
namespace {

/** Of singular values: a scaling of a body stays far above, and rounding of its inverse far below what paths need. */
constexpr double kLeastRatio = 1e-6;

const Eigen::IOFormat kInOneLine(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", "; ", "", "", "[", "]");

}  // namespace

void LinearMap::setFactors(const Vector3& factors) {
    for (int i = 0; i < 3; ++i)
        require(std::isfinite(factors[i]) && factors[i] > 0, "scaled surface: factor ", "xyz"[i],
                " must be positive and finite, but is ", factors[i]);
    setMatrix(factors.asDiagonal());
}

void LinearMap::setMatrix(const Matrix3& M) {
    m_matrix = M;
    require(m_matrix.allFinite(), "scaled surface: matrix must be finite, but is ", m_matrix.format(kInOneLine));
    const double determinant = m_matrix.determinant();
    require(determinant > 0, "scaled surface: determinant of the matrix must be positive, but is ", determinant);
    const Vector3 factors = Eigen::JacobiSVD<Matrix3>(m_matrix).singularValues();
    require(factors[2] >= kLeastRatio * factors[0],
            "scaled surface: least singular value of the matrix must be at least ", kLeastRatio, " of the largest, ",
            factors[0], ", but is ", factors[2]);
    m_inverse = m_matrix.inverse();
    m_leastFactor = factors[2];
}

std::string LinearMap::getDescription() const {
    std::ostringstream text;
    if (m_matrix.isDiagonal(0))
        text << "(" << m_matrix(0, 0) << ", " << m_matrix(1, 1) << ", " << m_matrix(2, 2) << ")";
    else
        text << m_matrix.format(kInOneLine);
    return text.str();
}

}  // namespace tautline
