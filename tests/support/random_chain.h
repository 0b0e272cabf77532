// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Chains of random geodesics on shapes of all kinds, varied along their natural corrections for differences. */
#include <cmath>

#include "paths/equations/path_error.h"
#include "support/shapes.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {

inline const ShootingOptions kChainGeodesics{1e-14, 5000};
inline const double kChainStep = std::cbrt(1e-14);  // balances noise/h and h^2 of a central difference

/** A chain of random geodesics on random shapes, far from any solution; '.' in `plan` is a via point. */
class RandomChain {
public:
    RandomChain(const std::string& plan, unsigned seed) : m_random(seed) {
        add(nullptr, 0);
        for (std::size_t i = 0; i < plan.size(); ++i) {
            std::size_t k = 0;
            const std::vector<Shape> shapes = makeShapes();
            while (plan[i] != '.' && shapes[k].name[0] != plan[i]) ++k;
            add(plan[i] == '.' ? nullptr : &shapes[k], 8.0 * (i + 1));
        }
        add(nullptr, 8.0 * (plan.size() + 1));
        m_chain.build(m_problem, m_pose, m_contacts);
        EXPECT_TRUE(shootChain(m_problem, m_pose, kChainGeodesics, m_chain));
    }

    const Chain& getChain() const { return m_chain; }

    /** To the path that the solver finds over the same surfaces. */
    void solve() {
        PathSolverOptions options;
        options.geodesics = kChainGeodesics;
        const PathSolution path = solvePath(m_problem, m_pose, options);
        ASSERT_EQ(path.status, PathStatus::Solved);
        m_chain.build(m_problem, m_pose, path.contacts);
        ASSERT_TRUE(shootChain(m_problem, m_pose, kChainGeodesics, m_chain));
    }

    Eigen::MatrixXd calcJacobian() const {
        PathJacobian band;
        calcPathErrorJacobian(m_chain, band);
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(band.getSize(), band.getSize());
        for (int row = 0; row < dense.rows(); ++row)
            for (int col = 0; col < dense.cols(); ++col)
                if (band.isInBand(row, col)) dense(row, col) = band.get(row, col);
        return dense;
    }

    /** Central difference of a function of the chain along one natural correction. */
    template <class Function>
    auto calcDerivative(int unknown, Function function) const {
        const double h = kChainStep * (unknown % kVariations == 2 ? 1 : getSize(unknown / kVariations));
        return ((function(vary(unknown, h)) - function(vary(unknown, -h))) / (2 * h)).eval();
    }

    Eigen::MatrixXd calcDifferences() const {
        const int n = kVariations * static_cast<int>(m_chain.contacts.size());
        Eigen::MatrixXd differences(n, n);
        for (int col = 0; col < n; ++col) {
            differences.col(col) = calcDerivative(col, [](const Chain& varied) {
                std::vector<double> eps;
                calcPathError(varied, eps);
                return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(eps.data(), eps.size()));
            });
        }
        return differences;
    }

    double getSize(int contact) const {
        return m_problem.getElement(m_chain.contacts[contact].element).surface->getSize();
    }

private:
    void add(const Shape* shape, double at) {
        const std::string name = std::to_string(m_problem.getNumElements());
        m_contacts.emplace_back();
        m_pose.X_GE.emplace_back(m_random.rotation(), Vector3(at, 0, 0) + m_random.vector(0.5));
        if (!shape) {
            m_problem.addPoint(name);
            return;
        }
        m_problem.addObstacle(name, shape->surface);
        m_contacts.back().isTouched = true;
        m_contacts.back().start = makeRandomStart(*shape, m_random);
        m_contacts.back().start.length = m_random.uniform(-1, 2) * shape->surface->getSize();
    }

    Chain vary(int unknown, double amount) const {
        Chain varied = m_chain;
        ChainContact& contact = varied.contacts[unknown / kVariations];
        Vector4 correction = Vector4::Zero();
        correction[unknown % kVariations] = amount;
        contact.start = calcCorrectedStart(*m_problem.getElement(contact.element).surface, contact.start,
                                           contact.geodesic.P, correction);
        EXPECT_TRUE(shootChain(m_problem, m_pose, kChainGeodesics, varied));
        return varied;
    }

    Random m_random;
    PathProblem m_problem;
    PathPose m_pose;
    std::vector<ObstacleContact> m_contacts;
    Chain m_chain;
};

}  // namespace tautline::testing
