// SPDX-License-Identifier: Apache-2.0
/** Symmetric block-tridiagonal factorization against dense algebra. */
#include "paths/equations/block_ldlt.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/random.h"

namespace tautline::testing {
namespace {

constexpr int k = BlockLdlt::k;

/** Random symmetric blocks, indefinite. @return the whole matrix */
Eigen::MatrixXd fillRandomly(BlockLdlt& matrix, int numBlocks, Random& random) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(k * numBlocks, k * numBlocks);
    matrix.reset(numBlocks);
    for (int i = 0; i < numBlocks; ++i) {
        BlockLdlt::Block own, next;
        for (double& x : own.reshaped()) x = random.uniform(-1, 1);
        for (double& x : next.reshaped()) x = random.uniform(-1, 1);
        own = (own + own.transpose()).eval();
        dense.block<k, k>(k * i, k * i) = own;
        matrix.updDiagonal(i) = own;
        if (i + 1 == numBlocks) break;
        dense.block<k, k>(k * i, k * (i + 1)) = next;
        dense.block<k, k>(k * (i + 1), k * i) = next.transpose();
        matrix.updCoupling(i) = next;
    }
    return dense;
}

TEST(BlockLdlt, SolvesWhatDenseAlgebraSolves) {
    Random random(81);
    for (const int numBlocks : {1, 2, 3, 10}) {
        SCOPED_TRACE(numBlocks);
        BlockLdlt matrix;
        const Eigen::MatrixXd dense = fillRandomly(matrix, numBlocks, random);
        std::vector<double> b(k * numBlocks);
        for (double& entry : b) entry = random.uniform(-1, 1);
        const Eigen::VectorXd right = Eigen::Map<Eigen::VectorXd>(b.data(), b.size());
        ASSERT_TRUE(matrix.factor());
        matrix.solveInPlace(b);
        const Eigen::Map<Eigen::VectorXd> x(b.data(), b.size());
        // The pivots stay within their blocks, so that a block near singular costs digits.
        EXPECT_LT((dense * x - right).norm(), 1e-11 * dense.norm() * (1 + x.norm()));
    }
}

TEST(BlockLdlt, CountsNegativeEigenvalues) {
    Random random(82);
    for (int trial = 0; trial < 50; ++trial) {
        BlockLdlt matrix;
        Eigen::MatrixXd dense = fillRandomly(matrix, 1 + trial % 5, random);
        const double shift = random.uniform(-3, 3);  // from nearly all negative to nearly all positive
        for (int i = 0; i < matrix.getNumBlocks(); ++i) matrix.updDiagonal(i).diagonal().array() += shift;
        dense.diagonal().array() += shift;
        ASSERT_TRUE(matrix.factor());
        const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
        EXPECT_EQ(matrix.getNumNegative(), (eigenvalues.array() < 0).count()) << "trial " << trial;
    }
}

TEST(BlockLdlt, SaddleMatrixHasOneNegativeEigenvalueForEachCondition) {
    // [1 0 1; 0 1 1; 1 1 0]-like: identity on four unknowns, two conditions on their sums.
    BlockLdlt matrix;
    matrix.reset(1);
    Eigen::Map<BlockLdlt::Block> own = matrix.updDiagonal(0);
    own.topLeftCorner<4, 4>().setIdentity();
    own.bottomLeftCorner<2, 4>() << 1, 1, 0, 0, 0, 0, 1, 1;
    ASSERT_TRUE(matrix.factor());
    EXPECT_EQ(matrix.getNumNegative(), 2);
}

TEST(BlockLdlt, SingularOrNotFiniteIsAResult) {
    BlockLdlt matrix;
    matrix.reset(2);
    matrix.updDiagonal(0).setIdentity();
    EXPECT_FALSE(matrix.factor());  // the second block is zero
    matrix.reset(1);
    matrix.updDiagonal(0).setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(matrix.factor());
}

TEST(BlockLdlt, NoBlocksHaveASolution) {
    BlockLdlt matrix;
    matrix.reset(0);
    std::vector<double> b;
    EXPECT_TRUE(matrix.factor());
    matrix.solveInPlace(b);
    EXPECT_EQ(matrix.getNumNegative(), 0);
}

}  // namespace
}  // namespace tautline::testing
