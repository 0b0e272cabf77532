// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>

#include "bindings.h"
#include "parallel_work.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_solver.h"

namespace tautline::python {
namespace {

StartHint makeHint(const std::optional<Vector3>& near, const std::optional<Vector3>& side,
                   const std::optional<double>& turns, const std::optional<int>& passages) {
    require(near.has_value() + side.has_value() + turns.has_value() + passages.has_value() <= 1,
            "an obstacle can have one of near, side, turns and passages, not several");
    if (near) return PassNear{*near};
    if (side) return PassOnSide{*side};
    if (turns) return WindAround{*turns};
    if (passages) return ThreadHole{*passages};
    return {};
}

int addObstacle(PathProblem& problem, const std::string& name, const std::shared_ptr<Surface>& surface,
                const std::optional<Vector3>& near, const std::optional<Vector3>& side,
                const std::optional<double>& turns, const std::optional<int>& passages) {
    return problem.addObstacle(name, surface, makeHint(near, side, turns, passages));
}

/** A homogeneous matrix, row by row. Of a pose that is not finite nothing is asked: it is solved as such. */
Pose readPose(const double* X, py::ssize_t pose, py::ssize_t element) {
    /** Of a rotation that was written with single precision. */
    constexpr double kRoom = 1e-6;
    using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
    const Eigen::Map<const Matrix> matrix(X);
    const Matrix3 R = matrix.topLeftCorner<3, 3>();
    const double skew = (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff();
    const bool isRigid = skew <= kRoom && R.determinant() > 0 && matrix(3, 3) == 1 && matrix.row(3).head<3>().isZero(0);
    require(isRigid || !matrix.allFinite(), "poses[", pose, ", ", element, "] is not a rotation and a translation");
    return {R, matrix.topRightCorner<3, 1>()};
}

std::vector<PathPose> readPoses(const PathProblem& problem, const Numbers& poses) {
    const bool isSingle = poses.ndim() == 3;
    const int numElements = problem.getNumElements();
    if (isSingle)
        requireShape(poses, "poses", {numElements, 4, 4});
    else
        requireShape(poses, "poses", {-1, numElements, 4, 4});
    const py::ssize_t count = isSingle ? 1 : poses.shape(0);
    std::vector<PathPose> read(static_cast<std::size_t>(count));
    for (py::ssize_t i = 0; i < count; ++i)
        for (py::ssize_t e = 0; e < numElements; ++e)
            read[static_cast<std::size_t>(i)].X_GE.push_back(readPose(poses.data() + 16 * (i * numElements + e), i, e));
    return read;
}

/** The paths of one problem in n poses, and what can be asked of them. */
class PathResults {
public:
    PathResults(PathProblem problem, std::vector<PathPose> poses)
        : m_problem(std::move(problem)), m_poses(std::move(poses)), m_paths(m_poses.size()) {
        for (int e = 0; e < m_problem.getNumElements(); ++e)
            if (!m_problem.getElement(e).isPoint()) m_obstacles.push_back(e);
    }

    void solve(const PathSolverOptions& options, int numThreads) {
        std::vector<PathSolver> solvers;
        for (int i = 0; i < countWorkers(size(), kItemsPerBlock, {numThreads, {}}); ++i) solvers.emplace_back(options);
        runParallel(size(), numThreads, [&](int worker, int i) {
            solvers[static_cast<std::size_t>(worker)].solve(m_problem, pose(i), m_paths[static_cast<std::size_t>(i)]);
        });
    }

    /** Each path from the one before, in one thread. */
    void solveContinued(const PathSolverOptions& options) {
        PathSolver solver(options);
        runParallel(size(), 1, [&](int, int i) {
            if (i > 0) m_paths[static_cast<std::size_t>(i)] = m_paths[static_cast<std::size_t>(i - 1)];
            solver.solve(m_problem, pose(i), m_paths[static_cast<std::size_t>(i)]);
        });
    }

    int size() const { return static_cast<int>(m_poses.size()); }

    std::vector<std::string> getObstacleNames() const {
        std::vector<std::string> names;
        for (const int e : m_obstacles) names.push_back(m_problem.getElement(e).name);
        return names;
    }

    std::vector<std::string> getStatus() const {
        std::vector<std::string> names;
        for (const PathSolution& path : m_paths) names.push_back(getName(path.status));
        return names;
    }

    /** One number for each path. */
    template <class Get>
    Numbers list(Get get) const {
        Numbers numbers(size());
        for (int i = 0; i < size(); ++i) *numbers.mutable_data(i) = get(path(i));
        return numbers;
    }

    /** One number for each path and obstacle. */
    template <class Get>
    Numbers tabulate(Get get) const {
        Numbers numbers({size(), static_cast<int>(m_obstacles.size())});
        for (int i = 0; i < size(); ++i)
            for (std::size_t o = 0; o < m_obstacles.size(); ++o)
                *numbers.mutable_data(i, o) = get(path(i).contacts.at(static_cast<std::size_t>(m_obstacles[o])));
        return numbers;
    }

    /** Where the path meets (P) or leaves (Q) each obstacle, in ground; NaN while lifted. */
    Numbers getContactPoints(bool isP) const {
        Numbers points({size(), static_cast<int>(m_obstacles.size()), 3});
        for (int i = 0; i < size(); ++i)
            for (std::size_t o = 0; o < m_obstacles.size(); ++o) {
                const auto e = static_cast<std::size_t>(m_obstacles[o]);
                const ObstacleContact& contact = path(i).contacts.at(e);
                Vector3 point = Vector3::Constant(kNaN);
                if (contact.isTouched)
                    point = pose(i).X_GE[e] * (isP ? contact.geodesic.P.x : contact.getLastArc().geodesic.Q.x);
                for (int k = 0; k < 3; ++k) *points.mutable_data(i, o, k) = point[k];
            }
        return points;
    }

    Numbers calcForces() const {
        Numbers forces({size(), m_problem.getNumElements(), 6});
        std::vector<SpatialForce> F_GE;
        for (int i = 0; i < size(); ++i) {
            calcUnitForces(path(i), pose(i), F_GE);
            for (int e = 0; e < m_problem.getNumElements(); ++e)
                for (int k = 0; k < 3; ++k) {
                    *forces.mutable_data(i, e, k) = F_GE[static_cast<std::size_t>(e)].moment[k];
                    *forces.mutable_data(i, e, 3 + k) = F_GE[static_cast<std::size_t>(e)].force[k];
                }
        }
        return forces;
    }

    Numbers calcRates(const Numbers& velocities) const {
        requireShape(velocities, "velocities", {size(), m_problem.getNumElements(), 6});
        Numbers rates(size());
        for (int i = 0; i < size(); ++i)
            *rates.mutable_data(i) = calcLengthRate(path(i), pose(i), readVelocities(velocities.data(i, 0, 0)));
        return rates;
    }

    py::dict calcVariation(int i, const Numbers& velocities) const {
        requireIndex(i);
        requireShape(velocities, "velocities", {m_problem.getNumElements(), 6});
        PathSensitivity sensitivity;
        sensitivity.setPath(m_problem, pose(i), path(i));
        PathVariation variation;
        const bool isRegular = sensitivity.calcVariation(readVelocities(velocities.data()), variation);
        const int numElements = m_problem.getNumElements();
        Numbers xi({numElements, 4}), P({numElements, 3}), Q({numElements, 3}), forces({numElements, 6});
        for (int e = 0; e < numElements; ++e) {
            const auto at = static_cast<std::size_t>(e);
            for (int k = 0; k < 4; ++k) *xi.mutable_data(e, k) = variation.xiRate[at][k];
            for (int k = 0; k < 3; ++k) {
                *P.mutable_data(e, k) = variation.PRate[at][k];
                *Q.mutable_data(e, k) = variation.QRate[at][k];
                *forces.mutable_data(e, k) = variation.forceRate[at].moment[k];
                *forces.mutable_data(e, 3 + k) = variation.forceRate[at].force[k];
            }
        }
        py::dict result;
        result["is_regular"] = isRegular;
        result["length_rate"] = variation.lengthRate;
        result["xi_rate"] = xi;
        result["P_rate"] = P;
        result["Q_rate"] = Q;
        result["unit_force_rate"] = forces;
        return result;
    }

    std::string explain(int i) const {
        requireIndex(i);
        return explainStatus(m_problem, pose(i), path(i));
    }

    Numbers calcPoints(int i, double maxAngle) const {
        requireIndex(i);
        std::vector<Vector3> points_G;
        calcDrawingPoints(path(i), m_problem, pose(i), maxAngle, points_G);
        Numbers points({static_cast<int>(points_G.size()), 3});
        for (std::size_t p = 0; p < points_G.size(); ++p)
            for (int k = 0; k < 3; ++k) *points.mutable_data(p, k) = points_G[p][k];
        return points;
    }

private:
    const PathSolution& path(int i) const { return m_paths[static_cast<std::size_t>(i)]; }
    const PathPose& pose(int i) const { return m_poses[static_cast<std::size_t>(i)]; }

    void requireIndex(int i) const {
        if (i < 0 || i >= size())
            throw py::index_error("pose " + std::to_string(i) + " of " + std::to_string(size()) + " is asked for");
    }

    std::vector<SpatialVelocity> readVelocities(const double* numbers) const {
        std::vector<SpatialVelocity> V_GE(static_cast<std::size_t>(m_problem.getNumElements()));
        for (SpatialVelocity& V : V_GE) {
            V.w = Vector3(numbers);
            V.v = Vector3(numbers + 3);
            numbers += 6;
        }
        return V_GE;
    }

    PathProblem m_problem;
    std::vector<PathPose> m_poses;
    std::vector<PathSolution> m_paths;
    std::vector<int> m_obstacles;  ///< element indices
};

std::shared_ptr<PathResults> solve(const PathProblem& problem, const Numbers& poses, double tolerance, bool isContinued,
                                   int numThreads) {
    problem.validate();
    PathSolverOptions options;
    options.pathErrorTolerance = tolerance;
    auto results = std::make_shared<PathResults>(problem, readPoses(problem, poses));
    if (isContinued)
        results->solveContinued(options);
    else
        results->solve(options, numThreads);
    return results;
}

}  // namespace

void bindPaths(py::module_& module) {
    using py::arg;
    py::class_<PathProblem>(module, "PathProblem", "What a path is made of, in order from origin to insertion.")
        .def(py::init<>())
        .def("add_point", &PathProblem::addPoint, arg("name"), "Appends a point. Returns its element index.")
        .def("add_obstacle", &addObstacle, arg("name"), arg("surface"), arg("near") = py::none(),
             arg("side") = py::none(), arg("turns") = py::none(), arg("passages") = py::none(),
             "Appends an obstacle; at most one hint says how the path runs about it, else the straight line does.\n\n"
             "near       a point (3,) in the surface's frame S near which it runs\n"
             "side       a direction (3,) in S: it runs where direction . p >= 0\n"
             "turns      full turns about the z axis of S, positive from x to y\n"
             "passages   how often it goes through the hole, along the z axis of S if positive\n\n"
             "Returns the element index.")
        .def("__len__", &PathProblem::getNumElements)
        .def("solve", &solve, arg("poses"), py::kw_only(), arg("tolerance") = PathSolverOptions().pathErrorTolerance,
             arg("continued") = false, arg("threads") = 0,
             "Solves in n poses.\n\n"
             "poses       (n, elements, 4, 4): the frame of each element in ground, as a homogeneous matrix; a point "
             "is\n"
             "            where its origin is. (elements, 4, 4) is one pose\n"
             "tolerance   of the path error, dimensionless\n"
             "continued   each path from the one before, in one thread; else each is a function of its pose alone\n"
             "threads     0: as many as the machine has. Python's lock is released\n\n"
             "Returns PathResults.");

    const auto length = [](const PathSolution& path) { return path.length; };
    const auto pathError = [](const PathSolution& path) { return path.pathError; };
    const auto countArcs = [](const ObstacleContact& contact) { return 1.0 * contact.getNumArcs(); };
    const auto arcLength = [](const ObstacleContact& contact) { return contact.calcArcLength(); };
    py::class_<PathResults, std::shared_ptr<PathResults>>(module, "PathResults",
                                                          "Paths in n poses. Vectors are in ground, units SI.")
        .def("__len__", &PathResults::size)
        .def_property_readonly("obstacles", &PathResults::getObstacleNames, "Names, in the order of the path.")
        .def_property_readonly(
            "status", [](const PathResults& r) { return makeWords(r.getStatus()); },
            "(n,): words, solved, not_minimum, left_domain, end_inside or not_converged.")
        .def_property_readonly(
            "length", [=](const PathResults& r) { return r.list(length); }, "(n,) [m]")
        .def_property_readonly(
            "path_error", [=](const PathResults& r) { return r.list(pathError); },
            "(n,), largest entry of the path error, dimensionless")
        .def_property_readonly(
            "touched", [=](const PathResults& r) { return r.tabulate(countArcs); },
            "(n, obstacles): in how many arcs the path lies on an obstacle, 0 while lifted")
        .def_property_readonly(
            "arc_length", [=](const PathResults& r) { return r.tabulate(arcLength); },
            "(n, obstacles) [m], of all arcs together; 0 while lifted")
        .def_property_readonly(
            "P", [](const PathResults& r) { return r.getContactPoints(true); },
            "(n, obstacles, 3): where the path first meets each obstacle [m]; NaN while lifted")
        .def_property_readonly(
            "Q", [](const PathResults& r) { return r.getContactPoints(false); },
            "(n, obstacles, 3): where it last leaves [m]; NaN while lifted")
        .def_property_readonly("unit_forces", &PathResults::calcForces,
                               "(n, elements, 6): moment about the element's origin [m] and force [1] at unit tension")
        .def("rate", &PathResults::calcRates, arg("velocities"),
             "Exact rates of the lengths, (n,) [m/s].\n\n"
             "velocities   (n, elements, 6): angular velocity [rad/s] and velocity of the origin [m/s] of each element")
        .def("variation", &PathResults::calcVariation, arg("index"), arg("velocities"),
             "How path `index` answers to a motion of its elements, by the implicit function theorem.\n\n"
             "velocities   (elements, 6), as for rate()\n\n"
             "Returns a dict: is_regular (False where the path is on the verge of instability; rates are then zero),\n"
             "length_rate [m/s], xi_rate (elements, 4) of the natural corrections, P_rate and Q_rate (elements, 3) "
             "[m/s],\n"
             "unit_force_rate (elements, 6) of moment [m/s] and force [1/s].")
        .def("explain", &PathResults::explain, arg("index"),
             "The status of path `index` in a sentence: which condition is broken, at which obstacle and where.")
        .def("points", &PathResults::calcPoints, arg("index"), arg("max_angle") = 0.1,
             "Points along path `index`, (k, 3) [m]; arcs turn by at most max_angle [rad] between points.");
}

}  // namespace tautline::python
