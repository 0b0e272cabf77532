// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <vector>

#include "tautline/types.h"

namespace tautline {

/** Jacobian of the path error of a chain (path_error.h), its linear equations solved by elimination.

Rows 4i, 4i + 1 (the start P of contact i) depend on the unknowns of contact i - 1 and on the first three of contact i;
rows 4i + 2, 4i + 3 (its end Q) on those of contact i and on the first two of contact i + 1. So row r stores columns
findFirstColumn(r) to findFirstColumn(r) + 6; all others are zero. Rows 4i + 2 to 4i + 5 begin at the same column: one
stage of the elimination, without fill-in. Reuses its memory: no allocation once it has been this large. */
class PathJacobian {
public:
    /** Sets the number of rows, four for each contact, and clears all entries. */
    void reset(int size);
    int getSize() const { return m_size; }

    /** True where an entry may differ from zero. */
    bool isInBand(int row, int col) const {
        const int offset = col - findFirstColumn(row);
        return offset >= 0 && offset < kStoredColumns && col >= 0 && col < m_size;
    }
    double get(int row, int col) const { return isInBand(row, col) ? m_rows[row][col - findFirstColumn(row)] : 0; }

    /** Entry (row, col), which must be in the band. */
    double& upd(int row, int col) { return m_rows[row][col - findFirstColumn(row)]; }

    /** The stored entries of a row, to be filled; of rows of an end P the own contact's columns begin at kOwnColumns.
     */
    double* updRow(int row) { return m_rows[row].data(); }
    static constexpr int kOwnColumns = 4;

    /** Overwrites `rightHandSide` (length size) with the solution, by Gaussian elimination with partial pivoting.
    @return false if a pivot is zero or the result is not finite; then neither matrix nor right-hand side may be used,
            as the matrix after any solve */
    bool solveInPlace(std::vector<double>& rightHandSide);

private:
    static constexpr int kStoredColumns = 7;
    using Row = Eigen::Matrix<double, kStoredColumns + 1, 1>;  ///< entries, and last the right-hand side

    static int findFirstColumn(int row) { return ((row + 2) & ~3) - 4; }
    bool eliminate();
    template <int column>
    static bool eliminateColumn(Row* rows);

    int m_size = 0;
    std::vector<Row> m_rows;  ///< by row of the matrix, and two of zeros that complete the last stage
};

}  // namespace tautline
