#include "cable_impl.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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
    : m_cables(cables), m_index(index), m_name(std::move(name)) {
    if (m_name.empty()) m_name = "cable" + std::to_string(index);
}

void CableImpl::setEnds(CableElement origin, CableElement insertion) {
    m_elements = {std::move(origin), std::move(insertion)};
}

CableElementIndex CableImpl::insertElement(CableElement element) {
    const CableElementIndex index(getNumElements() - 1);
    if (element.name.empty()) element.name = (element.surface ? "obstacle" : "point") + std::to_string(index);
    for (const CableElement& other : m_elements)
        require(other.name != element.name, "cable '", m_name, "': there is an element '", element.name, "' already");
    if (element.surface) checkHint(element);
    const bool isObstacle = element.surface != nullptr, isConditional = element.isActive != nullptr;
    m_elements.insert(m_elements.end() - 1, std::move(element));
    m_cables.invalidateSubsystemTopologyCache();
    if (isObstacle && !std::exchange(m_isStabilityWatched, true))
        m_cables.updSystem().addEventHandler(new StabilityEventHandler(*this));
    if (isObstacle) m_cables.updSystem().addEventHandler(new ContactEventHandler(*this, index));
    if (isObstacle && !m_elements[index].surface->isConvex())
        m_cables.updSystem().addEventHandler(new SplitEventHandler(*this, index));
    if (isConditional) m_cables.updSystem().addEventHandler(new ConditionEventHandler(*this, index));
    return index;
}

void CableImpl::setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station) {
    (isOrigin ? m_elements.front() : m_elements.back()).moving = std::move(station);
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setHint(CableElementIndex obstacle, const StartHint& hint) {
    CableElement changed = getObstacle(obstacle);
    changed.hint = hint;
    checkHint(changed);
    m_elements[obstacle] = changed;
    m_cables.invalidateSubsystemTopologyCache();
}

/** @throws InvalidInput as the core would when the path problem is built */
void CableImpl::checkHint(const CableElement& obstacle) const {
    try {
        PathProblem().addObstacle(obstacle.name, obstacle.surface, obstacle.hint);
    } catch (const InvalidInput& error) {
        throw InvalidInput("cable '" + m_name + "': " + error.what());
    }
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

bool CableImpl::hasMovingPoints() const {
    return std::any_of(m_elements.begin(), m_elements.end(),
                       [](const CableElement& element) { return element.moving || element.isActive; });
}

const CableElement& CableImpl::getElement(CableElementIndex element) const {
    require(element.isValid() && element < getNumElements(), "cable '", m_name, "': no element ",
            static_cast<int>(element), " of ", getNumElements());
    return m_elements[element];
}

const CableElement& CableImpl::getObstacle(CableElementIndex element) const {
    const CableElement& found = getElement(element);
    require(found.surface != nullptr, "cable '", m_name, "': element '", found.name, "' is a point, not an obstacle");
    return found;
}

const SimTK::MobilizedBody& CableImpl::getBody(const CableElement& element) const {
    return m_cables.getMatter().getMobilizedBody(element.body);
}

void CableImpl::realizeTopology(State& state) {
    m_problem = PathProblem();
    for (const CableElement& element : m_elements) {
        if (!element.surface) {
            m_problem.addPoint(element.name);
            continue;
        }
        m_problem.addObstacle(element.name, element.surface, element.hint);
    }
    m_state.allocate(m_cables, state, m_defaultMode, m_options);
}

void CableImpl::realizePosition(const State& state) const {
    const CableMode& mode = m_state.getMode(state);
    if (mode.isDisabled) return;
    CablePath& path = m_state.updPath(state);
    calcPose(state, path.pose);
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
        calcVelocities(state, workspace.velocities);
        m_state.setRate(state, calcLengthRate(path, getPose(state), workspace.velocities));
    }
    return m_state.getRate(state);
}

Real CableImpl::getLengthAccelerationBias(const State& state) const {
    const char* const method = "Cable::getLengthAccelerationBias()";
    m_cables.ensureStage(state, Stage::Velocity, method);
    SimTK_ERRCHK1_ALWAYS(!hasMovingPoints(), method, "cable '%s' has moving or conditional points", m_name.c_str());
    getPath(state, method);
    if (!m_state.isBiasRealized(state))
        m_state.setBias(state, calcLengthAccelerationBias(state, m_state.getPath(state)));
    return m_state.getBias(state);
}

/** Of dL/dt = -sum (F . v + M . w) over the elements' origins E: the rates of the unit forces, and the acceleration of
E that turning alone gives it. On the verge of instability, where the forces' rates are without bound, that alone. */
Real CableImpl::calcLengthAccelerationBias(const State& state, const CablePath& path) const {
    CableWorkspace& workspace = m_state.updWorkspace(state);
    calcVelocities(state, workspace.velocities);
    workspace.sensitivity.setPath(m_problem, path.pose, path.solution);
    workspace.sensitivity.calcVariation(workspace.velocities, workspace.variation);
    Real bias = 0;
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const SpatialForce &F = path.forces[e], &FRate = workspace.variation.forceRate[e];
        const SpatialVelocity& V = workspace.velocities[e];
        const SimTK::Vec3 p_BE_G = getBody(m_elements[e]).getBodyRotation(state) * m_elements[e].X_BE.p();
        const Vec3 centripetal = V.w.cross(V.w.cross(toEigen(p_BE_G)));
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
    const PathPose& pose = getPose(state);
    for (int e = 0; e < getNumElements(); ++e) {
        const CableElement& element = m_elements[e];
        const SpatialVec F = tension * toSpatialVec(F_GE[e]);
        const SimTK::Vec3 p_BE_G = toSimTK(pose.X_GE[e].p) - getBody(element).getBodyOriginLocation(state);
        bodyForces[element.body] += SpatialVec(F[0] + p_BE_G % F[1], F[1]);
    }
}

void CableImpl::addMobilityForces(const State& state, Real tension, SimTK::Vector& mobilityForces,
                                  const char* method) const {
    const auto isMoving = [](const CableElement& element) { return element.moving != nullptr; };
    if (std::none_of(m_elements.begin(), m_elements.end(), isMoving)) return;
    const std::vector<SpatialForce>& F_GE = getElementForces(state, method);
    for (int e = 0; e < getNumElements(); ++e) {
        const CableElement& element = m_elements[e];
        if (!element.moving) continue;
        const SimTK::Vec3 force_B = ~getBody(element).getBodyRotation(state) * toSimTK(F_GE[e].force);
        element.moving->addMobilityForces(state, tension * force_B, mobilityForces);
    }
}

void CableImpl::calcPose(const State& state, PathPose& pose) const {
    pose.X_GE.resize(m_elements.size());
    pose.isActive.assign(m_elements.size(), 1);
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const CableElement& element = m_elements[e];
        const SimTK::Transform& X_GB = getBody(element).getBodyTransform(state);
        pose.X_GE[e] =
            element.moving ? Pose(toEigen(X_GB * element.moving->calcStation(state))) : toPose(X_GB * element.X_BE);
        if (element.isActive) pose.isActive[e] = element.isActive(state);
    }
}

