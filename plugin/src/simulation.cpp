// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tautline/paths/path_explanation.h"
#include "tautline/simbody/clearance_probe.h"

namespace tautline {
namespace {

using models::ModelSystem;
using SimTK::Stage;
using SimTK::State;

/** What muscles.sto holds of each muscle, by OpenSim's names. */
struct MuscleColumn {
    const char* name;
    double (*get)(const MuscleDynamics&, const MuscleEnergy&);
};
constexpr MuscleColumn kMuscleColumns[] = {
    {"|activation", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.activation; }},
    {"|fiber_length", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.lengths.fiberLength; }},
    {"|fiber_velocity", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.fiberVelocity; }},
    {"|pennation_angle", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.lengths.calcPennation(); }},
    {"|tendon_length", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.lengths.tendonLength; }},
    {"|active_fiber_force", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.activeFiberForce; }},
    {"|passive_fiber_force", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.passiveFiberForce; }},
    {"|damping_fiber_force", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.dampingFiberForce; }},
    {"|tendon_force", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.tendonForce; }},
    {"|fiber_active_power", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.fiberActivePower; }},
    {"|fiber_passive_power", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.fiberPassivePower; }},
    {"|fiber_damping_power", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.fiberDampingPower; }},
    {"|tendon_power", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.tendonPower; }},
    {"|muscle_power", [](const MuscleDynamics& d, const MuscleEnergy&) { return d.musclePower; }},
    {"|fiber_potential_energy", [](const MuscleDynamics&, const MuscleEnergy& e) { return e.fiber; }},
    {"|tendon_potential_energy", [](const MuscleDynamics&, const MuscleEnergy& e) { return e.tendon; }}};

/** Turns states of a simulation into rows and counts. */
class Recorder {
public:
    Recorder(const ModelSystem& model, SimulationResult& result, std::function<void(const State&)> watchRow)
        : m_model(model), m_paths(model.getPaths()), m_result(result), m_watchRow(std::move(watchRow)) {
        m_result.summaries.resize(m_paths.size());
        m_result.muscleSummaries.resize(model.getMuscles().size());
        m_result.events = "time,path,obstacle,kind\n";
        m_result.states.name = "states", m_result.paths.name = "paths", m_result.clearances.name = "clearances";
        m_result.muscles.name = "muscles";
        labelStates();
        labelPaths();
        labelMuscles();
        labelClearances();
    }

    void recordRow(const State& state) {
        m_model.getSystem().realize(state, Stage::Velocity);
        recordStates(state);
        recordPaths(state);
        recordMuscles(state);
        recordClearances(state);
        watchFibers(state);
        if (m_watchRow) m_watchRow(state);
    }

    /** Has the cables count an accepted step, and says why the first is degraded that is. */
    void inspectStep(const State& state) {
        ++m_result.acceptedSteps;
        if (!m_paths.empty()) m_paths.front().cable.getSubsystem().countStep(state);
        for (std::size_t i = 0; i < m_paths.size(); ++i) {
            std::string& reason = m_result.summaries[i].firstDegradation;
            if (reason.empty() && m_paths[i].cable.getStatistics().numDegradedSteps > 0)
                reason = "at " + std::to_string(state.getTime()) +
                         " s: " + getName(m_paths[i].cable.calcStatus(state)) + ", " +
                         m_paths[i].cable.explainStatus(state);
        }
        watchFibers(state);
    }

