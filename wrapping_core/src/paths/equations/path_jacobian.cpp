// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/path_jacobian.h"

#include <cmath>

namespace tautline {
namespace {

constexpr int kColumns = 4;    ///< that one stage eliminates: the unknowns of one contact
constexpr int kLeft = 2;       ///< rows that a stage leaves to the next one
constexpr int kRows = 6;       ///< of one stage: those left by the one before, then four new ones
constexpr int kRightHand = 7;  ///< its place in a row

}  // namespace

void PathJacobian::reset(int size) {
    m_size = size;
    m_rows.resize(size + kLeft);
    std::fill(m_rows.begin(), m_rows.end(), Row::Zero());
}

/** Takes the largest pivot of a column among the rows from the column's own on, and the column out of those below.
The pivot's place then holds its inverse. */
template <int column>
bool PathJacobian::eliminateColumn(Row* rows) {
    int best = column;
    double largest = std::abs(rows[column][column]);
    for (int i = column + 1; i < kRows; ++i) {
        const double size = std::abs(rows[i][column]);
        best = size > largest ? i : best;
        largest = size > largest ? size : largest;
    }
    if (!(largest > 0)) return false;
    if (best != column) rows[column].swap(rows[best]);
    const double inverse = 1 / rows[column][column];
    constexpr int kFrom = column & ~1;  // whole pairs
    constexpr int kCount = Row::SizeAtCompileTime - kFrom;
    for (int i = column + 1; i < kRows; ++i)
        rows[i].tail<kCount>() -= (rows[i][column] * inverse) * rows[column].tail<kCount>();
    rows[column][column] = inverse;
    return true;
}

/** Stage by stage, each a dense array of six rows: the columns of one contact, three of the next, the right-hand side.
The four pivot rows take the place of the four new rows. @return false where a pivot is zero */
bool PathJacobian::eliminate() {
    Row rows[kRows];
    const auto leave = [&rows](const Row& from, int to) {  // the next contact's columns become the stage's own
        rows[to] << from[kColumns], from[kColumns + 1], from[kColumns + 2], 0, 0, 0, 0, from[kRightHand];
    };
    for (int i = 0; i < kLeft; ++i) leave(m_rows[i], i);
    for (int first = kLeft; first < m_size; first += kColumns) {
        Row* stage = &m_rows[first];
        std::copy(stage, stage + kColumns, rows + kLeft);
        if (!eliminateColumn<0>(rows) || !eliminateColumn<1>(rows) || !eliminateColumn<2>(rows) ||
            !eliminateColumn<3>(rows))
            return false;
        std::copy(rows, rows + kColumns, stage);
        for (int i = 0; i < kLeft; ++i) leave(rows[kColumns + i], i);
    }
    return true;
}

bool PathJacobian::solveInPlace(std::vector<double>& rightHandSide) {
    for (int row = 0; row < m_size; ++row) m_rows[row][kRightHand] = rightHandSide[row];
    if (!eliminate()) return false;
    double next[3] = {0, 0, 0};  // the first unknowns of the contact after
    for (int first = m_size - kColumns; first >= 0; first -= kColumns) {
        const Row* U = &m_rows[first + kLeft];
        double x[kColumns];
        for (int row = kColumns - 1; row >= 0; --row) {
            x[row] = U[row][kRightHand] - U[row][4] * next[0] - U[row][5] * next[1] - U[row][6] * next[2];
            for (int col = kColumns - 1; col > row; --col) x[row] -= U[row][col] * x[col];
            x[row] *= U[row][row];
        }
        for (int row = 0; row < kColumns; ++row) {
            if (!std::isfinite(x[row])) return false;
            rightHandSide[first + row] = x[row];
        }
        std::copy(x, x + 3, next);
    }
    return true;
}

}  // namespace tautline
