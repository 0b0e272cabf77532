// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tautline/types.h"

namespace tautline {

/** The linear map p = M q under which a surface is scaled: positive factors along any three axes, shear included. Keeps
orientation, so that normals stay outward. */
class LinearMap {
public:
    /** From the matrix M, 3 x 3, or from three factors along x, y, z of S.
    @throws InvalidInput unless M is finite, its determinant is positive, and its least singular value is no less than
    1e-6 of the largest; with factors unless each is positive and finite too */
    template <class Derived>
    LinearMap(const Eigen::MatrixBase<Derived>& matrixOrFactors) {  // implicit: scaled surfaces take either
        if constexpr (Derived::ColsAtCompileTime == 1)
            setFactors(matrixOrFactors);
        else
            setMatrix(matrixOrFactors);
    }

    const Matrix3& getMatrix() const { return m_matrix; }
    const Matrix3& getInverse() const { return m_inverse; }
    /** Least singular value: the factor along the direction that is stretched least. */
    double getLeastFactor() const { return m_leastFactor; }
    std::string getDescription() const;

    // Products are written out: Eigen's are calls at -O2, and geodesics make many.
    Vector3 map(const Vector3& q) const { return multiply(m_matrix, q); }
    Vector3 mapBack(const Vector3& p) const { return multiply(m_inverse, p); }
    /** M^-T v: what a gradient becomes. */
    Vector3 mapGradient(const Vector3& v) const {
        return {m_inverse.col(0).dot(v), m_inverse.col(1).dot(v), m_inverse.col(2).dot(v)};
    }
    /** M^-T H M^-1: what a Hessian becomes. */
    Matrix3 mapHessian(const Matrix3& H) const {
        Matrix3 mapped;
        for (int j = 0; j < 3; ++j) mapped.col(j) = mapGradient(multiply(H, m_inverse.col(j)));
        return mapped;
    }

private:
    static Vector3 multiply(const Matrix3& A, const Vector3& v) {
        return v.x() * A.col(0) + v.y() * A.col(1) + v.z() * A.col(2);
    }
    void setMatrix(const Matrix3& M);
    void setFactors(const Vector3& factors);

    Matrix3 m_matrix, m_inverse;
    double m_leastFactor = 0;
};

}  // namespace tautline
