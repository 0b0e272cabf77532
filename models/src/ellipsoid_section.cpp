// SPDX-License-Identifier: Apache-2.0
#include "ellipsoid_section.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>

#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/elliptic_cylinder.h"

namespace tautline::models {
namespace {

/** The point of an ellipsoid sum (x_i/a_i)^2 = 1 nearest to a point inside it: x_i = a_i^2 p_i/(a_i^2 + t) with the
root t in (-min a^2, 0], found by bisection. */
Vector3 findNearestPoint(const Vector3& semiAxes, const Vector3& p) {
    constexpr int kHalvings = 200;
    const Vector3 squares = semiAxes.cwiseAbs2();
    const auto calcPoint = [&](double t) { return Vector3(squares.array() * p.array() / (squares.array() + t)); };
    double low = -squares.minCoeff(), high = 0;
    for (int i = 0; i < kHalvings; ++i) {
        const double t = 0.5 * (low + high);
        const bool isOutside = calcPoint(t).cwiseQuotient(semiAxes).squaredNorm() > 1;
        (isOutside ? low : high) = t;
    }
    return calcPoint(high);
}

/** The middle of the part of a line that lies in an ellipsoid. */
std::optional<Vector3> findChordMiddle(const Vector3& semiAxes, const Vector3& A, const Vector3& B) {
    const Vector3 a = A.cwiseQuotient(semiAxes), d = (B - A).cwiseQuotient(semiAxes);
    const double share = -a.dot(d) / d.squaredNorm();
    const double excess = (a + share * d).squaredNorm() - 1;
    if (!(excess < 0) || !(share > 0 && share < 1)) return {};
    return Vector3(A + share * (B - A));
}

}  // namespace

std::optional<double> calcSectionLength(const Vector3& semiAxes, const Vector3& A, const Vector3& B) {
    const std::optional<Vector3> middle = findChordMiddle(semiAxes, A, B);
    if (!middle) return {};
    const Vector3 C = findNearestPoint(semiAxes, *middle);
    const Vector3 normal = (B - A).cross(C - A);
    if (!(normal.norm() > 0)) return {};
    const Vector3 n = normal.normalized(), squares = semiAxes.cwiseAbs2();
    // The ellipse x^T M x = 1, M = diag(1/a^2), n.x = d has the center d M^-1 n/(n^T M^-1 n).
    const double d = n.dot(C), nMn = n.dot(squares.cwiseProduct(n)), scale = 1 - d * d / nMn;
    if (!(scale > 0)) return {};
    const Vector3 center = d / nMn * squares.cwiseProduct(n);
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = n.unitOrthogonal();
    basis.col(1) = n.cross(basis.col(0));
    const Eigen::Matrix2d inPlane = basis.transpose() * squares.cwiseInverse().asDiagonal() * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(inPlane);
    const Eigen::Matrix<double, 3, 2> axes = basis * solver.eigenvectors();
    const Vector2 sectionAxes = (scale * solver.eigenvalues().cwiseInverse()).cwiseSqrt();
    const auto toPlane = [&](const Vector3& point) {
        const Vector2 in = axes.transpose() * (point - center);
        return Vector3(in[0], in[1], 0);
    };
    PathProblem problem;
    problem.addPoint("A");
    problem.addObstacle("section", std::make_shared<EllipticCylinder>(sectionAxes[0], sectionAxes[1]),
                        PassNear{toPlane(C)});
    problem.addPoint("B");
    PathPose pose;
    pose.X_GE = {Pose(toPlane(A)), Pose(Vector3::Zero()), Pose(toPlane(B))};
    const PathSolution path = solvePath(problem, pose);
    if (path.status != PathStatus::Solved) return {};
    return path.length;
}

}  // namespace tautline::models
