// SPDX-License-Identifier: Apache-2.0
#include "paths/local/length_minimizer.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kLeastDelta = 1e-4, kMostDelta = 1e6;  ///< of the convexification, in sizes of the surfaces
constexpr double kEnoughDelta = 10;                     ///< beyond which a step is long for its conditions' sake
constexpr double kRaise = 8, kLower = 1.0 / 3;          ///< from trial to trial, and from step to step
constexpr double kLeastKept = 0.1;                      ///< of the length of an arc in one step
constexpr int kMaxHalvings = 8;
constexpr double kLeastPenalty = 0.3;   ///< per size and unit of e.N
constexpr double kLeastFraction = 0.2;  ///< of a step within the limits; more convex ones go before shorter ones
constexpr double kSufficient = 1e-4;    ///< part of the predicted descent that a step must bring (Armijo)
constexpr double kPenaltyMargin = 0.1;  ///< of the descent direction's slope, left to the conditions
constexpr double kLeastJacobi = 1e-6;   ///< r over size, below which theta's scale no longer grows

/** The rows of eps that are conditions of tangency: e.N at P and at Q. */
constexpr int kTangency[] = {0, 2};

}  // namespace

bool LengthMinimizer::minimize(const PathProblem& problem, const PathPose& pose, int maxIterations,
                               PathSolution& path) {
    m_delta = 0, m_penalty = kLeastPenalty;
    const bool isFinite = m_stepper.begin(problem, pose, path);
    for (int i = 0; isFinite && path.pathError > m_options.pathErrorTolerance &&
                    i < std::min(maxIterations, m_options.maxIterations);
         ++i) {
        ++path.iterations;
        if (!takeStep(path)) break;
        m_stepper.acceptTrial(path);
    }
    m_stepper.store(path);
    return isFinite && path.pathError <= m_options.pathErrorTolerance;
}

/** Convexifies until the step exists and leads down. */
bool LengthMinimizer::takeStep(PathSolution& path) {
    calcPathErrorJacobian(m_stepper.getChain(), m_jacobian);
    calcLengthGradient(m_stepper.getChain(), m_gradient);
    calcLengthHessian(m_stepper.getChain(), m_hessian);
    double delta = 0;
    while (delta <= kMostDelta) {
        assemble(delta);
        if (m_kkt.factor() && hasInertiaOfMinimum() && solve(true, m_stepper.getError(), m_step) &&
            (delta > kEnoughDelta || m_stepper.calcStepFraction(m_step) > kLeastFraction) && searchLine(path)) {
            m_delta = delta * kLower;
            return true;
        }
        delta = delta == 0 ? std::max(kLeastDelta, m_delta) : kRaise * delta;
    }
    return false;
}

/** Units of xi that make its effects alike: the size of the surface for moves; for turns the angle whose effect at Q
is that of a move, since the system is singular at r = 0 otherwise. */
Vector4 LengthMinimizer::calcScales(std::size_t contact) const {
    const double size = m_stepper.getSize(contact);
    const double r = std::abs(m_stepper.getChain().contacts[contact].geodesic.r) / size;
    return {size, size, 1 / std::sqrt(std::clamp(r, kLeastJacobi, 1.0)), size};
}

/** Block rows and columns: xi in units of its scales, then the multipliers of the two conditions times the size. */
void LengthMinimizer::assemble(double delta) {
    const int n = static_cast<int>(m_hessian.size());
    m_kkt.reset(n);
    m_solution.resize(BlockLdlt::k * n);
    // dc^i/dxi^j, 2 x 4, scaled
    const auto calcConditions = [&](int i, int j) {
        const Vector4 scales = calcScales(j);
        Eigen::Matrix<double, 2, kVariations> A;
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < kVariations; ++column) {
                const int at = kVariations * i + kTangency[row], to = kVariations * j + column;
                A(row, column) =
                    m_jacobian.isInBand(at, to) ? m_stepper.getSize(i) * m_jacobian.get(at, to) * scales[column] : 0;
            }
        return A;
    };
    for (int i = 0; i < n; ++i) {
        const Vector4 scales = calcScales(i);
        const double size = m_stepper.getSize(i);
        Eigen::Map<BlockLdlt::Block> own = m_kkt.updDiagonal(i);
        own.topLeftCorner<4, 4>() = scales.asDiagonal() * m_hessian[i].own * scales.asDiagonal();
        own.topLeftCorner<4, 4>().diagonal().array() += delta * size;
        own.bottomLeftCorner<2, 4>() = calcConditions(i, i);
        if (i + 1 == n) break;
        Eigen::Map<BlockLdlt::Block> next = m_kkt.updCoupling(i);
        next.topLeftCorner<4, 4>() = scales.asDiagonal() * m_hessian[i].next * calcScales(i + 1).asDiagonal();
        next.bottomLeftCorner<2, 4>() = calcConditions(i, i + 1);
        next.topRightCorner<4, 2>() = calcConditions(i + 1, i).transpose();
    }
}

