// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/block_ldlt.h"

#include "paths/equations/lapack.h"

namespace tautline {
namespace {

constexpr char kLower = 'L';
constexpr int kSize = BlockLdlt::k, kEntries = kSize * kSize;
using Block = BlockLdlt::Block;

/** Negative eigenvalues of a block that dsytrf has factored: of a pivot of two rows exactly one is. */
int countNegative(const Block& factor, const int* pivots) {
    int count = 0;
    for (int i = 0; i < kSize; ++i) {
        const bool isPair = pivots[i] < 0;
        if (isPair || factor(i, i) < 0) ++count;
        if (isPair) ++i;
    }
    return count;
}

void solveBlock(const double* factor, const int* pivots, int columns, double* b) {
    int info = 0;
    dsytrs_(&kLower, &kSize, &columns, factor, &kSize, pivots, b, &kSize, &info);
}

}  // namespace

void BlockLdlt::reset(int numBlocks) {
    m_numBlocks = numBlocks;
    m_diagonal.assign(static_cast<std::size_t>(kEntries) * numBlocks, 0.0);
    m_coupling.assign(static_cast<std::size_t>(kEntries) * numBlocks, 0.0);
    m_ratio.resize(static_cast<std::size_t>(kEntries) * numBlocks);
    m_pivots.resize(static_cast<std::size_t>(kSize) * numBlocks);
}

Eigen::Map<Block> BlockLdlt::updDiagonal(int i) {
    return Eigen::Map<Block>(&m_diagonal[kEntries * i]);
}

Eigen::Map<Block> BlockLdlt::updCoupling(int i) {
    return Eigen::Map<Block>(&m_coupling[kEntries * i]);
}

bool BlockLdlt::factor() {
    m_numNegative = 0;
    for (int i = 0; i < m_numBlocks; ++i) {
        Eigen::Map<Block> S = updDiagonal(i), ratio(&m_ratio[kEntries * i]);
        if (i > 0) S -= updCoupling(i - 1).transpose() * Eigen::Map<Block>(&m_ratio[kEntries * (i - 1)]);
        if (!S.allFinite()) return false;
        int* pivots = &m_pivots[kSize * i];
        double work[kEntries];
        int info = 0;
        dsytrf_(&kLower, &kSize, S.data(), &kSize, pivots, work, &kEntries, &info);
        if (info != 0) return false;
        m_numNegative += countNegative(S, pivots);
        ratio = updCoupling(i);
        solveBlock(S.data(), pivots, kSize, ratio.data());
    }
    return true;
}

void BlockLdlt::solveInPlace(std::vector<double>& b) const {
    using Segment = Eigen::Map<Eigen::Matrix<double, kSize, 1>>;
    using ConstBlock = Eigen::Map<const Block>;
    for (int i = 0; i < m_numBlocks; ++i) {
        Segment here(&b[kSize * i]);
        if (i > 0) here -= ConstBlock(&m_coupling[kEntries * (i - 1)]).transpose() * Segment(&b[kSize * (i - 1)]);
        solveBlock(&m_diagonal[kEntries * i], &m_pivots[kSize * i], 1, here.data());
    }
    for (int i = m_numBlocks - 2; i >= 0; --i)
        Segment(&b[kSize * i]) -= ConstBlock(&m_ratio[kEntries * i]) * Segment(&b[kSize * (i + 1)]);
}

}  // namespace tautline
