// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "tautline/models/coordinate_coupling.h"
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
    Recorder(const ModelSystem& model, bool recordsAllArms, SimulationResult& result,
             std::function<void(const State&)> watchRow)
        : m_model(model), m_paths(model.getPaths()), m_result(result), m_watchRow(std::move(watchRow)) {
        findArms(recordsAllArms);
        m_result.summaries.resize(m_paths.size());
        m_numNotSolved.resize(m_paths.size());
        m_result.muscleSummaries.resize(model.getMuscles().size());
        m_result.events = "time,path,obstacle,kind,length_change\n";
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
        for (std::size_t i = 0; i < m_paths.size(); ++i) judge(i, state);
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
        if (event.kind == Kind::SwitchedOff || event.kind == Kind::SwitchedOn) ++m_result.summaries[path].switches;
        m_result.events += toText(event.time) + "," + m_paths[path].path + "," +
                           m_paths[path].cable.getElementName(event.obstacle) + "," + describeKind(event.kind) + "," +
                           toText(event.lengthAfter - event.lengthBefore) + "\n";
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
            case ContactEvent::Kind::Joined:
                return "joined";
            case ContactEvent::Kind::ArcMade:
                return "arc_made";
            case ContactEvent::Kind::ArcLost:
                return "arc_lost";
            case ContactEvent::Kind::LeftHole:
                return "left_hole";
            case ContactEvent::Kind::Slipped:
                return "slipped";
            case ContactEvent::Kind::SwitchedOff:
                return "switched_off";
            case ContactEvent::Kind::SwitchedOn:
                return "switched_on";
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

    void judge(std::size_t i, const State& state) {
        PathSummary& summary = m_result.summaries[i];
        const Cable& cable = m_paths[i].cable;
        const long before = std::exchange(m_numNotSolved[i], cable.getStatistics().numDegradedSteps);
        if (m_numNotSolved[i] == before) return;
        const PathStatus status = cable.calcStatus(state);
        if (status == PathStatus::EndInside || summary.degradedSteps++ > 0) return;
        summary.firstDegradation =
            "at " + std::to_string(state.getTime()) + " s: " + getName(status) + ", " + cable.explainStatus(state);
    }

    void labelStates() {
        m_result.states.labels = {"time"};
        for (const std::string& name : m_model.getModel().getCoordinateNames()) {
            const std::string& path = m_model.getModel().getCoordinateSlot(name).path;
            m_result.states.labels.push_back(path + "/value");
            m_result.states.labels.push_back(path + "/speed");
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

    /** Of each path the coordinates about which its moment arms are recorded. */
    void findArms(bool recordsAllArms) {
        const std::vector<std::string>& names = m_model.getModel().getCoordinateNames();
        for (const auto& path : m_paths) {
            m_armCoordinates.emplace_back();
            for (std::size_t i = 0; i < names.size(); ++i)
                if (recordsAllArms ||
                    std::find(path.coordinates.begin(), path.coordinates.end(), names[i]) != path.coordinates.end())
                    m_armCoordinates.back().push_back(static_cast<int>(i));
        }
    }

    void labelPaths() {
        const std::vector<std::string>& names = m_model.getModel().getCoordinateNames();
        m_result.paths.labels = {"time"};
        for (std::size_t i = 0; i < m_paths.size(); ++i) {
            const auto& path = m_paths[i];
            for (const char* quantity : {"|length", "|rate", "|tension", "|path_error"})
                m_result.paths.labels.push_back(path.path + quantity);
            for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
                if (path.cable.isObstacle(e))
                    m_result.paths.labels.push_back(path.path + "|contact." + path.cable.getElementName(e));
            for (const int coordinate : m_armCoordinates[i])
                m_result.paths.labels.push_back(path.path + "|moment_arm." +
                                                names[static_cast<std::size_t>(coordinate)]);
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
        const models::CoordinateCoupling coupling(m_model.getModel(), state);
        for (std::size_t i = 0; i < m_paths.size(); ++i) {
            const auto& path = m_paths[i];
            row.push_back(path.cable.getLength(state));
            row.push_back(path.cable.getLengthRate(state));
            row.push_back(path.force.getTension(state));
            row.push_back(path.cable.getPathError(state));
            for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
                if (path.cable.isObstacle(e)) row.push_back(path.cable.getNumArcs(state, e));
            path.cable.calcUnitMobilityForces(state, m_unitForces);
            for (const int coordinate : m_armCoordinates[i])
                row.push_back(coupling.calcEffectiveArm(m_unitForces, coordinate));
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
                    clearance.C = {Vector3::Constant(kNaN), Vector2::Constant(kNaN), 0};
                }
                const Vector3& C = clearance.C.p;
                row.insert(row.end(), {clearance.distance, clearance.lineCoordinate, C.x(), C.y(), C.z()});
                if (isParametric) row.insert(row.end(), {clearance.C.uv[0], clearance.C.uv[1]});
            });
        m_result.clearances.rows.push_back(row);
    }

    const ModelSystem& m_model;
    std::vector<ModelSystem::PathView> m_paths;
    SimulationResult& m_result;
    std::function<void(const State&)> m_watchRow;
    std::vector<ClearanceProbe> m_probes;            ///< one per obstacle, path by path
    std::vector<std::vector<int>> m_armCoordinates;  ///< by path: indices of coordinates
    std::vector<long> m_numNotSolved;                ///< by path: steps so far with a status other than solved
    SimTK::Vector m_unitForces;
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
        PathSolver solver(path.cable.getOptions().withoutSearch());  // which might find another path
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

/** Which coordinate or muscle keeps a simulation from going on, in words. @param state   the last that was accepted */
std::string describeStop(const ModelSystem& model, State& state) {
    std::string culprit;
    double largest = 0;
    try {
        model.getSystem().realize(state, Stage::Acceleration);
    } catch (const std::exception&) {
        return "its accelerations cannot be computed";
    }
    for (const std::string& name : model.getModel().getCoordinateNames()) {
        const auto& slot = model.getModel().getCoordinateSlot(name);
        const SimTK::MobilizedBody& body = model.getModel().getMatter().getMobilizedBody(slot.body);
        const double q = body.getOneQ(state, slot.q), u = body.getOneU(state, slot.u),
                     udot = body.getOneUDot(state, slot.u);
        if (!std::isfinite(q) || !std::isfinite(u)) return "coordinate '" + name + "' is no longer finite";
        if (!std::isfinite(udot)) return "the acceleration of coordinate '" + name + "' is no longer finite";
        if (std::abs(udot) < largest) continue;
        largest = std::abs(udot);
        culprit = "coordinate '" + name + "' moves faster than any step can follow (value " + toText(q) + ", speed " +
                  toText(u) + ", acceleration " + toText(udot) + ")";
    }
    for (const auto& slot : model.getMuscles())
        if (!std::isfinite(slot.muscle.calcDynamics(state).tendonForce))
            return "the force of muscle '" + slot.name + "' is no longer finite";
    return culprit.empty() ? "its state cannot be followed" : culprit;
}

/** A simulation from step to step. */
class Run {
public:
    Run(const ModelSystem& model, const State& initialState, const SimulationOptions& options)
        : m_integrator(model.getSystem()), m_stepper(model.getSystem(), m_integrator) {
        m_integrator.setAccuracy(options.accuracy);
        m_integrator.setReturnEveryInternalStep(true);
        m_stepper.setReportAllSignificantStates(true);
        m_stepper.initialize(initialState);
        keep();
    }

    double getTime() const { return m_time; }
    const State& getState() const { return m_stepper.getState(); }

    /** @return false if no step leads on to a state that is finite */
    bool step(double time) {
        try {
            m_stepper.stepTo(time);
        } catch (const std::exception&) {
            return false;  // what Simbody says is about its steps; describeStop() is about the model
        }
        if (!isFinite(getState())) return false;
        keep();
        return true;
    }

    /** The last state that was accepted. */
    State getLastState() const {
        State state = getState();
        state.setTime(m_time);
        state.updY() = m_y;
        return state;
    }

private:
    static bool isFinite(const State& state) {
        for (int i = 0; i < state.getNY(); ++i)
            if (!std::isfinite(state.getY()[i])) return false;
        return true;
    }
    void keep() {
        m_time = getState().getTime();
        m_y = getState().getY();
    }

    SimTK::RungeKuttaMersonIntegrator m_integrator;
    SimTK::TimeStepper m_stepper;
    double m_time = 0;
    SimTK::Vector m_y;
};

/** Steps to the end of the run, recording a row at every multiple of the interval, and one where it is interrupted. */
void integrate(ModelSystem& model, const State& initialState, const SimulationOptions& options, Recorder& recorder,
               const std::function<void(double)>& reportProgress, const std::function<bool()>& isInterrupted,
               SimulationResult& result) {
    using Kind = SimulationEnding::Kind;
    Run run(model, initialState, options);
    const double start = run.getTime();
    const int numRows = options.calcNumRows();
    recorder.recordRow(run.getState());
    Kind kind = Kind::Finished;
    for (int row = 1; row <= numRows && kind == Kind::Finished; ++row) {
        // Times as multiples, so that they do not drift.
        const double time = start + (row == numRows ? options.duration : row * options.interval);
        while (run.getTime() < time && kind == Kind::Finished) {
            if (!run.step(time))
                kind = Kind::Stuck;
            else
                recorder.inspectStep(run.getState());
            if (kind == Kind::Finished && isInterrupted && isInterrupted()) kind = Kind::Interrupted;
        }
        if (kind != Kind::Stuck) recorder.recordRow(run.getState());
        reportProgress((run.getTime() - start) / options.duration);
    }
    result.finalState = run.getLastState();
    result.ending = {kind, run.getTime(), kind == Kind::Stuck ? describeStop(model, result.finalState) : ""};
    model.getSystem().realize(result.finalState, Stage::Velocity);
    result.contacts = makeContactText(model, result.finalState);
}

}  // namespace

SimulationResult simulate(ModelSystem& model, const std::map<std::string, Excitation>& excitations,
                          const SimulationOptions& options, const std::function<void(double)>& reportProgress,
                          const std::function<void(const State&)>& watchRow, const InitialState& initial,
                          const std::function<bool()>& isInterrupted) {
    options.validate();
    SimulationResult result;
    const std::vector<ModelSystem::PathView> paths = model.getPaths();
    for (const ModelSystem::PathView& path : paths) path.cable.resetStatistics();
    setExcitations(model, excitations);
    State state = model.makeDefaultState();
    initial.setPose(model, state);
    if (initial.contacts)
        continueContacts(*initial.contacts, model, state);
    else
        startPaths(model, state, result);
    const std::vector<MuscleEquilibrium> starts = initial.setMuscles(model, state);
    Recorder recorder(model, options.recordsAllArms, result, watchRow);
    for (std::size_t i = 0; i < starts.size(); ++i) result.muscleSummaries[i].start = starts[i];
    const ListenerScope listening(paths, recorder);
    const auto start = std::chrono::steady_clock::now();
    integrate(model, state, options, recorder, reportProgress, isInterrupted, result);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; i < paths.size(); ++i) {
        result.summaries[i].statistics = paths[i].cable.getStatistics();
        result.wrappingSeconds += result.summaries[i].statistics.seconds;
    }
    return result;
}

}  // namespace tautline
