/** Jacobian of the path error against central differences of it, on chains that mix all surfaces. */
#include "tautline/path_error.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace tautline::testing {
namespace {

using Eigen::MatrixXd;

const GeodesicOptions kGeodesics{1e-14, 5000};
const double kStep = std::cbrt(1e-14);  // balances noise/h and h^2 of a central difference

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
        EXPECT_TRUE(shootChain(m_problem, m_pose, kGeodesics, m_chain));
    }

    const Chain& getChain() const { return m_chain; }

    MatrixXd calcJacobian() const {
        PathJacobian band;
        calcPathErrorJacobian(m_chain, band);
        MatrixXd dense = MatrixXd::Zero(band.getSize(), band.getSize());
        for (int row = 0; row < dense.rows(); ++row)
            for (int col = 0; col < dense.cols(); ++col)
                if (band.isInBand(row, col)) dense(row, col) = band.get(row, col);
        return dense;
    }

    MatrixXd calcDifferences() const {
        const int n = kVariations * static_cast<int>(m_chain.contacts.size());
        MatrixXd differences(n, n);
        for (int col = 0; col < n; ++col) {
            const double h = kStep * (col % kVariations == 2 ? 1 : getSize(col / kVariations));
            differences.col(col) = (calcError(col, h) - calcError(col, -h)) / (2 * h);
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
        m_pose.X_GE.emplace_back(m_random.rotation(), Vec3(at, 0, 0) + m_random.vector(0.5));
        if (!shape) {
            m_problem.addPoint(name);
            return;
        }
        m_problem.addObstacle(name, shape->surface);
        m_contacts.back().isTouched = true;
        m_contacts.back().start = makeRandomStart(*shape, m_random);
        m_contacts.back().start.length = m_random.uniform(-1, 2) * shape->surface->getSize();
    }

    Eigen::VectorXd calcError(int unknown, double amount) const {
        Chain varied = m_chain;
        ChainContact& contact = varied.contacts[unknown / kVariations];
        Vec4 correction = Vec4::Zero();
        correction[unknown % kVariations] = amount;
        contact.start = calcCorrectedStart(*m_problem.getElement(contact.element).surface, contact.start,
                                           contact.geodesic.P, correction);
        EXPECT_TRUE(shootChain(m_problem, m_pose, kGeodesics, varied));
        std::vector<double> eps;
        calcPathError(varied, eps);
        return Eigen::Map<Eigen::VectorXd>(eps.data(), eps.size());
    }

    Random m_random;
    PathProblem m_problem;
    PathPose m_pose;
    std::vector<ObstacleContact> m_contacts;
    Chain m_chain;
};

// S sphere, C cylinder, E ellipsoid, F flat ellipsoid, T torus, . via point
constexpr const char* kPlans[] = {"S", "C", "E", "F", "T", "SCEFT", "TT", "C.C", "S.TE..F", "ESTCFESTCF"};

TEST(PathErrorJacobian, EqualsCentralDifferences) {
    unsigned seed = 60;
    for (const char* plan : kPlans) {
        SCOPED_TRACE(plan);
        const RandomChain chain(plan, ++seed);
        const MatrixXd jacobian = chain.calcJacobian(), differences = chain.calcDifferences();
        // Relative to the largest entry of the column: one unit, one geodesic.
        for (int col = 0; col < jacobian.cols(); ++col)
            EXPECT_LT((jacobian.col(col) - differences.col(col)).cwiseAbs().maxCoeff(),
                      1e-6 * (1 + jacobian.col(col).cwiseAbs().maxCoeff()))
                << "unknown " << col;
    }
}

TEST(PathErrorJacobian, NothingStandsOutsideTheBand) {
    const MatrixXd differences = RandomChain("ESTCF", 71).calcDifferences();
    for (int row = 0; row < differences.rows(); ++row)
        for (int col = 0; col < differences.cols(); ++col)
            if (std::abs(row - col) > kPathBandwidth) {
                EXPECT_EQ(differences(row, col), 0) << row << ", " << col;
            }
}

TEST(PathErrorJacobian, ViaPointsDecoupleTheirNeighbours) {
    const RandomChain chain("SE.TC", 72);
    for (const MatrixXd& jacobian : {chain.calcJacobian(), chain.calcDifferences()}) {
        EXPECT_EQ(jacobian.block(8, 0, 8, 8).norm(), 0);
        EXPECT_EQ(jacobian.block(0, 8, 8, 8).norm(), 0);
        EXPECT_GT(jacobian.block(4, 0, 4, 4).norm(), 0);  // which neighbours without one are not
    }
}

TEST(PathError, RowsAreProjectionsOfTheSegmentsOnTheEndFrames) {  // Eqn. 4.3
    const Chain chain = RandomChain("TS", 73).getChain();
    std::vector<double> eps;
    const double largest = calcPathError(chain, eps);
    ASSERT_EQ(eps.size(), 8u);
    const ChainContact& second = chain.contacts[1];
    const Vec3 e = (second.P.x - chain.contacts[0].Q.x).normalized();
    EXPECT_NEAR(eps[2], e.dot(chain.contacts[0].Q.N), 1e-15);
    EXPECT_NEAR(eps[3], e.dot(chain.contacts[0].Q.B), 1e-15);
    EXPECT_NEAR(eps[4], e.dot(second.P.N), 1e-15);
    EXPECT_NEAR(eps[5], e.dot(second.P.B), 1e-15);
    double truth = 0;
    for (double x : eps) truth = std::max(truth, std::abs(x));
    EXPECT_EQ(largest, truth);
}

TEST(PathError, LengthSumsSegmentsAndSignedArcs) {
    const Chain chain = RandomChain("ET.C", 74).getChain();
    double length = 0;
    for (const ChainSegment& s : chain.segments) length += (s.line.B - s.line.A).norm();
    for (const ChainContact& c : chain.contacts) length += c.start.length;
    EXPECT_NEAR(calcLength(chain), length, 1e-14 * std::abs(length));
    EXPECT_EQ(chain.segments.size(), 5u);
}

TEST(PathError, ChainOfPointsHasNoError) {
    const RandomChain chain(".", 75);
    std::vector<double> eps(3, 1.0);
    EXPECT_EQ(calcPathError(chain.getChain(), eps), 0);
    EXPECT_TRUE(eps.empty());
}

}  // namespace
}  // namespace tautline::testing
