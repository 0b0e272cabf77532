// SPDX-License-Identifier: Apache-2.0
/** Jacobian of the path error against central differences of it, on chains that mix all surfaces. */
#include "paths/equations/path_error.h"

#include <gtest/gtest.h>

#include "support/random_chain.h"

namespace tautline::testing {
namespace {

using Eigen::MatrixXd;

// S sphere, C cylinder, E ellipsoid, F flat ellipsoid, T torus, . via point
constexpr const char* kPlans[] = {"S", "C", "E", "F", "T", "SCEFT", "TT", "C.C", "S.TE..F", "ESTCFESTCF"};

TEST(PathErrorJacobian, EqualsCentralDifferences) {
    unsigned seed = 60;
    for (const char* plan : kPlans) {
        SCOPED_TRACE(plan);
        const RandomChain chain(plan, ++seed);
        const MatrixXd jacobian = chain.calcJacobian(), differences = chain.calcDifferences();
        // Relative to the largest entry of the column: one unit, one geodesic.
        for (int col = 0; col < jacobian.cols(); ++col)
            EXPECT_LT((jacobian.col(col) - differences.col(col)).cwiseAbs().maxCoeff(),
                      1e-6 * (1 + jacobian.col(col).cwiseAbs().maxCoeff()))
                << "unknown " << col;
    }
}

TEST(PathErrorJacobian, NothingStandsOutsideTheBand) {
    const MatrixXd differences = RandomChain("ESTCF", 71).calcDifferences();
    PathJacobian band;
    band.reset(static_cast<int>(differences.rows()));
    for (int row = 0; row < differences.rows(); ++row)
        for (int col = 0; col < differences.cols(); ++col)
            if (!band.isInBand(row, col)) {
                EXPECT_EQ(differences(row, col), 0) << row << ", " << col;
            }
}

TEST(PathErrorJacobian, ViaPointsDecoupleTheirNeighbors) {
    const RandomChain chain("SE.TC", 72);
    for (const MatrixXd& jacobian : {chain.calcJacobian(), chain.calcDifferences()}) {
        EXPECT_EQ(jacobian.block(8, 0, 8, 8).norm(), 0);
        EXPECT_EQ(jacobian.block(0, 8, 8, 8).norm(), 0);
        EXPECT_GT(jacobian.block(4, 0, 4, 4).norm(), 0);  // which neighbors without one are not
    }
}

TEST(PathError, RowsAreProjectionsOfTheSegmentsOnTheEndFrames) {  // Eqn. 4.3
    const Chain chain = RandomChain("TS", 73).getChain();
    std::vector<double> eps;
    const double largest = calcPathError(chain, eps);
    ASSERT_EQ(eps.size(), 8u);
    const ChainContact& second = chain.contacts[1];
    const Vector3 e = (second.P.x - chain.contacts[0].Q.x).normalized();
    EXPECT_NEAR(eps[2], e.dot(chain.contacts[0].Q.N), 1e-15);
    EXPECT_NEAR(eps[3], e.dot(chain.contacts[0].Q.B), 1e-15);
    EXPECT_NEAR(eps[4], e.dot(second.P.N), 1e-15);
    EXPECT_NEAR(eps[5], e.dot(second.P.B), 1e-15);
    double truth = 0;
    for (double x : eps) truth = std::max(truth, std::abs(x));
    EXPECT_EQ(largest, truth);
}

TEST(PathError, LengthSumsSegmentsAndSignedArcs) {
    const Chain chain = RandomChain("ET.C", 74).getChain();
    double length = 0;
    for (const ChainSegment& s : chain.segments) length += (s.line.B - s.line.A).norm();
    for (const ChainContact& c : chain.contacts) length += c.start.length;
    EXPECT_NEAR(calcLength(chain), length, 1e-14 * std::abs(length));
    EXPECT_EQ(chain.segments.size(), 5u);
}

TEST(PathError, ChainOfPointsHasNoError) {
    const RandomChain chain(".", 75);
    std::vector<double> eps(3, 1.0);
    EXPECT_EQ(calcPathError(chain.getChain(), eps), 0);
    EXPECT_TRUE(eps.empty());
}

}  // namespace
}  // namespace tautline::testing
