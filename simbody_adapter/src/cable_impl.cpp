// SPDX-License-Identifier: Apache-2.0
#include "cable_impl.h"

#include <chrono>
#include <utility>

#include "cable_subsystem_impl.h"
#include "contact_event_handler.h"
#include "tautline/error.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::Stage;
using SimTK::State;

namespace {

ContactEvent::Kind toContactEventKind(PathEvent::Kind kind) {
    switch (kind) {
        case PathEvent::Kind::Touched:
            return ContactEvent::Kind::Made;
        case PathEvent::Kind::Lifted:
            return ContactEvent::Kind::Lost;
        case PathEvent::Kind::LeftHole:
            return ContactEvent::Kind::LeftHole;
        case PathEvent::Kind::SwitchedOff:
            return ContactEvent::Kind::SwitchedOff;
        case PathEvent::Kind::SwitchedOn:
            return ContactEvent::Kind::SwitchedOn;
        case PathEvent::Kind::Slipped:
            break;
    }
    return ContactEvent::Kind::Slipped;
}

}  // namespace

CableImpl::CableImpl(CableSubsystemImpl& cables, CableIndex index, std::string name)
    : m_cables(cables),
      m_index(index),
      m_name(name.empty() ? "cable" + std::to_string(index) : std::move(name)),
      m_elements(cables, m_name) {}

void CableImpl::setEnds(CableElement origin, CableElement insertion) {
    m_elements.setEnds(std::move(origin), std::move(insertion));
}

CableElementIndex CableImpl::insertElement(CableElement element) {
    const bool isObstacle = element.surface != nullptr, isConditional = element.isActive != nullptr;
    const CableElementIndex index = m_elements.insert(std::move(element));
    m_cables.invalidateSubsystemTopologyCache();
    SimTK::System& system = m_cables.updSystem();
    if (isObstacle && !std::exchange(m_isStabilityWatched, true))
        system.addEventHandler(new StabilityEventHandler(*this));
    if (isObstacle) system.addEventHandler(new ContactEventHandler(*this, index));
    if (isObstacle && !m_elements[index].surface->isConvex())
        system.addEventHandler(new SplitEventHandler(*this, index));
    if (isConditional) system.addEventHandler(new ConditionEventHandler(*this, index));
    return index;
}