void CableImpl::calcVelocities(const State& state, std::vector<SpatialVelocity>& V_GE) const {
    V_GE.resize(m_elements.size());
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const SimTK::MobilizedBody& body = getBody(m_elements[e]);
        const std::shared_ptr<const MovingStation>& moving = m_elements[e].moving;
        const SimTK::Vec3 station_B = moving ? moving->calcStation(state) : m_elements[e].X_BE.p();
        SimTK::Vec3 v_G = body.findStationVelocityInGround(state, station_B);
        if (moving) v_G += body.getBodyRotation(state) * moving->calcVelocity(state);
        V_GE[e] = {toEigen(body.getBodyAngularVelocity(state)), toEigen(v_G)};
    }
}

void CableImpl::solve(const CablePath& start, bool keepsContacts, CableWorkspace& workspace, CablePath& found) const {
    PathSolution& path = found.solution;
    if (!found.pose.isFinite()) return makeEmptyPath(getNumElements(), path);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    if (keepsContacts) {
        solveKept(start, workspace, found);
    } else {
        path.contacts.clear();
        workspace.solver.solve(m_problem, found.pose, path);
    }
    const std::chrono::nanoseconds elapsed = Clock::now() - begin;
    m_counters.nanoseconds += elapsed.count();
    ++m_counters.solves;
    if (path.wasCold) ++m_counters.coldSolves;
    if (path.status == PathStatus::NotConverged) ++m_counters.failures;
    m_counters.iterations += path.iterations;
    m_counters.shots += path.shots;
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
    calcVelocities(state, workspace.velocities);
    const PathSolution start = m_state.getStart(state).solution;
    PathSolution after = before;
    if (before.status == PathStatus::NotConverged) after.contacts = start.contacts;
    for (int e = 0; e < getNumElements(); ++e) {
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
        ++m_counters.slips;
        tell(CableElementIndex(slippedAt), Kind::Slipped);
    }
    for (CableElementIndex e(0); e < getNumElements(); ++e) {
        if (!m_elements[e].surface) continue;
        if (after.contacts[e].hasLeftHole && !start.contacts[e].hasLeftHole) {
            ++m_counters.holesLeft;
            tell(e, Kind::LeftHole);
        }
        if (before.contacts[e].isTouched == after.contacts[e].isTouched) continue;
        ++m_counters.events;
        tell(e, after.contacts[e].isTouched ? Kind::Made : Kind::Lost);
    }
}

PathStatus CableImpl::calcStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::calcStatus()");
    if (path.status != PathStatus::Solved || !m_state.getMode(state).keepsContacts) return path.status;
    for (int e = 0; e < getNumElements(); ++e)
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
    ++m_counters.steps;
    if (calcStatus(state) != PathStatus::Solved) ++m_counters.degradedSteps;
    const Real error = getPath(state, "CableSubsystem::countStep()").pathError;
    double largest = m_counters.largestPathError;
    while (!(error <= largest) && !std::isnan(largest))
        if (m_counters.largestPathError.compare_exchange_weak(largest, error)) break;
}

CableStatistics CableImpl::getStatistics() const {
    CableStatistics result;
    result.numSolves = m_counters.solves;
    result.numColdSolves = m_counters.coldSolves;
    result.numFailures = m_counters.failures;
    result.numIterations = m_counters.iterations;
    result.numShots = m_counters.shots;
    result.numContactEvents = m_counters.events;
    result.numSteps = m_counters.steps;
    result.numDegradedSteps = m_counters.degradedSteps;
    result.largestPathError = m_counters.largestPathError;
    result.numSlips = m_counters.slips;
    result.numHolesLeft = m_counters.holesLeft;
    result.seconds = 1e-9 * static_cast<double>(m_counters.nanoseconds);
    return result;
}

void CableImpl::resetStatistics() const {
    for (std::atomic<long>* counter :
         {&m_counters.solves, &m_counters.coldSolves, &m_counters.failures, &m_counters.iterations, &m_counters.shots,
          &m_counters.events, &m_counters.slips, &m_counters.holesLeft, &m_counters.nanoseconds, &m_counters.steps,
          &m_counters.degradedSteps})
        *counter = 0;
    m_counters.largestPathError = 0;
}

}  // namespace tautline
