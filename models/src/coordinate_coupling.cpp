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

int findMobility(const BuiltModel& model, const BuiltModel::CoordinateSlot& slot, const SimTK::State& state) {
    return model.getMatter().getMobilizedBody(slot.body).getFirstUIndex(state) + slot.u;
}

/** The same of the couplers alone, without Simbody, which takes longer for it than all paths do. */
Matrix calcCouplerMatrix(const BuiltModel& model, const SimTK::State& state) {
    const std::vector<CoordinateCoupler>& couplers = model.getCouplers();
    Matrix G = Matrix::Zero(static_cast<Eigen::Index>(couplers.size()), state.getNU());
    for (std::size_t row = 0; row < couplers.size(); ++row) {
        const auto add = [&](const std::string& coordinate, double factor) {
            G(static_cast<Eigen::Index>(row), findMobility(model, model.getCoordinateSlot(coordinate), state)) +=
                factor;
        };
        add(couplers[row].dependentCoordinate, -1);
        const std::vector<std::string>& independents = couplers[row].independentCoordinates;
        for (std::size_t i = 0; i < independents.size(); ++i)
            add(independents[i], model.calcCouplingSlope(state, couplers[row], static_cast<int>(i)));
    }
    return G;
}

/** Whether a constraint keeps a coordinate where it is, or where its motion says. */
bool isHeld(const BuiltModel::CoordinateSlot& slot) {
    return slot.lock.isValid() || slot.drive.isValid();
}

/** The mobility that a row holds alone, as locks and single driven coordinates do; -1 if there is none. */
int findHeldMobility(const Matrix& G, Eigen::Index row) {
    Eigen::Index largest = 0;
    const double size = G.row(row).cwiseAbs().maxCoeff(&largest);
    const double others = G.row(row).cwiseAbs().sum() - size;
    return size > 0 && others <= kRounding * size ? static_cast<int>(largest) : -1;
}

/** Speeds that are free or held by locks, and the equations that bind several. */
class SpeedEquations {
public:
    /** @param heldBesides   mobilities that no row holds, but that are held all the same */
    SpeedEquations(const Matrix& all, const std::vector<int>& heldBesides)
        : m_isHeld(static_cast<std::size_t>(all.cols()), 0), m_columns(m_isHeld.size(), -1) {
        for (const int mobility : heldBesides) m_isHeld[static_cast<std::size_t>(mobility)] = 1;
        std::vector<Eigen::Index> rows;
        for (Eigen::Index i = 0; i < all.rows(); ++i) {
            const int held = findHeldMobility(all, i);
            if (held >= 0)
                m_isHeld[static_cast<std::size_t>(held)] = 1;
            else
                rows.push_back(i);
        }
        for (Eigen::Index u = 0; u < all.cols(); ++u)
            if (std::any_of(rows.begin(), rows.end(), [&](Eigen::Index i) { return all(i, u) != 0; })) {
                m_columns[static_cast<std::size_t>(u)] = static_cast<int>(m_bound.size());
                m_bound.push_back(static_cast<int>(u));
            }
        m_G.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(m_bound.size()));
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < m_bound.size(); ++j)
                m_G(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = all(rows[i], m_bound[j]);
    }

    bool isHeld(int mobility) const { return m_isHeld[static_cast<std::size_t>(mobility)]; }
    bool binds(int mobility) const { return m_columns[static_cast<std::size_t>(mobility)] >= 0; }
    /** The mobilities that equations bind. */
    const std::vector<int>& getBound() const { return m_bound; }

    /** The allowed speeds of the bound mobilities nearest to that of one alone, which is let go if it is held.
    @param mobility   bound, too */
    Eigen::VectorXd calcNearestSpeeds(int mobility) {
        const int column = m_columns[static_cast<std::size_t>(mobility)];
        if (isHeld(mobility)) return calcProjection(mobility).col(column);
        if (m_projection.size() == 0) m_projection = calcProjection(-1);
        return m_projection.col(column);
    }

private:
    /** The projection onto the speeds that are allowed. @param released   a held mobility that may move; -1: none */
    Matrix calcProjection(int released) const {
        Matrix free = m_G;
        for (std::size_t j = 0; j < m_bound.size(); ++j)
            if (isHeld(m_bound[j]) && m_bound[j] != released) free.col(static_cast<Eigen::Index>(j)).setZero();
        return Matrix::Identity(free.cols(), free.cols()) -
               free.completeOrthogonalDecomposition().pseudoInverse() * free;
    }

    std::vector<char> m_isHeld;  ///< by mobility
    std::vector<int> m_columns;  ///< by mobility, of m_G; -1: no equation binds it
    std::vector<int> m_bound;    ///< by column
    Matrix m_G;                  ///< without rows that hold one mobility, and columns that are zero
    Matrix m_projection;         ///< of all mobilities that are not held; computed if needed
};

}  // namespace

CoordinateCoupling::CoordinateCoupling(const BuiltModel& model) : m_model(&model) {
    for (const std::string& name : model.getCoordinateNames()) m_slots.push_back(&model.getCoordinateSlot(name));
    m_mobilities.resize(m_slots.size());
    m_motions.resize(m_slots.size());
    const auto numHeld = std::count_if(m_slots.begin(), m_slots.end(), [](const auto* slot) { return isHeld(*slot); });
    m_hasLoops = model.getMatter().getNumConstraints() != numHeld + static_cast<int>(model.getCouplers().size());
}

void CoordinateCoupling::update(const SimTK::State& state) {
    std::vector<int> held;
    for (std::size_t i = 0; i < m_slots.size(); ++i) {
        m_mobilities[i] = findMobility(*m_model, *m_slots[i], state);
        if (isHeld(*m_slots[i])) held.push_back(m_mobilities[i]);
    }
    SpeedEquations equations(
        m_hasLoops ? calcConstraintMatrix(m_model->getMatter(), state) : calcCouplerMatrix(*m_model, state), held);
    for (std::size_t i = 0; i < m_slots.size(); ++i) {
        const int own = m_mobilities[i];
        m_motions[i].clear();
        if (!equations.binds(own)) {
            m_motions[i].push_back({own, 1.0});
            continue;
        }
        const Eigen::VectorXd speeds = equations.calcNearestSpeeds(own);
        const auto at = std::find(equations.getBound().begin(), equations.getBound().end(), own);
        const double ownSpeed = speeds[at - equations.getBound().begin()];
        if (!(ownSpeed > kLeastShare)) continue;
        for (Eigen::Index k = 0; k < speeds.size(); ++k)
            if (const double share = speeds[k] / ownSpeed; std::abs(share) > kRounding)
                m_motions[i].push_back({equations.getBound()[static_cast<std::size_t>(k)], share});
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
