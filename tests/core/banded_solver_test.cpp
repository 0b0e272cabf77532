/** The band solver against dense algebra. */
#include "tautline/banded_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/random.h"

namespace tautline::testing {
namespace {

/** Fills the band with random numbers, without a strong diagonal: pivoting has work to do. */
Eigen::MatrixXd fillRandomly(BandedSolver& band, int size, Random& random) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    band.reset(size);
    for (int row = 0; row < size; ++row)
        for (int col = 0; col < size; ++col)
            if (band.isInBand(row, col)) dense(row, col) = band.upd(row, col) = random.uniform(-1, 1);
    return dense;
}

std::vector<double> makeRightHandSide(int size, Random& random) {
    std::vector<double> b(size);
    for (double& x : b) x = random.uniform(-1, 1);
    return b;
}

/** Backward error |A x - b| / (|A| |x|): some ulp for each of `size` eliminations, whatever the condition. */
void expectSolved(BandedSolver& band, const Eigen::MatrixXd& dense, const std::vector<double>& b) {
    std::vector<double> x = b;
    ASSERT_TRUE(band.solveInPlace(x));
    const Eigen::Map<const Eigen::VectorXd> xMap(x.data(), x.size()), bMap(b.data(), b.size());
    EXPECT_LT((dense * xMap - bMap).norm(), 1e-15 * (10 + b.size()) * dense.norm() * (1 + xMap.norm()));
}

TEST(BandedSolver, EqualsDenseOverSizesAndBandwidths) {
    Random random(51);
    for (int kl : {0, 1, 2, 5})
        for (int ku : {0, 1, 3, 5})
            for (int size : {1, 2, 4, 5, 11, 12, 40}) {
                SCOPED_TRACE("kl " + std::to_string(kl) + " ku " + std::to_string(ku) + " size " +
                             std::to_string(size));
                BandedSolver band(kl, ku);
                const Eigen::MatrixXd dense = fillRandomly(band, size, random);
                EXPECT_EQ(band.getSize(), size);
                const std::vector<double> b = makeRightHandSide(size, random);
                std::vector<double> x = b;
                ASSERT_TRUE(band.solveInPlace(x));
                const Eigen::VectorXd truth =
                    dense.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), size));
                const double condition = dense.norm() * dense.inverse().norm();
                for (int i = 0; i < size; ++i) EXPECT_NEAR(x[i], truth[i], 1e-14 * condition * truth.norm());
            }
}

TEST(BandedSolver, StoresWhatIsWritten) {
    Random random(52);
    BandedSolver band(2, 3);
    const Eigen::MatrixXd dense = fillRandomly(band, 9, random);
    for (int row = 0; row < 9; ++row)
        for (int col = 0; col < 9; ++col) {
            EXPECT_EQ(band.isInBand(row, col), row - col <= 2 && col - row <= 3);
            const double stored = band.isInBand(row, col) ? band.get(row, col) : 0;
            EXPECT_EQ(stored, dense(row, col));
        }
}

TEST(BandedSolver, ReusedStorageKeepsNothingOfTheLastMatrix) {
    Random random(53);
    BandedSolver band(5, 5);
    for (int size : {24, 3, 40, 1, 24, 40}) {
        const Eigen::MatrixXd dense = fillRandomly(band, size, random);
        expectSolved(band, dense, makeRightHandSide(size, random));
        band.reset(size);
        for (int row = 0; row < size; ++row)
            for (int col = 0; col < size; ++col) ASSERT_EQ(band.isInBand(row, col) ? band.get(row, col) : 0, 0);
    }
}

TEST(BandedSolver, ZeroDiagonalIsPivoted) {
    BandedSolver band(1, 1);
    band.reset(2);
    band.upd(0, 1) = 2, band.upd(1, 0) = 4;
    std::vector<double> x = {6, 8};
    ASSERT_TRUE(band.solveInPlace(x));
    EXPECT_EQ(x[0], 2);
    EXPECT_EQ(x[1], 3);
}

TEST(BandedSolver, SingularMatrixIsReported) {
    Random random(54);
    for (int empty : {0, 5, 11}) {  // a row of zeros, first, inside, last
        BandedSolver band(5, 5);
        fillRandomly(band, 12, random);
        for (int col = 0; col < 12; ++col)
            if (band.isInBand(empty, col)) band.upd(empty, col) = 0;
        std::vector<double> x = makeRightHandSide(12, random);
        EXPECT_FALSE(band.solveInPlace(x)) << empty;
    }
    BandedSolver zero(1, 1);
    zero.reset(3);
    std::vector<double> x(3, 1.0);
    EXPECT_FALSE(zero.solveInPlace(x));
}

TEST(BandedSolver, NotANumberIsReported) {
    Random random(55);
    BandedSolver band(5, 5);
    fillRandomly(band, 8, random);
    band.upd(3, 4) = kNaN;
    std::vector<double> x = makeRightHandSide(8, random);
    EXPECT_FALSE(band.solveInPlace(x));
    const Eigen::MatrixXd dense = fillRandomly(band, 8, random);
    std::vector<double> b = makeRightHandSide(8, random);
    b[7] = kInfinity;
    EXPECT_FALSE(band.solveInPlace(b));
    expectSolved(band, fillRandomly(band, 8, random), makeRightHandSide(8, random));  // and nothing of it stays
}

}  // namespace
}  // namespace tautline::testing
