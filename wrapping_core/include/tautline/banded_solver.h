#pragma once
#include <vector>

namespace tautline {

/** Square band matrix in LAPACK storage for dgbsv: entry (row, col) of the matrix stands at
storage[kl + ku + row - col + col * ld], column by column, ld = 2 kl + ku + 1; the first kl rows of each
column are room for the factor's fill-in. Reuses its memory: no allocation once it has been this large. */
class BandedSolver {
public:
    BandedSolver(int lowerBandwidth, int upperBandwidth) : m_kl(lowerBandwidth), m_ku(upperBandwidth) {}

    /** Sets the size and clears all entries. */
    void reset(int size);
    int getSize() const { return m_size; }

    /** Entry (row, col), which must lie within the band. */
    double& upd(int row, int col) { return m_storage[m_kl + m_ku + row - col + col * getLeadingDimension()]; }
    double get(int row, int col) const { return m_storage[m_kl + m_ku + row - col + col * getLeadingDimension()]; }
    bool isInBand(int row, int col) const { return row - col <= m_kl && col - row <= m_ku; }

    /** Factors the matrix in place and overwrites `rightHandSide` (length size) with the solution.
    @return false if the matrix is singular to working precision of the factor (a zero pivot) or the result
            is not finite; then neither matrix nor right-hand side may be used */
    bool solveInPlace(std::vector<double>& rightHandSide);

private:
    int getLeadingDimension() const { return 2 * m_kl + m_ku + 1; }
    int m_kl, m_ku, m_size = 0;
    std::vector<double> m_storage;
    std::vector<int> m_pivots;
};

}  // namespace tautline