    void recordEvent(std::size_t path, const ContactEvent& event) {
        using Kind = ContactEvent::Kind;
        if (event.kind == Kind::Made) ++m_result.summaries[path].contactsMade;
        if (event.kind == Kind::Lost) ++m_result.summaries[path].contactsLost;
        if (event.kind == Kind::Slipped) {
            ++m_result.summaries[path].slips;
            m_result.summaries[path].slippedLength += event.lengthBefore - event.lengthAfter;
        }
        m_result.events += toText(event.time) + "," + m_paths[path].path + "," +
                           m_paths[path].cable.getElementName(event.obstacle) + "," + describeKind(event.kind) + "\n";
    }

private:
    static const char* describeKind(ContactEvent::Kind kind) {
        switch (kind) {
            case ContactEvent::Kind::Made:
                return "touchdown";
            case ContactEvent::Kind::Lost:
                return "liftoff";
            case ContactEvent::Kind::Split:
                return "split";
            case ContactEvent::Kind::LeftHole:
                return "left_hole";
            case ContactEvent::Kind::Slipped:
                return "slipped";
        }
        return "";
    }

    /** Calls a function with the element index of each obstacle and whether its surface is parametric. */
    template <class Function>
    static void forEachObstacle(const ModelSystem::PathView& path, Function&& act) {
        std::size_t wrap = 0;
        for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
            if (path.cable.isObstacle(e)) act(e, path.wraps[wrap++].form == models::SurfaceForm::Parametric);
    }

    void labelStates() {
        m_result.states.labels = {"time"};
        for (const std::string& name : m_model.getModel().getCoordinateNames()) {
            m_result.states.labels.push_back(name + "/value");
            m_result.states.labels.push_back(name + "/speed");
        }
        for (const auto& slot : m_model.getMuscles()) {
            if (hasActivation(slot)) m_result.states.labels.push_back(slot.path + "/activation");
            if (hasFiber(slot)) m_result.states.labels.push_back(slot.path + "/fiber_length");
        }
    }

    // Which of them are states.
    static bool hasActivation(const ModelSystem::MuscleSlot& slot) {
        return !slot.muscle.getParameters().ignoresActivationDynamics;
    }
    static bool hasFiber(const ModelSystem::MuscleSlot& slot) { return !slot.muscle.getModel().hasRigidTendon(); }

    void labelMuscles() {
        m_result.muscles.labels = {"time"};
        for (const auto& slot : m_model.getMuscles())
            for (const MuscleColumn& column : kMuscleColumns)
                m_result.muscles.labels.push_back(slot.path + column.name);
    }

    void labelPaths() {
        m_result.paths.labels = {"time"};
        for (const auto& path : m_paths) {
            for (const char* quantity : {"|length", "|rate", "|tension", "|path_error"})
                m_result.paths.labels.push_back(path.path + quantity);
            for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
                if (path.cable.isObstacle(e))
                    m_result.paths.labels.push_back(path.path + "|contact." + path.cable.getElementName(e));
            for (const std::string& name : m_model.getModel().getCoordinateNames())
                m_result.paths.labels.push_back(path.path + "|moment_arm." + name);
        }
    }

    void labelClearances() {
        m_result.clearances.labels = {"time"};
        for (const auto& path : m_paths)
            forEachObstacle(path, [&](CableElementIndex e, bool isParametric) {
                m_probes.emplace_back(path.cable, e);
                std::vector<const char*> quantities{"|distance.", "|line_coordinate.", "|x.", "|y.", "|z."};
                if (isParametric) quantities.insert(quantities.end(), {"|u.", "|v."});
                for (const char* quantity : quantities)
                    m_result.clearances.labels.push_back(path.path + quantity + path.cable.getElementName(e));
            });
    }

    void recordStates(const State& state) {
        std::vector<double> row = {state.getTime()};
        for (const std::string& name : m_model.getModel().getCoordinateNames()) {
            row.push_back(m_model.getModel().getCoordinate(state, name));
            row.push_back(m_model.getModel().getCoordinateSpeed(state, name));
        }
        for (const auto& slot : m_model.getMuscles()) {
            if (hasActivation(slot)) row.push_back(slot.muscle.getActivation(state));
            if (hasFiber(slot)) row.push_back(slot.muscle.getFiberLength(state));
        }
        m_result.states.rows.push_back(row);
    }

