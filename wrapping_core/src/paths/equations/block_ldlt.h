// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>
#include <vector>

namespace tautline {

/** Symmetric indefinite block-tridiagonal matrix of blocks k x k,

    [ D0    E0            ]
    [ E0^T  D1    E1      ]        factored block by block:  S0 = D0,  S(i+1) = D(i+1) - Ei^T Si^-1 Ei,
    [       E1^T  D2  ... ]

each pivot block S by Bunch and Kaufman's method (LAPACK), in O(n). By Sylvester's law the inertia of the whole is the
sum of the inertias of the pivot blocks. Reuses its memory. */
class BlockLdlt {
public:
    static constexpr int k = 6;  ///< four natural corrections and two multipliers of a contact
    using Block = Eigen::Matrix<double, k, k>;

    void reset(int numBlocks);
    int getNumBlocks() const { return m_numBlocks; }
    Eigen::Map<Block> updDiagonal(int i);  ///< D_i; only its lower triangle is read
    Eigen::Map<Block> updCoupling(int i);  ///< E_i, rows of block i and columns of block i + 1

    /** Factors in place. @return false if a pivot block is exactly singular or not finite */
    bool factor();

    /** Number of negative eigenvalues, after factor(). */
    int getNumNegative() const { return m_numNegative; }

    /** Overwrites b, k numbers for each block, with the solution, after factor(). */
    void solveInPlace(std::vector<double>& b) const;

private:
    // Plain numbers, block after block: Eigen's matrices of unusual size do not bear to be instantiated after SimTK's
    // operators have been seen.
    std::vector<double> m_diagonal, m_coupling, m_ratio;  ///< m_ratio: Si^-1 Ei
    std::vector<int> m_pivots;
    int m_numBlocks = 0, m_numNegative = 0;
};

}  // namespace tautline