void CableImpl::setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station) {
    m_elements.setMovingEnd(isOrigin, std::move(station));
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setCondition(CableElementIndex obstacle, std::function<bool(const State&)> isActive) {
    m_elements.setCondition(obstacle, std::move(isActive));
    m_cables.invalidateSubsystemTopologyCache();
    m_cables.updSystem().addEventHandler(new ConditionEventHandler(*this, obstacle));
}

void CableImpl::setHint(CableElementIndex obstacle, const StartHint& hint) {
    m_elements.setHint(obstacle, hint);
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setOptions(const PathSolverOptions& options) {
    options.validate();
    m_options = options;
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setDisabledByDefault(bool isDisabled) {
    m_defaultMode.isDisabled = isDisabled;
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::realizeTopology(State& state) {
    m_problem = m_elements.makeProblem();
    m_state.allocate(m_cables, state, m_defaultMode, m_options);
}

void CableImpl::realizePosition(const State& state) const {
    if (isDisabled(state)) return;
    CablePath& path = m_state.updPath(state);
    m_elements.calcPose(state, path.pose);
    path.time = state.getTime();
    solve(state, path);
    calcUnitForces(path.solution, path.pose, path.forces);
    m_state.markPathRealized(state);
}

/** Only a path that is continued asks how it moved before. */
void CableImpl::realizeVelocity(const State& state) const {
    const CableMode& mode = m_state.getMode(state);
    if (!mode.isDisabled && mode.keepsContacts) realizeMotion(state);
}

void CableImpl::realizeMotion(const State& state) const {
    if (m_state.isMotionRealized(state)) return;
    PathMotion& motion = m_state.updMotion(state);
    motion.time = state.getTime();
    m_elements.calcVelocities(state, motion.V_GE);
    m_state.markMotionRealized(state);
}

const PathMotion& CableImpl::getMotion(const State& state) const {
    realizeMotion(state);
    return m_state.getMotion(state);
}

void CableImpl::setDisabled(State& state, bool isDisabled) const {
    CableMode mode = m_state.getMode(state);
    // What it touched when it was disabled says nothing of where it is now.
    if (mode.isDisabled && !isDisabled) m_state.updStart(state) = CablePath();
    mode.isDisabled = isDisabled;
    m_state.setMode(state, mode);
}

const PathSolution& CableImpl::getPath(const State& state, const char* method) const {
    m_cables.ensureStage(state, Stage::Position, method);
    SimTK_ERRCHK1_ALWAYS(!isDisabled(state), method, "cable '%s' is disabled in this State", m_name.c_str());
    // A study's swap leaves the path unrealized at a stage beyond Position.
    if (!m_state.isPathRealized(state)) realizePosition(state);
    return m_state.getPath(state).solution;
}

Real CableImpl::getLengthRate(const State& state) const {
    m_cables.ensureStage(state, Stage::Velocity, "Cable::getLengthRate()");
    const PathSolution& path = getPath(state, "Cable::getLengthRate()");
    if (!m_state.isRateRealized(state))
        m_state.setRate(state, calcLengthRate(path, getPose(state), getMotion(state).V_GE));
    return m_state.getRate(state);
}

Real CableImpl::getLengthAccelerationBias(const State& state) const {
    const char* const method = "Cable::getLengthAccelerationBias()";
    m_cables.ensureStage(state, Stage::Velocity, method);
    SimTK_ERRCHK1_ALWAYS(!m_elements.hasMovingPoints(), method, "cable '%s' has moving or conditional points",
                         m_name.c_str());
    getPath(state, method);
    if (!m_state.isBiasRealized(state))
        m_state.setBias(state, calcLengthAccelerationBias(state, m_state.getPath(state)));
    return m_state.getBias(state);
}

/** Of dL/dt = -sum (F . v + M . w) over the elements' origins E: the rates of the unit forces, and the acceleration of
E that turning alone gives it. On the verge of instability, where the forces' rates are without bound, that alone. */
Real CableImpl::calcLengthAccelerationBias(const State& state, const CablePath& path) const {
    CableWorkspace& workspace = m_state.updWorkspace(state);
    const std::vector<SpatialVelocity>& V_GE = getMotion(state).V_GE;
    workspace.sensitivity.setPath(m_problem, path.pose, path.solution);
    workspace.sensitivity.calcVariation(V_GE, workspace.variation);
    Real bias = 0;
    for (int e = 0; e < m_elements.size(); ++e) {
        const SpatialForce &F = path.forces[e], &FRate = workspace.variation.forceRate[e];
        const SpatialVelocity& V = V_GE[e];
        const Vec3 centripetal = m_elements.calcCentripetalAcceleration(state, e, V.w);
        bias -= FRate.force.dot(V.v) + FRate.moment.dot(V.w) + F.force.dot(centripetal);
    }
    return bias;
}

Real CableImpl::calcWitness(const State& state, CableElementIndex obstacle) const {
    const PathSolution& path = getPath(state, "Cable::getWitness()");
    if (!m_state.getMode(state).keepsContacts) return 1;
    return calcContactWitness(m_problem, path, obstacle);
}

Real CableImpl::calcSplitWitness(const State& state, CableElementIndex obstacle) const {
    const PathSolution& path = getPath(state, "Cable::calcSplitWitness()");
    if (!m_state.getMode(state).keepsContacts) return 1;
    return tautline::calcSplitWitness(m_problem, getPose(state), path, obstacle);
}

Real CableImpl::calcStabilityWitness(const State& state) const {
    getPath(state, "StabilityEventHandler::getValue()");
    if (!m_state.getMode(state).keepsContacts) return 1;
    return PathTracker::calcStabilityWitness(m_problem, m_state.getStart(state), m_state.getPath(state));
}

void CableImpl::reportSplit(const State& state, CableElementIndex obstacle) const {
    if (isDisabled(state) || !m_listener) return;
    m_cables.getSystem().realize(state, Stage::Velocity);
    const Real length = getPath(state, "SplitEventHandler::handleEvent()").length, rate = getLengthRate(state);
    m_listener({state.getTime(), m_index, obstacle, ContactEvent::Kind::Split, length, length, rate, rate});
}

const std::vector<SpatialForce>& CableImpl::getElementForces(const State& state, const char* method) const {
    getPath(state, method);
    return m_state.getPath(state).forces;
}

void CableImpl::addBodyForces(const State& state, Real tension, SimTK::Vector_<SpatialVec>& bodyForces,
                              const char* method) const {
    const std::vector<SpatialForce>& F_GE = getElementForces(state, method);
    m_elements.addBodyForces(state, getPose(state), F_GE, tension, bodyForces);
}

void CableImpl::addMobilityForces(const State& state, Real tension, SimTK::Vector& mobilityForces,
                                  const char* method) const {
    m_elements.addMobilityForces(state, getElementForces(state, method), tension, mobilityForces);
}

void CableImpl::solve(const State& state, CablePath& path) const {
    using Clock = std::chrono::steady_clock;
    PathTracker& tracker = m_state.updWorkspace(state).tracker;
    const Clock::time_point begin = Clock::now();
    if (m_state.getMode(state).keepsContacts)
        tracker.track(m_problem, m_state.getStart(state), m_state.getStartMotion(state), path);
    else
        tracker.solve(m_problem, path);
    if (path.pose.isFinite()) m_counters.countSolve(path.solution, Clock::now() - begin);
}

TrackedPath CableImpl::calcSettledPath(const State& state) const {
    getPath(state, "Cable::fixContacts()");
    TrackedPath path = m_state.getPath(state);
    m_state.updWorkspace(state).tracker.settle(m_problem, path);
    return path;
}

void CableImpl::keepContacts(State& state, const TrackedPath& path) const {
    CableMode mode = m_state.getMode(state);
    mode.keepsContacts = true;
    m_state.setMode(state, mode);
    setStart(state, path);
}

void CableImpl::setStart(State& state, const TrackedPath& path) const {
    static_cast<TrackedPath&>(m_state.updStart(state)) = path;
}

void CableImpl::releaseContacts(State& state) const {
    CableMode mode = m_state.getMode(state);
    mode.keepsContacts = false;
    m_state.setMode(state, mode);
}

void CableImpl::handleContactEvent(State& state) const {
    const CableMode& mode = m_state.getMode(state);
    if (mode.isDisabled || !mode.keepsContacts) return;
    m_cables.getSystem().realize(state, Stage::Velocity);
    getPath(state, "ContactEventHandler::handleEvent()");
    const TrackedPath before = calcPathBeforeSwitch(state);
    const PathMotion motion = getMotion(state);
    TrackedPath after = m_state.getPath(state);
    const std::vector<PathEvent> events =
        m_state.updWorkspace(state).tracker.resolveEvent(m_problem, m_state.getStart(state), after);
    setStart(state, after);
    m_state.updStartMotion(state) = motion;
    report(events, before.solution, after, motion);
}

/** The path of this state as if the conditions of points and obstacles still were those of the step's start: what it
was just before they changed. */
TrackedPath CableImpl::calcPathBeforeSwitch(const State& state) const {
    const TrackedPath& start = m_state.getStart(state);
    const TrackedPath& path = m_state.getPath(state);
    if (start.solution.isEmpty() || start.pose.isActive == path.pose.isActive) return path;
    TrackedPath before = path;
    before.pose.isActive = start.pose.isActive;
    m_state.updWorkspace(state).tracker.track(m_problem, start, m_state.getStartMotion(state), before);
    return before.solution.status == PathStatus::NotConverged ? path : before;
}

void CableImpl::report(const std::vector<PathEvent>& events, const PathSolution& before, const TrackedPath& after,
                       const PathMotion& motion) const {
    const Real rateBefore = calcLengthRate(before, after.pose, motion.V_GE);
    const Real rateAfter = calcLengthRate(after.solution, after.pose, motion.V_GE);
    for (const PathEvent& event : events) {
        m_counters.countEvent(event.kind);
        if (!m_listener) continue;
        m_listener({after.time, m_index, CableElementIndex(event.element), toContactEventKind(event.kind),
                    before.length, after.solution.length, rateBefore, rateAfter});
    }
}

PathStatus CableImpl::calcStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::calcStatus()");
    if (!m_state.getMode(state).keepsContacts) return path.status;
    return PathTracker::calcStatus(m_problem, m_state.getPath(state));
}

std::string CableImpl::explainStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::explainStatus()");
    if (!m_state.getMode(state).keepsContacts) return tautline::explainStatus(m_problem, getPose(state), path);
    return PathTracker::explainStatus(m_problem, m_state.getPath(state));
}

void CableImpl::countStep(const State& state) const {
    const double pathError = getPath(state, "CableSubsystem::countStep()").pathError;
    m_counters.countStep(calcStatus(state) != PathStatus::Solved, pathError);
}

}  // namespace tautline