    void recordMuscles(const State& state) {
        std::vector<double> row = {state.getTime()};
        for (const auto& slot : m_model.getMuscles()) {
            const MuscleDynamics dynamics = slot.muscle.calcDynamics(state);
            const MuscleEnergy energy = slot.muscle.calcEnergy(state);
            for (const MuscleColumn& column : kMuscleColumns) row.push_back(column.get(dynamics, energy));
        }
        m_result.muscles.rows.push_back(row);
    }

    void recordPaths(const State& state) {
        std::vector<double> row = {state.getTime()};
        for (const auto& path : m_paths) {
            row.push_back(path.cable.getLength(state));
            row.push_back(path.cable.getLengthRate(state));
            row.push_back(path.force.getTension(state));
            row.push_back(path.cable.getPathError(state));
            for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
                if (path.cable.isObstacle(e)) row.push_back(path.cable.isTouched(state, e));
            const std::vector<double> arms = m_model.calcMomentArms(state, path.cable);
            row.insert(row.end(), arms.begin(), arms.end());
        }
        m_result.paths.rows.push_back(row);
    }

    void watchFibers(const State& state) {
        for (std::size_t i = 0; i < m_result.muscleSummaries.size(); ++i) {
            MuscleSummary& summary = m_result.muscleSummaries[i];
            const double length = m_model.getMuscles()[i].muscle.calcLengths(state).normFiberLength;
            if (length > summary.longestFiber) summary.longestFiber = length, summary.longestAt = state.getTime();
        }
    }

    void recordClearances(const State& state) {
        std::vector<double> row = {state.getTime()};
        std::size_t probe = 0;
        for (const auto& path : m_paths)
            forEachObstacle(path, [&](CableElementIndex, bool isParametric) {
                LineClearance clearance = m_probes[probe++].calcClearance(state);
                if (!clearance.found) {
                    clearance.distance = clearance.lineCoordinate = kNaN;
                    clearance.C = {Vec3::Constant(kNaN), Vec2::Constant(kNaN), 0};
                }
                const Vec3& C = clearance.C.p;
                row.insert(row.end(), {clearance.distance, clearance.lineCoordinate, C.x(), C.y(), C.z()});
                if (isParametric) row.insert(row.end(), {clearance.C.uv[0], clearance.C.uv[1]});
            });
        m_result.clearances.rows.push_back(row);
    }

    const ModelSystem& m_model;
    std::vector<ModelSystem::PathView> m_paths;
    SimulationResult& m_result;
    std::function<void(const State&)> m_watchRow;
    std::vector<ClearanceProbe> m_probes;  ///< one per obstacle, path by path
};

/** Tells a recorder of the contact events of paths as long as both are there. */
class ListenerScope {
public:
    ListenerScope(const std::vector<ModelSystem::PathView>& paths, Recorder& recorder) : m_paths(paths) {
        for (std::size_t i = 0; i < paths.size(); ++i)
            paths[i].cable.setContactListener(
                [&recorder, i](const ContactEvent& event) { recorder.recordEvent(i, event); });
    }
    ListenerScope(const ListenerScope&) = delete;
    ~ListenerScope() {
        for (const ModelSystem::PathView& path : m_paths) path.cable.setContactListener(nullptr);
    }

private:
    const std::vector<ModelSystem::PathView>& m_paths;
};

void recordIterations(const ModelSystem::PathView& path, const IteratedPath& iterated, std::string& csv) {
    if (csv.empty()) csv = "path,iteration,obstacle,error\n";
    for (std::size_t i = 0; i < iterated.iterations.size(); ++i) {
        const auto write = [&](const std::string& obstacle, double error) {
            csv += path.path + "," + std::to_string(i) + "," + obstacle + "," + toText(error) + "\n";
        };
        write("all", iterated.iterations[i].error);
        for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
            if (path.start[e]) write(path.cable.getElementName(e), iterated.iterations[i].obstacleErrors[e]);
    }
}

