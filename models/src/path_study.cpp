// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/path_study.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model_skeleton.h"
#include "tautline/error.h"
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
    model.setRestingPose(state);
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

std::vector<ObstacleAnswer> getObstacles(const Cable& cable, const PathSolution& solution) {
    std::vector<ObstacleAnswer> obstacles;
    const PathProblem& problem = cable.getPathProblem();
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint()) continue;
        const ObstacleContact& contact = solution.contacts[static_cast<std::size_t>(e)];
        obstacles.push_back({contact.isTouched, contact.getNumArcs(), contact.isSwitchedOff, contact.calcArcLength()});
    }
    return obstacles;
}

}  // namespace

class PathStudy::Implementation {
public:
    Implementation(const ModelDescription& description, const std::function<bool(const std::string&)>& isWanted)
        : m_system(description) {
        if (hasLoops(description)) m_skeleton.emplace(description);
        const auto isStudied = [&](const std::string& name) { return !isWanted || isWanted(name); };
        m_state = m_system.makeDefaultState();
        m_system.getCables().setContactMode(m_state, ContactMode::Free);
        for (const std::string& name : getModel().getCoordinateNames())
            m_slots.push_back(&getModel().getCoordinateSlot(name));
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
        m_coupling = CoordinateCoupling(getModel());
    }

    const std::vector<StudiedPath>& getPaths() const { return m_paths; }
    const BuiltModel& getModel() const { return m_system.getModel(); }

    CorePath getCorePath(std::size_t path) const {
        if (path >= m_cables.size()) return {};
        const Cable& cable = m_cables[path];
        return {&cable.getPathProblem(), &cable.getPathPose(m_state), &cable.getSolution(m_state)};
    }

