// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/coordinate_coupling.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tautline::models {
namespace {

using Matrix = Eigen::MatrixXd;

/** Below this share of its own speed a coordinate is held: rounding of a projection by a few dozen rows. */
constexpr double kLeastShare = 1e-10;
/** Shares below this are rounding. */
constexpr double kRounding = 1e-15;

/** The constraints' equations for speeds: rows x mobilities, G u = 0. */
Matrix calcConstraintMatrix(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state) {
    SimTK::Matrix G;
    matter.calcG(state, G);
    Matrix copy(G.nrow(), state.getNU());
    for (int i = 0; i < G.nrow(); ++i)
        for (int j = 0; j < G.ncol(); ++j) copy(i, j) = G(i, j);
    return copy;
}

/** The mobility that a row holds alone, as locks and single driven coordinates do; -1 if there is none. */
int findHeldMobility(const Matrix& G, Eigen::Index row) {
    Eigen::Index largest = 0;
    const double size = G.row(row).cwiseAbs().maxCoeff(&largest);
    const double others = G.row(row).cwiseAbs().sum() - size;
    return size > 0 && others <= kRounding * size ? static_cast<int>(largest) : -1;
}

/** Speeds that are free or held by locks, and the equations that bind several. */
struct SpeedEquations {
    Matrix G;                  ///< without rows that hold one mobility
    std::vector<char> isHeld;  ///< by mobility

    SpeedEquations(const BuiltModel& model, const SimTK::State& state) : isHeld(state.getNU(), 0) {
        const Matrix all = calcConstraintMatrix(model.getMatter(), state);
        std::vector<Eigen::Index> rows;
        for (Eigen::Index i = 0; i < all.rows(); ++i) {
            const int held = findHeldMobility(all, i);
            if (held >= 0)
                isHeld[static_cast<std::size_t>(held)] = 1;
            else
                rows.push_back(i);
        }
        G.resize(static_cast<Eigen::Index>(rows.size()), all.cols());
        for (std::size_t i = 0; i < rows.size(); ++i) G.row(static_cast<Eigen::Index>(i)) = all.row(rows[i]);
    }

    bool binds(int mobility) const { return G.rows() > 0 && G.col(mobility).cwiseAbs().maxCoeff() > 0; }

    /** The projection onto the speeds that are allowed. @param released   a held mobility that may move; -1: none */
    Matrix calcProjection(int released = -1) const {
        Matrix free = G;
        for (Eigen::Index u = 0; u < G.cols(); ++u)
            if (isHeld[static_cast<std::size_t>(u)] && u != released) free.col(u).setZero();
        Matrix projection = Matrix::Identity(G.cols(), G.cols());
        if (free.rows() > 0) projection -= free.completeOrthogonalDecomposition().pseudoInverse() * free;
        return projection;
    }
};

}  // namespace

CoordinateCoupling::CoordinateCoupling(const BuiltModel& model, const SimTK::State& state) {
    const SpeedEquations equations(model, state);
    Matrix shared;  // of all coordinates that are not held; computed if needed
    for (const std::string& name : model.getCoordinateNames()) {
        const BuiltModel::CoordinateSlot& slot = model.getCoordinateSlot(name);
        const int own = model.getMatter().getMobilizedBody(slot.body).getFirstUIndex(state) + slot.u;
        m_mobilities.push_back(own);
        m_motions.emplace_back();
        if (!equations.binds(own)) {
            m_motions.back().push_back({own, 1.0});
            continue;
        }
        const bool isHeld = equations.isHeld[static_cast<std::size_t>(own)];
        if (!isHeld && shared.size() == 0) shared = equations.calcProjection();
        const Eigen::VectorXd speeds = isHeld ? equations.calcProjection(own).col(own) : shared.col(own);
        if (!(speeds[own] > kLeastShare)) continue;
        for (Eigen::Index u = 0; u < speeds.size(); ++u)
            if (const double share = speeds[u] / speeds[own]; std::abs(share) > kRounding)
                m_motions.back().push_back({static_cast<int>(u), share});
    }
}

double CoordinateCoupling::calcEffectiveArm(const SimTK::Vector& unitForces, int coordinate) const {
    const std::vector<Share>& motion = m_motions[static_cast<std::size_t>(coordinate)];
    if (motion.empty()) return SimTK::NaN;
    double arm = 0;
    for (const Share& share : motion) arm += share.speed * unitForces[share.mobility];
    return arm;
}

std::vector<double> CoordinateCoupling::calcGeometricArms(const SimTK::Vector& unitForces) const {
    std::vector<double> arms;
    for (int i = 0; i < getNumCoordinates(); ++i) arms.push_back(calcGeometricArm(unitForces, i));
    return arms;
}

std::vector<double> CoordinateCoupling::calcEffectiveArms(const SimTK::Vector& unitForces) const {
    std::vector<double> arms;
    for (int i = 0; i < getNumCoordinates(); ++i) arms.push_back(calcEffectiveArm(unitForces, i));
    return arms;
}

}  // namespace tautline::models