/** Has every path for which the model gives geodesics begin with what the iteration makes of them. */
void startPaths(const ModelSystem& model, State& state, SimulationResult& result) {
    for (const ModelSystem::PathView& path : model.getPaths()) {
        if (path.start.empty()) continue;
        model.getSystem().realize(state, Stage::Position);
        const PathProblem& problem = path.cable.getPathProblem();
        const PathPose& pose = path.cable.getPathPose(state);
        const IteratedPath iterated = iteratePath(problem, pose, path.start);
        recordIterations(path, iterated, result.starts);
        PathSolution solution = makePathSolution(iterated.start);
        PathSolverOptions options = path.cable.getOptions();
        options.allowsColdStart = false;  // that would be another path
        PathSolver solver(options);
        solver.solveKeepingContacts(problem, pose, solution);
        if (solution.status == PathStatus::Solved) solver.solve(problem, pose, solution);
        if (solution.status != PathStatus::Solved)
            throw std::runtime_error("path '" + path.name + "': the start that the model gives leads to no shortest " +
                                     "path: " + getName(solution.status) + ", " +
                                     explainStatus(problem, pose, solution));
        path.cable.continueFrom(state, solution);
    }
}

void setExcitations(ModelSystem& model, const std::map<std::string, Excitation>& excitations) {
    for (auto& slot : model.updMuscles()) {
        const Excitation excitation = excitations.at(slot.name);
        slot.muscle.setExcitationFunction([excitation](const State& state) { return excitation(state.getTime()); });
    }
}

/** Steps to the end of the run, recording a row at every multiple of the interval. */
void integrate(ModelSystem& model, const State& initialState, const SimulationOptions& options, Recorder& recorder,
               const std::function<void(double)>& reportProgress, State& finalState) {
    SimTK::RungeKuttaMersonIntegrator integrator(model.getSystem());
    integrator.setAccuracy(options.accuracy);
    integrator.setReturnEveryInternalStep(true);
    SimTK::TimeStepper stepper(model.getSystem(), integrator);
    stepper.setReportAllSignificantStates(true);
    stepper.initialize(initialState);
    const int numRows = options.calcNumRows();
    recorder.recordRow(stepper.getState());
    for (int row = 1; row <= numRows; ++row) {
        // Times as multiples, so that they do not drift.
        const double time = row == numRows ? options.duration : row * options.interval;
        while (stepper.getTime() < time) {
            stepper.stepTo(time);
            recorder.inspectStep(stepper.getState());
        }
        recorder.recordRow(stepper.getState());
        reportProgress(static_cast<double>(row) / numRows);
    }
    finalState = stepper.getState();
    model.getSystem().realize(finalState, Stage::Velocity);
}

}  // namespace

SimulationResult simulate(ModelSystem& model, const std::map<std::string, Excitation>& excitations,
                          const SimulationOptions& options, const std::function<void(double)>& reportProgress,
                          const std::function<void(const State&)>& watchRow) {
    options.validate();
    SimulationResult result;
    const std::vector<ModelSystem::PathView> paths = model.getPaths();
    for (const ModelSystem::PathView& path : paths) path.cable.resetStatistics();
    setExcitations(model, excitations);
    State state = model.makeDefaultState();
    model.getSystem().realize(state, Stage::Position);
    model.requireRegularPose(state);
    startPaths(model, state, result);
    const std::vector<MuscleEquilibrium> starts = model.equilibrateMuscles(state);
    Recorder recorder(model, result, watchRow);
    for (std::size_t i = 0; i < starts.size(); ++i) result.muscleSummaries[i].start = starts[i];
    const ListenerScope listening(paths, recorder);
    const auto start = std::chrono::steady_clock::now();
    integrate(model, state, options, recorder, reportProgress, result.finalState);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; i < paths.size(); ++i) {
        result.summaries[i].statistics = paths[i].cable.getStatistics();
        result.wrappingSeconds += result.summaries[i].statistics.seconds;
    }
    return result;
}

}  // namespace tautline
