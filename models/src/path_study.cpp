// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/path_study.h"

#include <algorithm>
#include <cmath>

#include "model_skeleton.h"
#include "tautline/models/coordinate_coupling.h"
#include "tautline/models/model_system.h"

namespace tautline::models {
namespace {

using SimTK::Stage;
using SimTK::State;

/** To which constraints are met: of angles [rad] and distances [m], below what a length shows. */
constexpr double kConstraintTolerance = 1e-10;

void requireFinite(const std::map<std::string, double>& numbers, const char* what) {
    for (const auto& [name, number] : numbers)
        if (!std::isfinite(number))
            throw ModelError(std::string(what) + " of coordinate '" + name + "' is " + std::to_string(number) +
                             ", but must be finite");
}

/** Sets all coordinates of a pose; constraints other than couplers are not met yet. */
void setPose(const BuiltModel& model, const ModelPose& pose, State& state) {
    state.setTime(pose.time);
    model.setDefaultPose(state);
    for (const std::string& name : model.getCoordinateNames())
        if (!model.getCoordinateSlot(name).prescribedMotion) model.setCoordinateSpeed(state, name, 0.0);
    for (const auto& [name, value] : pose.values) model.setCoordinate(state, name, value);
    for (const auto& [name, speed] : pose.speeds) model.setCoordinateSpeed(state, name, speed);
    model.applyCouplers(state);
}

bool hasLoops(const ModelDescription& description) {
    return std::any_of(description.constraints.begin(), description.constraints.end(),
                       [](const auto& constraint) { return !std::holds_alternative<CoordinateCoupler>(constraint); });
}

std::vector<std::string> getObstacleNames(const Cable& cable) {
    std::vector<std::string> names;
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e)
        if (cable.isObstacle(e)) names.push_back(cable.getElementName(e));
    return names;
}

/** PathAnswer::keepsSides */
bool keepsSides(const Cable& cable, const PathSolution& solution) {
    using Kind = RouteDeviation::Kind;
    const RouteDeviation& deviation = solution.deviation;
    if (deviation.kind == Kind::None || deviation.kind == Kind::Near) return true;
    const bool isTouched = solution.contacts[static_cast<std::size_t>(deviation.element)].isTouched;
    const bool isEndless = cable.getPathProblem().getElement(deviation.element).isEndless;
    return deviation.kind == Kind::Side && !isTouched && !isEndless;
}

std::vector<ObstacleAnswer> getObstacles(const Cable& cable, const State& state) {
    std::vector<ObstacleAnswer> obstacles;
    const PathSolution& solution = cable.getSolution(state);
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e)
        if (cable.isObstacle(e))
            obstacles.push_back({cable.isTouched(state, e),
                                 solution.contacts[static_cast<std::size_t>(e)].isSwitchedOff,
                                 cable.isTouched(state, e) ? cable.getArcLength(state, e) : 0});
    return obstacles;
}

}  // namespace

class PathStudy::Implementation {
public:
    Implementation(const ModelDescription& description, const std::function<bool(const std::string&)>& isWanted)
        : m_system(description), m_skeleton(description), m_hasLoops(hasLoops(description)) {
        const auto isStudied = [&](const std::string& name) { return !isWanted || isWanted(name); };
        m_state = m_system.makeDefaultState();
        for (const ModelSystem::PathView& view : m_system.getPaths()) {
            if (isStudied(view.name)) {
                m_cables.push_back(view.cable);
                add({view.name, view.path, getObstacleNames(view.cable), view.coordinates, view.wraps});
            } else {
                view.cable.disable(m_state);
            }
        }
        for (const ModelSystem::FunctionPathSlot& slot : m_system.getFunctionPaths()) {
            if (!isStudied(slot.name)) continue;
            m_functions.push_back(slot.function);
            add({slot.name, slot.path, {}, slot.coordinates, {}});
        }
    }

    const std::vector<StudiedPath>& getPaths() const { return m_paths; }
    const BuiltModel& getModel() const { return m_system.getModel(); }

    CorePath getCorePath(std::size_t path) const {
        if (path >= m_cables.size()) return {};
        const Cable& cable = m_cables[path];
        return {&cable.getPathProblem(), &cable.getPathPose(m_state), &cable.getSolution(m_state)};
    }

    PoseAnswer solve(const ModelPose& pose) {
        requireFinite(pose.values, "the value");
        requireFinite(pose.speeds, "the speed");
        PoseAnswer answer;
        answer.constraintFault = realizePose(pose);
        for (const std::string& name : getModel().getCoordinateNames()) {
            answer.values.push_back(getModel().getCoordinate(m_state, name));
            answer.speeds.push_back(getModel().getCoordinateSpeed(m_state, name));
        }
        const CoordinateCoupling coupling(m_skeleton.model, m_skeleton.state);
        for (std::size_t i = 0; i < m_cables.size(); ++i)
            answer.paths.push_back(answerCable(m_cables[i], m_coordinates[i], coupling));
        for (std::size_t i = 0; i < m_functions.size(); ++i)
            answer.paths.push_back(answerFunction(m_functions[i], m_coordinates[m_cables.size() + i], coupling));
        return answer;
    }

private:
    void add(StudiedPath path) {
        std::vector<int> indices;
        const std::vector<std::string>& all = getModel().getCoordinateNames();
        for (const std::string& coordinate : path.coordinates)
            indices.push_back(static_cast<int>(std::find(all.begin(), all.end(), coordinate) - all.begin()));
        m_coordinates.push_back(std::move(indices));
        m_paths.push_back(std::move(path));
    }

