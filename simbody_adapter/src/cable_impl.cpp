// SPDX-License-Identifier: Apache-2.0
#include "cable_impl.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "cable_subsystem_impl.h"
#include "contact_event_handler.h"
#include "tautline/error.h"
#include "tautline/paths/contact_settling.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_following.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_stability.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/single_contact.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::Stage;
using SimTK::State;

namespace {

constexpr Real kBetweenEvents = -1e-6;  ///< arcs just below zero, in sizes, which the event finder watches

/** Whether a path may be followed from there. */
bool isGoodStart(const CablePath& start) {
    return !start.pose.X_GE.empty() && start.solution.status != PathStatus::NotConverged &&
           start.solution.status != PathStatus::NotMinimum;
}

/** The answer for a pose that is not finite: nothing to draw, nothing that pulls. */
void makeEmptyPath(int numElements, PathSolution& path) {
    path = PathSolution();
    path.contacts.assign(numElements, ObstacleContact());
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
    const CableMode& mode = m_state.getMode(state);
    if (mode.isDisabled) return;
    CablePath& path = m_state.updPath(state);
    m_elements.calcPose(state, path.pose);
    solve(m_state.getStart(state), mode.keepsContacts, m_state.updWorkspace(state), path);
    calcUnitForces(path.solution, path.pose, path.forces);
    m_state.markPathRealized(state);
}

void CableImpl::setDisabled(State& state, bool isDisabled) const {
    CableMode mode = m_state.getMode(state);
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
    if (!m_state.isRateRealized(state)) {
        CableWorkspace& workspace = m_state.updWorkspace(state);
        m_elements.calcVelocities(state, workspace.velocities);
        m_state.setRate(state, calcLengthRate(path, getPose(state), workspace.velocities));
    }
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
    m_elements.calcVelocities(state, workspace.velocities);
    workspace.sensitivity.setPath(m_problem, path.pose, path.solution);
    workspace.sensitivity.calcVariation(workspace.velocities, workspace.variation);
    Real bias = 0;
    for (int e = 0; e < m_elements.size(); ++e) {
        const SpatialForce &F = path.forces[e], &FRate = workspace.variation.forceRate[e];
        const SpatialVelocity& V = workspace.velocities[e];
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
    return calcSingleContactWitness(m_problem, getPose(state), path, obstacle);
}

/** Where a path that is a saddle could not be left, it is tried again whenever its instability has grown tenfold. */
Real CableImpl::calcStabilityWitness(const State& state) const {
    constexpr Real kTiny = std::numeric_limits<Real>::min(), kGrowth = 10;
    const PathSolution& path = getPath(state, "StabilityEventHandler::getValue()");
    if (!m_state.getMode(state).keepsContacts) return 1;
    if (path.status == PathStatus::NotConverged) return -1;
    const auto calcMargin = [&](const CablePath& at) {
        return calcPathStability(m_problem, at.pose, at.solution).margin;
    };
    const CablePath& start = m_state.getStart(state);
    Real margin = calcMargin(m_state.getPath(state));
    if (start.solution.status == PathStatus::NotMinimum && !start.pose.X_GE.empty())
        margin -= kGrowth * std::min<Real>(calcMargin(start), kSlipMargin);
    else
        margin -= kSlipMargin;
    return margin == 0 ? -kTiny : margin;
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

void CableImpl::solve(const CablePath& start, bool keepsContacts, CableWorkspace& workspace, CablePath& found) const {
    PathSolution& path = found.solution;
    if (!found.pose.isFinite()) return makeEmptyPath(m_elements.size(), path);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    if (keepsContacts) {
        solveKept(start, workspace, found);
    } else {
        path.contacts.clear();
        workspace.solver.solve(m_problem, found.pose, path);
    }
    m_counters.countSolve(path, Clock::now() - begin);
}

/** Where Newton's method comes to no path in one step, or to another one, a saddle, the path is followed there. */
void CableImpl::solveKept(const CablePath& start, CableWorkspace& workspace, CablePath& path) const {
    PathSolution& solution = path.solution;
    solution = start.solution;
    workspace.solver.solveKeepingContacts(m_problem, path.pose, solution);
    if (isHoldingPath(m_problem, path.pose, solution) || hasSwallowedEnd(solution)) return;
    PathSolution followed = start.solution;
    if (isGoodStart(start) && followPath(workspace.solver, m_problem, start.pose, path.pose, followed))
        solution = followed;
    else if (solution.status == PathStatus::Solved)
        solution.status = PathStatus::NotMinimum;
}

PathSolution CableImpl::calcSettledPath(const State& state) const {
    PathSolution path = getPath(state, "Cable::fixContacts()");
    if (path.status == PathStatus::NotConverged) return path;
    settleContacts(m_state.updWorkspace(state).solver, m_problem, getPose(state), path);
    return path;
}

void CableImpl::keepContacts(State& state, const PathSolution& path, const PathPose& pose) const {
    CableMode mode = m_state.getMode(state);
    mode.keepsContacts = true;
    m_state.setMode(state, mode);
    setStart(state, path, pose);
}

void CableImpl::setStart(State& state, const PathSolution& path, const PathPose& pose) const {
    CablePath& start = m_state.updStart(state);
    start.solution = path, start.pose = pose;
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
    const PathSolution before = getPath(state, "ContactEventHandler::handleEvent()");
    const PathPose pose = getPose(state);
    CableWorkspace& workspace = m_state.updWorkspace(state);
    m_elements.calcVelocities(state, workspace.velocities);
    const PathSolution start = m_state.getStart(state).solution;
    PathSolution after = before;
    if (before.status == PathStatus::NotConverged) after.contacts = start.contacts;
    for (int e = 0; e < m_elements.size(); ++e) {
        after.contacts[e].isSwitchedOff = before.contacts[e].isSwitchedOff;
        // What the step began from knows how the cable went through rings.
        if (!start.contacts[e].isSwitchedOff) after.contacts[e].passage = start.contacts[e].passage;
    }
    const int slippedAt = settleContacts(workspace.solver, m_problem, pose, after);
    setStart(state, after, pose);
    report(state, start, before, after, pose, slippedAt);
}

/** @param state   whose velocities are in its workspace */
void CableImpl::report(const State& state, const PathSolution& start, const PathSolution& before,
                       const PathSolution& after, const PathPose& pose, int slippedAt) const {
    const CableWorkspace& workspace = m_state.updWorkspace(state);
    const Real rateBefore = calcLengthRate(before, pose, workspace.velocities);
    const Real rateAfter = calcLengthRate(after, pose, workspace.velocities);
    using Kind = ContactEvent::Kind;
    const auto tell = [&](CableElementIndex e, Kind kind) {
        if (m_listener)
            m_listener({state.getTime(), m_index, e, kind, before.length, after.length, rateBefore, rateAfter});
    };
    if (slippedAt >= 0) {
        m_counters.countSlip();
        tell(CableElementIndex(slippedAt), Kind::Slipped);
    }
    for (CableElementIndex e(0); e < m_elements.size(); ++e) {
        if (!m_elements[e].surface) continue;
        if (after.contacts[e].hasLeftHole && !start.contacts[e].hasLeftHole) {
            m_counters.countHoleLeft();
            tell(e, Kind::LeftHole);
        }
        if (before.contacts[e].isTouched == after.contacts[e].isTouched) continue;
        m_counters.countContactEvent();
        tell(e, after.contacts[e].isTouched ? Kind::Made : Kind::Lost);
    }
}

PathStatus CableImpl::calcStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::calcStatus()");
    if (path.status != PathStatus::Solved || !m_state.getMode(state).keepsContacts) return path.status;
    for (int e = 0; e < m_elements.size(); ++e)
        if (m_elements[e].surface && path.contacts[e].isSwitchedOff) return PathStatus::EndInside;
    for (const ObstacleContact& contact : path.contacts)
        if (contact.hasLeftHole) return PathStatus::NotMinimum;
    using Condition = PathVerification::Condition;
    switch (verifyPath(m_problem, getPose(state), path, kBetweenEvents).condition) {
        case Condition::None:
            return PathStatus::Solved;
        case Condition::OutsideDomain:
            return PathStatus::LeftDomain;
        case Condition::Unstable:
            if (calcPathStability(m_problem, getPose(state), path).holds()) return PathStatus::Solved;
            [[fallthrough]];
        default:
            return PathStatus::NotMinimum;
    }
}

std::string CableImpl::explainStatus(const State& state) const {
    PathSolution path = getPath(state, "Cable::explainStatus()");
    path.status = calcStatus(state);
    return tautline::explainStatus(m_problem, getPose(state), path, kBetweenEvents);
}

void CableImpl::countStep(const State& state) const {
    const double pathError = getPath(state, "CableSubsystem::countStep()").pathError;
    m_counters.countStep(calcStatus(state) != PathStatus::Solved, pathError);
}

}  // namespace tautline
