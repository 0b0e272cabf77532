#include "tautline/banded_solver.h"

#include <cmath>

#include "lapack.h"

namespace tautline {

void BandedSolver::reset(int size) {
    m_size = size;
    m_storage.assign(static_cast<std::size_t>(size) * getLeadingDimension(), 0.0);
    m_pivots.resize(size);
}

bool BandedSolver::solveInPlace(std::vector<double>& rightHandSide) {
    if (m_size == 0) return true;  // LAPACK wants a leading dimension of at least one
    const int one = 1, ld = getLeadingDimension();
    int info = 0;
    dgbsv_(&m_size, &m_kl, &m_ku, &one, m_storage.data(), &ld, m_pivots.data(), rightHandSide.data(), &m_size, &info);
    if (info != 0) return false;
    for (int i = 0; i < m_size; ++i)
        if (!std::isfinite(rightHandSide[i])) return false;
    return true;
}

}  // namespace tautline
