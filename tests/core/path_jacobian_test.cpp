// SPDX-License-Identifier: Apache-2.0
/** Elimination of the path error's Jacobian against dense algebra. */
#include "paths/equations/path_jacobian.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/random.h"

namespace tautline::testing {
namespace {

/** The columns on which rows of contact `row / 4` depend, as path_error.h derives them. */
bool isCoupled(int row, int col) {
    const int first = row / 4 * 4;
    return row % 4 < 2 ? col >= first - 4 && col < first + 3 : col >= first && col < first + 6;
}

/** Random numbers without a strong diagonal: pivoting has work to do. `ends`: contacts that a fixed point follows. */
Eigen::MatrixXd fillRandomly(PathJacobian& jacobian, int contacts, Random& random, const std::vector<int>& ends = {}) {
    const int size = 4 * contacts;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    jacobian.reset(size);
    for (int row = 0; row < size; ++row)
        for (int col = 0; col < size; ++col) {
            bool isApart = false;
            for (int end : ends) isApart = isApart || (row / 4 <= end) != (col / 4 <= end);
            if (isCoupled(row, col) && !isApart) dense(row, col) = jacobian.upd(row, col) = random.uniform(-1, 1);
        }
    return dense;
}

std::vector<double> makeRightHandSide(int size, Random& random) {
    std::vector<double> b(size);
    for (double& x : b) x = random.uniform(-1, 1);
    return b;
}

/** Backward error |A x - b| / (|A| |x|): some ulp for each of `size` eliminations, whatever the condition. */
void expectSolved(PathJacobian& jacobian, const Eigen::MatrixXd& dense, const std::vector<double>& b) {
    std::vector<double> x = b;
    ASSERT_TRUE(jacobian.solveInPlace(x));
    const Eigen::Map<const Eigen::VectorXd> xMap(x.data(), x.size()), bMap(b.data(), b.size());
    EXPECT_LT((dense * xMap - bMap).norm(), 1e-15 * (10 + b.size()) * dense.norm() * (1 + xMap.norm()));
}

TEST(PathJacobian, EqualsDense) {
    Random random(81);
    for (int contacts : {1, 2, 3, 10, 40})
        for (int i = 0; i < 10; ++i) {
            SCOPED_TRACE(std::to_string(contacts) + " contacts, matrix " + std::to_string(i));
            PathJacobian jacobian;
            const Eigen::MatrixXd dense = fillRandomly(jacobian, contacts, random);
            EXPECT_EQ(jacobian.getSize(), 4 * contacts);
            const std::vector<double> b = makeRightHandSide(4 * contacts, random);
            std::vector<double> x = b;
            ASSERT_TRUE(jacobian.solveInPlace(x));
            const Eigen::VectorXd truth =
                dense.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
            const double condition = dense.norm() * dense.inverse().norm();
            for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], truth[k], 1e-14 * condition * truth.norm());
        }
}

TEST(PathJacobian, FixedPointsBetweenContactsDecouple) {
    Random random(82);
    PathJacobian jacobian;
    for (const std::vector<int>& ends : {std::vector<int>{0}, {1}, {0, 1, 2}, {2, 4}})
        for (int i = 0; i < 10; ++i) {
            const Eigen::MatrixXd dense = fillRandomly(jacobian, 6, random, ends);
            expectSolved(jacobian, dense, makeRightHandSide(24, random));
        }
}

TEST(PathJacobian, StoresWhatIsWritten) {
    Random random(83);
    PathJacobian jacobian;
    const Eigen::MatrixXd dense = fillRandomly(jacobian, 5, random);
    for (int row = 0; row < 20; ++row)
        for (int col = 0; col < 20; ++col) {
            EXPECT_EQ(jacobian.get(row, col), dense(row, col));
            EXPECT_TRUE(jacobian.isInBand(row, col) || !isCoupled(row, col)) << row << ", " << col;
        }
}

TEST(PathJacobian, ReusedStorageKeepsNothingOfTheLastMatrix) {
    Random random(84);
    PathJacobian jacobian;
    for (int contacts : {6, 1, 10, 1, 6, 10}) {
        const Eigen::MatrixXd dense = fillRandomly(jacobian, contacts, random);
        expectSolved(jacobian, dense, makeRightHandSide(4 * contacts, random));
        jacobian.reset(4 * contacts);
        for (int row = 0; row < 4 * contacts; ++row)
            for (int col = 0; col < 4 * contacts; ++col) ASSERT_EQ(jacobian.get(row, col), 0);
    }
}

TEST(PathJacobian, EmptyMatrixHasNothingToSolve) {
    PathJacobian jacobian;
    jacobian.reset(0);
    std::vector<double> x;
    EXPECT_TRUE(jacobian.solveInPlace(x));
}

TEST(PathJacobian, ZeroDiagonalIsPivoted) {
    PathJacobian jacobian;
    jacobian.reset(4);
    jacobian.upd(0, 1) = 2, jacobian.upd(1, 2) = 4, jacobian.upd(2, 3) = 8, jacobian.upd(3, 0) = 16;
    std::vector<double> x = {2, 8, 24, 64};
    ASSERT_TRUE(jacobian.solveInPlace(x));
    EXPECT_EQ(x, (std::vector<double>{4, 1, 2, 3}));
}

TEST(PathJacobian, SingularMatrixIsReported) {
    Random random(86);
    for (int empty : {0, 5, 6, 11}) {  // a row of zeros, first, inside, last
        PathJacobian jacobian;
        fillRandomly(jacobian, 3, random);
        for (int col = 0; col < 12; ++col)
            if (isCoupled(empty, col)) jacobian.upd(empty, col) = 0;
        std::vector<double> x = makeRightHandSide(12, random);
        EXPECT_FALSE(jacobian.solveInPlace(x)) << empty;
    }
}

TEST(PathJacobian, NotANumberIsReported) {
    Random random(87);
    PathJacobian jacobian;
    for (const auto& [row, col] : {std::pair(0, 0), {3, 4}, {5, 2}, {7, 7}}) {
        fillRandomly(jacobian, 2, random);
        jacobian.upd(row, col) = kNaN;
        std::vector<double> x = makeRightHandSide(8, random);
        EXPECT_FALSE(jacobian.solveInPlace(x)) << row << ", " << col;
    }
    fillRandomly(jacobian, 2, random);
    std::vector<double> b = makeRightHandSide(8, random);
    b[7] = kInfinity;
    EXPECT_FALSE(jacobian.solveInPlace(b));
    const Eigen::MatrixXd dense = fillRandomly(jacobian, 2, random);  // and nothing of it stays
    expectSolved(jacobian, dense, makeRightHandSide(8, random));
}

}  // namespace
}  // namespace tautline::testing