    /** Finds the pose in the skeleton, where no path is solved on the way, and realizes all there.
    @return why constraints do not hold; empty if they do */
    std::string realizePose(const ModelPose& pose) {
        setPose(m_skeleton.model, pose, m_skeleton.state);
        std::string fault;
        if (m_hasLoops) try {
                m_skeleton.system.project(m_skeleton.state, kConstraintTolerance);
            } catch (const std::exception&) {
                setPose(m_skeleton.model, pose, m_skeleton.state);
                m_skeleton.system.realize(m_skeleton.state, Stage::Position);
                fault = "the constraints of the model cannot be met near these coordinates: they are broken by " +
                        std::to_string(m_skeleton.state.getQErr().normInf());
            }
        m_skeleton.system.realize(m_skeleton.state, Stage::Velocity);
        m_state.setTime(pose.time);
        m_state.updQ() = m_skeleton.state.getQ();
        m_state.updU() = m_skeleton.state.getU();
        m_system.getSystem().realize(m_state, Stage::Velocity);
        return fault;
    }

    PathAnswer answerCable(const Cable& cable, const std::vector<int>& coordinates,
                           const CoordinateCoupling& coupling) {
        PathAnswer answer;
        const PathSolution& solution = cable.getSolution(m_state);
        answer.length = cable.getLength(m_state);
        answer.rate = cable.getLengthRate(m_state);
        answer.status = cable.getStatus(m_state);
        answer.deviation = solution.deviation.kind;
        answer.keepsSides = keepsSides(cable, solution);
        if (answer.status != PathStatus::Solved || !answer.followsHints())
            answer.explanation = cable.explainStatus(m_state);
        answer.obstacles = getObstacles(cable, m_state);
        cable.calcUnitMobilityForces(m_state, m_unitForces);
        addArms(coordinates, coupling, answer);
        return answer;
    }

    PathAnswer answerFunction(const FunctionBasedPath& function, const std::vector<int>& coordinates,
                              const CoordinateCoupling& coupling) {
        PathAnswer answer;
        answer.length = function.calcLength(m_state);
        answer.rate = function.calcLengthRate(m_state);
        answer.status = PathStatus::Solved;
        m_unitForces.resize(m_state.getNU());
        m_unitForces = 0;
        const std::vector<double> arms = function.calcMomentArms(m_state);
        for (std::size_t i = 0; i < arms.size(); ++i) {
            const auto& slot = getModel().getCoordinateSlot(function.getCoordinateNames()[i]);
            m_unitForces[getModel().getMatter().getMobilizedBody(slot.body).getFirstUIndex(m_state) + slot.u] = arms[i];
        }
        addArms(coordinates, coupling, answer);
        return answer;
    }

    void addArms(const std::vector<int>& coordinates, const CoordinateCoupling& coupling, PathAnswer& answer) const {
        for (const int coordinate : coordinates) {
            answer.geometricArms.push_back(coupling.calcGeometricArm(m_unitForces, coordinate));
            answer.effectiveArms.push_back(coupling.calcEffectiveArm(m_unitForces, coordinate));
        }
    }

    ModelSystem m_system;
    State m_state;  ///< of m_system, with the cables that are not wanted disabled
    ModelSkeleton m_skeleton;
    bool m_hasLoops;
    std::vector<Cable> m_cables;
    std::vector<FunctionBasedPath> m_functions;
    std::vector<StudiedPath> m_paths;             ///< of the cables, then of the functions
    std::vector<std::vector<int>> m_coordinates;  ///< by path: indices of those that it crosses
    SimTK::Vector m_unitForces;
};

PathStudy::PathStudy(const ModelDescription& description, const std::function<bool(const std::string&)>& isWanted)
    : m_implementation(std::make_unique<Implementation>(description, isWanted)) {}
PathStudy::~PathStudy() = default;
PathStudy::PathStudy(PathStudy&&) noexcept = default;
PathStudy& PathStudy::operator=(PathStudy&&) noexcept = default;

const std::vector<StudiedPath>& PathStudy::getPaths() const {
    return m_implementation->getPaths();
}

const std::vector<std::string>& PathStudy::getCoordinateNames() const {
    return m_implementation->getModel().getCoordinateNames();
}

PoseAnswer PathStudy::solve(const ModelPose& pose) {
    return m_implementation->solve(pose);
}

CorePath PathStudy::getCorePath(std::size_t path) const {
    return m_implementation->getCorePath(path);
}

}  // namespace tautline::models