    PoseAnswer solve(const ModelPose& pose, int place) {
        requireFinite(pose.values, "the value");
        requireFinite(pose.speeds, "the speed");
        startFromLast(place);
        PoseAnswer answer;
        answer.constraintFault = realizePose(pose);
        m_lastPlace = place;
        answer.values.reserve(m_slots.size()), answer.speeds.reserve(m_slots.size());
        for (const BuiltModel::CoordinateSlot* slot : m_slots) {
            const SimTK::MobilizedBody& body = getModel().getMatter().getMobilizedBody(slot->body);
            answer.values.push_back(body.getOneQ(m_state, slot->q));
            answer.speeds.push_back(body.getOneU(m_state, slot->u));
        }
        m_coupling.update(m_state);
        m_screws.update(getModel().getMatter(), m_state);
        answer.paths.resize(m_paths.size());
        for (std::size_t i = 0; i < m_cables.size(); ++i) answerCable(i, answer.paths[i]);
        for (std::size_t i = 0; i < m_functions.size(); ++i) answerFunction(i, answer.paths[m_cables.size() + i]);
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

    /** Has the next paths continued from those of the last pose, or found anew where a block begins. */
    void startFromLast(int place) {
        require(place >= 0, "path study: the place of a pose is ", place, ", but must not be negative");
        if (place % kPosesPerBlock == 0) return m_system.getCables().forgetPaths(m_state);
        require(place == m_lastPlace + 1, "path study: the pose at place ", place, " comes after that at ", m_lastPlace,
                ", but poses of a block must be solved one after another");
        m_system.getCables().acceptPaths(m_state);
    }

    /** Realizes all in a pose; where loops have to be closed, this is found in the skeleton, where no path is solved on
    the way.
    @return why constraints do not hold; empty if they do */
    std::string realizePose(const ModelPose& pose) {
        m_lastPlace = kNone;
        std::string fault;
        if (m_skeleton) {
            fault = findClosedPose(pose);
            m_state.setTime(pose.time);
            m_state.updQ() = m_skeleton->state.getQ();
            m_state.updU() = m_skeleton->state.getU();
        } else {
            setPose(getModel(), pose, m_state);
        }
        m_system.getSystem().realize(m_state, Stage::Position);
        return fault;
    }

    std::string findClosedPose(const ModelPose& pose) {
        State& state = m_skeleton->state;
        setPose(m_skeleton->model, pose, state);
        try {
            m_skeleton->system.project(state, kConstraintTolerance);
        } catch (const std::exception&) {
            setPose(m_skeleton->model, pose, state);
            m_skeleton->system.realize(state, Stage::Position);
            return "the constraints of the model cannot be met near these coordinates: they are broken by " +
                   std::to_string(state.getQErr().normInf());
        }
        return "";
    }

    void answerCable(std::size_t i, PathAnswer& answer) {
        const Cable& cable = m_cables[i];
        const PathSolution& solution = cable.getSolution(m_state);
        answer.length = solution.length;
        answer.status = solution.status;
        answer.deviation = solution.deviation.kind;
        answer.keepsSides = keepsSides(cable, solution);
        if (answer.status != PathStatus::Solved || !answer.followsHints())
            answer.explanation = cable.explainStatus(m_state);
        if (!m_paths[i].obstacles.empty()) answer.obstacles = getObstacles(cable, solution);
        cable.calcUnitMobilityForces(m_state, m_screws, m_unitForces);
        answer.rate = -(~m_unitForces * m_state.getU());  // which is what these forces are
        addArms(m_coordinates[i], answer);
    }

    void answerFunction(std::size_t i, PathAnswer& answer) {
        const FunctionBasedPath& function = m_functions[i];
        answer.length = function.calcLength(m_state);
        answer.rate = function.calcLengthRate(m_state);
        answer.status = PathStatus::Solved;
        m_unitForces.resize(m_state.getNU());
        m_unitForces = 0;
        const std::vector<double> arms = function.calcMomentArms(m_state);
        for (std::size_t k = 0; k < arms.size(); ++k) {
            const auto& slot = getModel().getCoordinateSlot(function.getCoordinateNames()[k]);
            m_unitForces[getModel().getMatter().getMobilizedBody(slot.body).getFirstUIndex(m_state) + slot.u] = arms[k];
        }
        addArms(m_coordinates[m_cables.size() + i], answer);
    }

    void addArms(const std::vector<int>& coordinates, PathAnswer& answer) const {
        answer.geometricArms.reserve(coordinates.size()), answer.effectiveArms.reserve(coordinates.size());
        for (const int coordinate : coordinates) {
            answer.geometricArms.push_back(m_coupling.calcGeometricArm(m_unitForces, coordinate));
            answer.effectiveArms.push_back(m_coupling.calcEffectiveArm(m_unitForces, coordinate));
        }
    }

    static constexpr int kNone = -2;  ///< no pose, nor that before the first

    ModelSystem m_system;
    State m_state;                            ///< of m_system, with the cables that are not wanted disabled
    std::optional<ModelSkeleton> m_skeleton;  ///< where loops of bodies are to be closed
    std::vector<const BuiltModel::CoordinateSlot*> m_slots;
    std::vector<Cable> m_cables;
    std::vector<FunctionBasedPath> m_functions;
    std::vector<StudiedPath> m_paths;             ///< of the cables, then of the functions
    std::vector<std::vector<int>> m_coordinates;  ///< by path: indices of those that it crosses
    CoordinateCoupling m_coupling;                ///< in the pose that was solved last, as are the screws
    MobilityScrews m_screws;
    SimTK::Vector m_unitForces;
    int m_lastPlace = kNone;
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

std::vector<std::string> PathStudy::getCoordinatePaths() const {
    std::vector<std::string> paths;
    for (const std::string& name : getCoordinateNames())
        paths.push_back(m_implementation->getModel().getCoordinateSlot(name).path);
    return paths;
}

PoseAnswer PathStudy::solve(const ModelPose& pose, int place) {
    return m_implementation->solve(pose, place);
}

CorePath PathStudy::getCorePath(std::size_t path) const {
    return m_implementation->getCorePath(path);
}

}  // namespace tautline::models
