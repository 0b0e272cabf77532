#include "simulation.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

namespace tautline {
namespace {

using models::ModelSystem;
using SimTK::Stage;
using SimTK::State;

/** Turns states of a simulation into rows and counts. */
class Recorder {
public:
    Recorder(ModelSystem& model, SimulationResult& result) : m_model(model), m_result(result) {
        m_result.muscles.resize(model.getMuscles().size());
        m_result.events = "time,path,obstacle,kind\n";
        m_result.states.name = "states", m_result.paths.name = "paths";
        labelStates();
        labelPaths();
    }

    void recordRow(const State& state) {
        m_model.getSystem().realize(state, Stage::Velocity);
        recordStates(state);
        recordPaths(state);
    }

    /** Counts what an accepted step's paths are like. */
    void inspectStep(const State& state) {
        m_model.getSystem().realize(state, Stage::Position);
        ++m_result.acceptedSteps;
        for (std::size_t i = 0; i < m_model.getMuscles().size(); ++i) {
            const Cable& cable = m_model.getMuscles()[i].cable;
            MuscleSummary& summary = m_result.muscles[i];
            summary.largestPathError = std::max(summary.largestPathError, cable.getPathError(state));
            const PathStatus status = cable.getStatus(state);
            const PathVerification verification = cable.calcVerification(state);
            if (status == PathStatus::Solved && isSoundBetweenEvents(cable, state, verification)) continue;
            if (summary.degradedSteps++ > 0) continue;
            summary.firstDegradation = "at " + std::to_string(state.getTime()) + " s: ";
            summary.firstDegradation +=
                status == PathStatus::Solved ? describeFault(cable, verification) : getName(status);
        }
    }

    void recordEvent(std::size_t muscle, const ContactEvent& event) {
        const bool isMade = event.kind == ContactEvent::Kind::Made;
        (isMade ? m_result.muscles[muscle].contactsMade : m_result.muscles[muscle].contactsLost) += 1;
        const ModelSystem::MuscleSlot& slot = m_model.getMuscles()[muscle];
        char time[32];
        const auto end = std::to_chars(time, time + sizeof time, event.time).ptr;
        m_result.events += std::string(time, end) + "," + slot.path + "," + slot.cable.getElementName(event.obstacle) +
                           "," + (isMade ? "touchdown" : "liftoff") + "\n";
    }

private:
    /** Where contact is about to change, an arc may be of rounding length below zero until the event handler
    has run: the event finder watches exactly that, and it is no fault of the path. */
    static bool isSoundBetweenEvents(const Cable&, const State&, const PathVerification& verification) {
        return verification.isMinimum() || verification.condition == PathVerification::Condition::NegativeLength;
    }

    static std::string describeFault(const Cable& cable, const PathVerification& verification) {
        return "not a minimum at obstacle '" + cable.getElementName(CableElementIndex(verification.element)) + "'";
    }

    void labelStates() {
        m_result.states.labels = {"time"};
        for (const std::string& name : m_model.getModel().getCoordinateNames()) {
            m_result.states.labels.push_back(name + "/value");
            m_result.states.labels.push_back(name + "/speed");
        }
        for (const auto& slot : m_model.getMuscles()) m_result.states.labels.push_back(slot.path + "/activation");
    }

    void labelPaths() {
        m_result.paths.labels = {"time"};
        for (const auto& slot : m_model.getMuscles()) {
            for (const char* quantity : {"|length", "|rate", "|tension"})
                m_result.paths.labels.push_back(slot.path + quantity);
            for (CableElementIndex e(0); e < slot.cable.getNumElements(); ++e)
                if (slot.cable.isObstacle(e))
                    m_result.paths.labels.push_back(slot.path + "|contact." + slot.cable.getElementName(e));
            for (const std::string& name : m_model.getModel().getCoordinateNames())
                m_result.paths.labels.push_back(slot.path + "|moment_arm." + name);
        }
    }

    void recordStates(const State& state) {
        std::vector<double> row = {state.getTime()};
        for (const std::string& name : m_model.getModel().getCoordinateNames()) {
            row.push_back(m_model.getModel().getCoordinate(state, name));
            row.push_back(m_model.getModel().getCoordinateSpeed(state, name));
        }
        for (const auto& slot : m_model.getMuscles()) row.push_back(slot.muscle.getActivation(state));
        m_result.states.rows.push_back(row);
    }

    void recordPaths(const State& state) {
        std::vector<double> row = {state.getTime()};
        for (const auto& slot : m_model.getMuscles()) {
            row.push_back(slot.cable.getLength(state));
            row.push_back(slot.cable.getLengthRate(state));
            row.push_back(slot.muscle.getTension(state));
            for (CableElementIndex e(0); e < slot.cable.getNumElements(); ++e)
                if (slot.cable.isObstacle(e)) row.push_back(slot.cable.isTouched(state, e));
            for (const std::string& name : m_model.getModel().getCoordinateNames())
                row.push_back(m_model.calcMomentArm(state, slot, name));
        }
        m_result.paths.rows.push_back(row);
    }

    ModelSystem& m_model;
    SimulationResult& m_result;
};

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
    const int numRows = std::max(1, static_cast<int>(std::ceil(options.duration / options.interval - 1e-9)));
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
                          const SimulationOptions& options, const std::function<void(double)>& reportProgress) {
    SimulationResult result;
    setExcitations(model, excitations);
    State state = model.makeDefaultState();
    Recorder recorder(model, result);
    for (std::size_t i = 0; i < model.updMuscles().size(); ++i)
        model.updMuscles()[i].cable.setContactListener(
            [&recorder, i](const ContactEvent& event) { recorder.recordEvent(i, event); });
    const auto start = std::chrono::steady_clock::now();
    integrate(model, state, options, recorder, reportProgress, result.finalState);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (auto& slot : model.updMuscles()) {
        result.wrappingSeconds += slot.cable.getStatistics().seconds;
        slot.cable.setContactListener(nullptr);
    }
    return result;
}

}  // namespace tautline