/** As many negative eigenvalues as conditions, and one more for each arc that is shot backwards. */
bool LengthMinimizer::hasInertiaOfMinimum() const {
    int numNegative = 2 * m_kkt.getNumBlocks();
    for (const ChainContact& contact : m_stepper.getChain().contacts) numNegative += contact.start.length < 0;
    return m_kkt.getNumNegative() == numNegative;
}

/** Solves for right-hand sides -g, or none, and -c in the units of the matrix. @param eps   of which c are rows */
bool LengthMinimizer::solve(bool isDownhill, const std::vector<double>& eps, std::vector<double>& step) {
    const std::size_t n = m_hessian.size();
    for (std::size_t i = 0; i < n; ++i) {
        double* right = &m_solution[BlockLdlt::k * i];
        Eigen::Map<Vector4> g(right);
        g.setZero();
        if (isDownhill) g = -calcScales(i).cwiseProduct(Eigen::Map<const Vector4>(&m_gradient[kVariations * i]));
        for (int k = 0; k < 2; ++k)
            right[kVariations + k] = -m_stepper.getSize(i) * eps[kVariations * i + kTangency[k]];
    }
    m_kkt.solveInPlace(m_solution);
    step.resize(m_gradient.size());
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Map<const Vector4> solution(&m_solution[BlockLdlt::k * i]);
        Eigen::Map<Vector4> d(&step[kVariations * i]);
        d = calcScales(i).cwiseProduct(solution);
        if (!d.allFinite()) return false;
    }
    return true;
}

/** Tries a fraction of the step again with the second-order correction A d = -c(trial): where a surface curves away
sideways, the step alone breaks the conditions by its square. @return false if that cannot be tried */
bool LengthMinimizer::tryCorrected(double fraction, PathSolution& path) {
    if (!solve(false, m_stepper.getTrialError(), m_corrected)) return false;
    for (std::size_t i = 0; i < m_corrected.size(); ++i) m_corrected[i] += fraction * m_step[i];
    return m_stepper.calcStepFraction(m_corrected) == 1 && m_stepper.tryStep(m_corrected, 1, path);
}

/** |c|_1, each condition times the size of its surface [m]. */
double LengthMinimizer::calcViolation(const Chain& chain, const std::vector<double>& eps) const {
    double sum = 0;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i)
        for (const int row : kTangency) sum += m_stepper.getSize(i) * std::abs(eps[kVariations * i + row]);
    return sum;
}

/** g.d + max(d.H d, 0)/2: what the quadratic model of the length promises. @param slope   g.d */
double LengthMinimizer::predictChange(double& slope) const {
    double curvature = 0;
    slope = 0;
    for (std::size_t i = 0; i < m_hessian.size(); ++i) {
        const Eigen::Map<const Vector4> d(&m_step[kVariations * i]);
        slope += d.dot(Eigen::Map<const Vector4>(&m_gradient[kVariations * i]));
        curvature += d.dot(m_hessian[i].own * d);
        if (i + 1 < m_hessian.size())
            curvature += 2 * d.dot(m_hessian[i].next * Eigen::Map<const Vector4>(&m_step[kVariations * (i + 1)]));
    }
    return slope + 0.5 * std::max(curvature, 0.0);
}

/** Arcs keep a part of their length: the system is singular at length zero, and no arc is led through it. */
double LengthMinimizer::calcPositiveFraction(double fraction) const {
    const Chain& chain = m_stepper.getChain();
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const double length = chain.contacts[i].start.length, change = m_step[kVariations * i + 3];
        if (length > 0 && length + fraction * change < kLeastKept * length)
            fraction = (kLeastKept - 1) * length / change;
    }
    return fraction;
}

/** Halves the step until the penalty function falls, or the path error by half: near the end the fall drowns in the
rounding of L. @return false if it does not */
bool LengthMinimizer::searchLine(PathSolution& path) {
    const Chain& chain = m_stepper.getChain();
    const double violation = calcViolation(chain, m_stepper.getError()), length = calcLength(chain);
    double slope;
    const double predicted = predictChange(slope);
    if (violation > 0) m_penalty = std::max(m_penalty, predicted / ((1 - kPenaltyMargin) * violation));
    const double descent = slope - m_penalty * violation;
    const auto isGood = [&](double fraction) {
        const double trialLength = calcLength(m_stepper.getTrial());
        const double trialViolation = calcViolation(m_stepper.getTrial(), m_stepper.getTrialError());
        const double fall = trialLength - length + m_penalty * (trialViolation - violation);
        return (descent < 0 && fall < kSufficient * fraction * descent) ||
               calcNorm(m_stepper.getTrialError()) < 0.5 * calcNorm(m_stepper.getError());
    };
    double fraction = calcPositiveFraction(m_stepper.calcStepFraction(m_step));
    for (int halving = 0; halving <= kMaxHalvings; ++halving, fraction /= 2)
        if (m_stepper.tryStep(m_step, fraction, path) &&
            (isGood(fraction) || (tryCorrected(fraction, path) && isGood(fraction))))
            return true;
    return false;
}

}  // namespace tautline
