// SPDX-License-Identifier: Apache-2.0
#include "cable_impl.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "cable_path_subsystem_impl.h"
#include "contact_event_handler.h"
#include "same_pose.h"
#include "tautline/error.h"
#include "tautline/paths/contact_witness.h"
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
        case PathEvent::Kind::Split:
            return ContactEvent::Kind::Split;
        case PathEvent::Kind::Joined:
            return ContactEvent::Kind::Joined;
        case PathEvent::Kind::ArcMade:
            return ContactEvent::Kind::ArcMade;
        case PathEvent::Kind::ArcLost:
            return ContactEvent::Kind::ArcLost;
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

/** Whether any body may have come round once since the last accepted step. */
bool mayHaveTurned(const BodyMotions& motions, Real time) {
    if (SimTK::isNaN(motions.time)) return false;
    const Real duration = std::abs(time - motions.time);
    return std::any_of(motions.V_GB.begin(), motions.V_GB.end(),
                       [&](const SpatialVec& V) { return V[0].norm() * duration > 1; });
}

/** Where nothing is smooth, calcContactWitness() says 1 or -1. */
bool isSmoothWitness(const ObstacleContact& contact) {
    return !contact.isSwitchedOff && !contact.hasLeftHole;
}

}  // namespace

CableImpl::CableImpl(CablePathSubsystemImpl& cables, CableIndex index, std::string name)
    : m_cables(cables), m_index(index), m_name(std::move(name)), m_elements(cables, m_name) {}

void CableImpl::setEnds(CableElement origin, CableElement insertion) {
    m_elements.setEnds(std::move(origin), std::move(insertion));
}

CableElementIndex CableImpl::insertElement(CableElement element) {
    const CableElementIndex index = m_elements.insert(std::move(element));
    m_cables.invalidateSubsystemTopologyCache();
    addHandlers(index);
    return index;
}

void CableImpl::setElement(CableElementIndex index, CableElement element) {
    m_elements.replace(index, std::move(element));
    m_cables.invalidateSubsystemTopologyCache();
    addHandlers(index);
}

/** Those that an element needs and has not yet. */
void CableImpl::addHandlers(CableElementIndex index) {
    const CableElement& element = m_elements[index];
    SimTK::System& system = m_cables.updSystem();
    m_isConditionWatched.resize(m_elements.size());
    if (element.isActive && !m_isConditionWatched[index]) {
        m_isConditionWatched[index] = true;
        system.addEventHandler(new ConditionEventHandler(*this, index));
    }
    if (!element.surface) return;
    if (!std::exchange(m_isWatched, true)) {
        system.addEventHandler(new ContactEventHandler(*this));
        system.addEventHandler(new BreachEventHandler(*this));
    }
}

void CableImpl::setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station) {
    m_elements.setMovingEnd(isOrigin, std::move(station));
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setOptions(const PathSolverOptions& options) {
    options.validate();
    m_options = options;
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setDisabledByDefault(bool isDisabled) {
    m_isDisabledByDefault = isDisabled;
    m_cables.invalidateSubsystemTopologyCache();
}

void CableImpl::setDefaultContactMode(ContactMode mode) {
    m_defaultContactMode = mode;
    m_cables.invalidateSubsystemTopologyCache();
}

CableMode CableImpl::getDefaultMode() const {
    return {m_isDisabledByDefault, m_defaultContactMode.value_or(m_cables.getDefaultContactMode()), false};
}

void CableImpl::realizeTopology(CableWorkspaces& workspaces) {
    m_problem = m_elements.makeProblem();
    m_numObstacles = m_elements.countObstacles();
    m_pool = std::make_shared<CablePathPool>();  // what is left of the problem before is not of this one
    m_workspaces = &workspaces;
}

const CableMode& CableImpl::getMode(const State& state) const {
    return m_cables.getStates().getMode(state, m_index);
}

bool CableImpl::keepsContacts(const State& state) const {
    const CableMode& mode = getMode(state);
    return !mode.isDisabled && mode.keepsContacts;
}

bool CableImpl::hasEvents(const State& state) const {
    const CableMode& mode = getMode(state);
    return !mode.isDisabled && mode.contacts == ContactMode::Events;
}

void CableImpl::realizePath(const State& state, const CableStates::All& all, const std::vector<SimTK::Transform>& X_GB,
                            CableWorkspace& workspace) const {
    const CableMode& mode = all.modes[m_index];
    if (mode.isDisabled) {
        all.paths[m_index] = SharedPath();
        return;
    }
    const ContactRule rule = mode.keepsContacts                      ? ContactRule::Kept
                             : mode.contacts == ContactMode::Tracked ? ContactRule::Tracked
                                                                     : ContactRule::Free;
    const SharedPath& start = all.starts[m_index];
    SharedPath& path = all.paths[m_index];
    m_elements.calcPose(state, X_GB, workspace.pose);
    if (isKnown(state, path.get(), start.get(), rule, workspace)) return;
    if (isKnown(state, start.get(), start.get(), rule, workspace)) {
        path = start;
        return;
    }
    CablePath& found = path.updScratch(*m_pool);
    std::swap(found.pose, workspace.pose);
    found.time = state.getTime();
    found.rule = rule;
    solve(state, start.get(), workspace, found);
}

/** Whether a path is the answer of the workspace's pose, as the start of a solve or as what was found from it. A body
that has come round to the same pose has wound the cable up all the same. */
bool CableImpl::isKnown(const State& state, const CablePath& path, const CablePath& start, ContactRule rule,
                        CableWorkspace& workspace) const {
    if (path.serial == 0 || path.rule != rule) return false;
    const bool isFromStart = path.startSerial == start.serial || path.serial == start.serial;
    if (!isFromStart || !isSamePose(path.pose, workspace.pose)) return false;
    return path.time == state.getTime() || !mayHaveTurned(m_cables.getStates().getStartMotions(state), state.getTime());
}

void CableImpl::solve(const State& state, const CablePath& start, CableWorkspace& workspace, CablePath& path) const {
    using Clock = std::chrono::steady_clock;
    // A straight path costs less than a look at the clock.
    const bool isTimed = m_numObstacles > 0;
    const Clock::time_point begin = isTimed ? Clock::now() : Clock::time_point();
    findPath(state, start, workspace, path);
    if (!path.solution.segments.empty())
        m_counters.countSolve(path.solution, isTimed ? Clock::now() - begin : Clock::duration());
    calcUnitForces(path.solution, path.pose, path.forces);
    path.serial = m_cables.makeSerial();
    path.startSerial = start.serial;
    path.wasSettled = false;
    calcWitnesses(start, path);
}

void CableImpl::findPath(const State& state, const CablePath& start, CableWorkspace& workspace, CablePath& path) const {
    if (path.rule != ContactRule::Free) calcStartMotion(state, start, workspace.startMotion);
    switch (path.rule) {
        case ContactRule::Kept:
            workspace.tracker.track(m_problem, start, workspace.startMotion, path);
            break;
        case ContactRule::Tracked:
            workspace.tracker.trackFreely(m_problem, start, workspace.startMotion, path);
            break;
        case ContactRule::Free:
            workspace.tracker.solveFrom(m_problem, start, path);
            break;
    }
}

void CableImpl::calcWitnesses(const CablePath& start, CablePath& path) const {
    path.contactWitness = path.splitWitness = path.stabilityWitness = path.breachWitness = 1;
    if (path.rule != ContactRule::Kept) return;
    for (int e = 0; e < m_elements.size(); ++e) {
        if (!m_elements[e].surface) continue;
        const Real witness = calcContactWitness(m_problem, path.pose, path.solution, e);
        path.contactWitness = std::min(path.contactWitness, witness);
        path.splitWitness = std::min(path.splitWitness, calcSplitWitness(m_problem, start.solution, path.solution, e));
        if (isSmoothWitness(path.solution.contacts[e])) path.breachWitness = std::min(path.breachWitness, witness);
    }
    path.stabilityWitness = PathTracker::calcStabilityWitness(m_problem, start, path);
}

void CableImpl::setDisabled(State& state, bool isDisabled) const {
    const CableStates& states = m_cables.getStates();
    // What it touched when it was disabled says nothing of where it is now.
    if (getMode(state).isDisabled && !isDisabled) states.updStart(state, m_index) = SharedPath();
    states.updMode(state, m_index).isDisabled = isDisabled;
}

void CableImpl::setContactMode(State& state, ContactMode mode) const {
    CableMode& changed = m_cables.getStates().updMode(state, m_index);
    if (changed.contacts != mode) changed.keepsContacts = false;
    changed.contacts = mode;
}

const PathSolution& CableImpl::getPath(const State& state, const char* method) const {
    m_cables.ensureStage(state, Stage::Position, method);
    SimTK_ERRCHK1_ALWAYS(!isDisabled(state), method, "cable '%s' is disabled in this State", m_name.c_str());
    // A study's swap leaves the paths unrealized at a stage beyond Position.
    m_cables.realizePaths(state);
    return getCablePath(state).solution;
}

const CablePath& CableImpl::getCablePath(const State& state) const {
    return m_cables.getStates().getPath(state, m_index).get();
}

const std::vector<StraightSegment>& CableImpl::getSegments(const State& state, const char* method) const {
    const PathSolution& path = getPath(state, method);
    SimTK_ERRCHK1_ALWAYS(!path.segments.empty(), method, "the pose of cable '%s' is not finite", m_name.c_str());
    return path.segments;
}

const ContactArc* CableImpl::findArc(const State& state, CableElementIndex obstacle, int arc,
                                     const char* method) const {
    m_elements.getObstacle(obstacle);
    const ObstacleContact& contact = getPath(state, method).contacts[obstacle];
    require(arc >= 0, "cable '", m_name, "': arc ", arc, " of obstacle '", m_elements[obstacle].name,
            "': arcs are counted from 0");
    return arc < contact.getNumArcs() ? &contact.getArc(arc) : nullptr;
}

std::vector<SimTK::Transform> CableImpl::calcResampledArcFrames(const State& state, CableElementIndex obstacle,
                                                                int count, int arc, const char* method) const {
    const ContactArc* const found = findArc(state, obstacle, arc, method);
    require(count >= 2, "cable '", m_name, "': an arc is resampled to at least 2 points, not to ", count);
    require(found, "cable '", m_name, "': obstacle '", m_elements[obstacle].name, "' is not touched in an arc ", arc,
            " that could be resampled");
    std::vector<SimTK::Transform> frames_G{calcContactFrame(state, obstacle, found->geodesic.P)};
    GeodesicStart part = found->start;
    part.length /= count - 1;
    for (int i = 1; i < count; ++i) {
        ShotGeodesic piece;
        m_elements[obstacle].surface->shootGeodesic(part, m_options.geodesics, piece);
        frames_G.push_back(calcContactFrame(state, obstacle, piece.Q));
        part.point = piece.endPoint, part.tangent = piece.Q.t;
    }
    return frames_G;
}

std::vector<SimTK::Vec3> CableImpl::calcResampledArc(const State& state, CableElementIndex obstacle, int count,
                                                     int arc) const {
    std::vector<SimTK::Vec3> points_G;
    for (const SimTK::Transform& X_GC :
         calcResampledArcFrames(state, obstacle, count, arc, "Cable::calcResampledArc()"))
        points_G.push_back(X_GC.p());
    return points_G;
}

SimTK::Transform CableImpl::calcContactFrame(const State& state, CableElementIndex obstacle,
                                             const DarbouxFrame& frame_S) const {
    Matrix3 R_S;
    R_S << frame_S.t, frame_S.N, frame_S.B;
    return toTransform(getPose(state).X_GE[obstacle] * Pose(R_S, frame_S.x));
}

std::vector<SimTK::Vec3> CableImpl::calcResampledPoints(const State& state, int count) const {
    const char* const method = "Cable::calcResampledPoints()";
    const std::vector<StraightSegment>& segments = getSegments(state, method);
    require(count >= 2, "cable '", m_name, "': a path is resampled to at least 2 points, not to ", count);
    const PathSolution& path = getPath(state, method);
    std::vector<SimTK::Vec3> points_G;
    Real passed = 0;  // length before the present piece
    // All points up to the end of a piece that are not there yet.
    const auto addPoints = [&](Real length, const auto& calcPoint) {
        const Real step = path.length / (count - 1);
        for (; static_cast<int>(points_G.size()) < count - 1;
             points_G.push_back(calcPoint(Real(points_G.size()) * step - passed)))
            if (!(Real(points_G.size()) * step < passed + length)) break;
        passed += length;
    };
    for (const StraightSegment& line : segments) {
        addPoints(line.length, [&](Real s) { return toSimTK(Vector3(line.A + s * line.e)); });
        const ContactArc& arc = path.getArcAfter(line);
        if (!m_elements[line.toElement].surface || !(arc.start.length > 0)) continue;
        addPoints(arc.start.length, [&](Real s) {
            GeodesicStart part = arc.start;
            part.length = s;
            ShotGeodesic geodesic;
            m_elements[line.toElement].surface->shootGeodesic(part, m_options.geodesics, geodesic);
            return toSimTK(getPose(state).X_GE[line.toElement] * geodesic.Q.x);
        });
    }
    points_G.resize(count - 1, toSimTK(segments.back().B));
    points_G.push_back(toSimTK(segments.back().B));
    return points_G;
}

Real CableImpl::getLengthRate(const State& state) const {
    m_cables.ensureStage(state, Stage::Velocity, "Cable::getLengthRate()");
    const PathSolution& path = getPath(state, "Cable::getLengthRate()");
    Real& rate = m_cables.getStates().updRate(state, m_index);
    if (!SimTK::isNaN(rate)) return rate;
    const CableWorkspaces::Loan workspace = m_workspaces->lend();
    m_elements.calcVelocities(state, workspace->V_GE);
    return rate = calcLengthRate(path, getPose(state), workspace->V_GE);
}

Real CableImpl::getLengthAccelerationBias(const State& state) const {
    const char* const method = "Cable::getLengthAccelerationBias()";
    m_cables.ensureStage(state, Stage::Velocity, method);
    SimTK_ERRCHK1_ALWAYS(!m_elements.hasMovingPoints(), method, "cable '%s' has moving or conditional points",
                         m_name.c_str());
    getPath(state, method);
    Real& bias = m_cables.getStates().updBias(state, m_index);
    if (SimTK::isNaN(bias)) bias = calcLengthAccelerationBias(state, getCablePath(state));
    return bias;
}

/** Of dL/dt = -sum (F . v + M . w) over the elements' origins E: the rates of the unit forces, and the acceleration of
E that turning alone gives it. On the verge of instability, where the forces' rates are without bound, that alone. */
Real CableImpl::calcLengthAccelerationBias(const State& state, const CablePath& path) const {
    const CableWorkspaces::Loan workspace = m_workspaces->lend();
    std::vector<SpatialVelocity>& V_GE = workspace->V_GE;
    m_elements.calcVelocities(state, V_GE);
    workspace->sensitivity.setPath(m_problem, path.pose, path.solution);
    workspace->sensitivity.calcVariation(V_GE, workspace->variation);
    Real bias = 0;
    for (int e = 0; e < m_elements.size(); ++e) {
        const SpatialForce &F = path.forces[e], &FRate = workspace->variation.forceRate[e];
        const SpatialVelocity& V = V_GE[e];
        const Vector3 centripetal = m_elements.calcCentripetalAcceleration(state, e, V.w);
        bias -= FRate.force.dot(V.v) + FRate.moment.dot(V.w) + F.force.dot(centripetal);
    }
    return bias;
}

Real CableImpl::calcWitness(const State& state, CableElementIndex obstacle) const {
    const PathSolution& path = getPath(state, "Cable::getWitness()");
    return areContactsFixed(state) ? calcContactWitness(m_problem, getPose(state), path, obstacle) : 1;
}

const CablePath* CableImpl::findKeptPath(const State& state) const {
    // Studies without events ask all the same, and ask for all cables: the path itself says whether it is kept.
    m_cables.ensureStage(state, Stage::Position, "cable event handler");
    m_cables.realizePaths(state);
    const CablePath& path = getCablePath(state);
    return path.rule == ContactRule::Kept ? &path : nullptr;
}

bool CableImpl::isHolding(const CablePath& path) const {
    return path.contactWitness > -BreachEventHandler::kDeepest && path.stabilityWitness > 0;
}

bool CableImpl::isUnsettled(const State& state) const {
    if (!keepsContacts(state)) return false;
    const CablePath& path = getCablePath(state);
    return !isHolding(path) && !path.wasSettled;
}

const std::vector<SpatialForce>& CableImpl::getElementForces(const State& state, const char* method) const {
    getPath(state, method);
    return getCablePath(state).forces;
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

void CableImpl::calcUnitMobilityForces(const State& state, const MobilityScrews& screws,
                                       SimTK::Vector& unitForces) const {
    const char* const method = "Cable::calcUnitMobilityForces()";
    const std::vector<SpatialForce>& F_GE = getElementForces(state, method);
    require(screws.getNumMobilities() == state.getNU(), "cable '", m_name, "': the screws are those of ",
            screws.getNumMobilities(), " mobilities, but the State has ", state.getNU());
    unitForces.resize(state.getNU());
    unitForces = 0;
    const CableWorkspaces::Loan workspace = m_workspaces->lend();
    workspace->forces.clear();
    m_elements.addForcesAtGround(getPose(state), F_GE, workspace->forces);
    screws.addBalancedForces(workspace->forces, unitForces);
    m_elements.addMobilityForces(state, F_GE, 1, unitForces);
}

TrackedPath CableImpl::calcSettledPath(const State& state) const {
    getPath(state, "Cable::fixContacts()");
    TrackedPath path = getCablePath(state);
    m_workspaces->lend()->tracker.settle(m_problem, path);
    return path;
}

void CableImpl::keepContacts(State& state, const TrackedPath& path) const {
    CableMode& mode = m_cables.getStates().updMode(state, m_index);
    mode.contacts = ContactMode::Events;
    mode.keepsContacts = true;
    setStart(state, path);
}

/** A path whose pose is known is the answer at that pose. */
void CableImpl::setStart(State& state, const TrackedPath& path) const {
    CablePath& start = m_cables.getStates().updStart(state, m_index).updScratch(*m_pool);
    static_cast<TrackedPath&>(start) = path;
    start.rule = ContactRule::Kept;
    start.serial = m_cables.makeSerial();
    start.startSerial = 0;
    start.wasSettled = true;
    start.forces.clear();
    if (path.pose.X_GE.empty()) return;
    calcUnitForces(start.solution, start.pose, start.forces);
    calcWitnesses(start, start);
}

void CableImpl::releaseContacts(State& state) const {
    m_cables.getStates().updMode(state, m_index).keepsContacts = false;
}

void CableImpl::handleBrokenContacts(State& state) const {
    if (!keepsContacts(state)) return;
    m_cables.getSystem().realize(state, Stage::Position);
    getPath(state, "SettlingEventHandler::handleEvent()");
    if (isUnsettled(state)) handleContactEvent(state);
}

void CableImpl::handleContactEvent(State& state) const {
    if (!keepsContacts(state)) return;
    m_cables.getSystem().realize(state, Stage::Velocity);
    getPath(state, "ContactEventHandler::handleEvent()");
    const CableStates& states = m_cables.getStates();
    const SharedPath start = states.getStart(state, m_index);
    const TrackedPath before = calcPathBeforeSwitch(state);
    std::vector<SpatialVelocity> V_GE;
    m_elements.calcVelocities(state, V_GE);
    TrackedPath after = getCablePath(state);
    const std::vector<PathEvent> events = m_workspaces->lend()->tracker.resolveEvent(m_problem, start.get(), after);
    after.time = state.getTime();
    m_cables.acceptHoldingPaths(state);
    setStart(state, after);
    report(events, before.solution, after, V_GE);
}

/** The path of this state as if the conditions of points and obstacles still were those of the step's start: what it
was just before they changed. Of a string that has jumped the last path that was known, a short step ago. */
TrackedPath CableImpl::calcPathBeforeSwitch(const State& state) const {
    const TrackedPath& start = m_cables.getStates().getStart(state, m_index).get();
    const CablePath& path = getCablePath(state);
    if (start.solution.isEmpty()) return path;
    // A path that has come to its end is found at this pose no more.
    if (path.stabilityWitness == -1 && path.solution.status == PathStatus::NotMinimum) return start;
    if (start.pose.isActive == path.pose.isActive) return path;
    TrackedPath before = path;
    before.pose.isActive = start.pose.isActive;
    const CableWorkspaces::Loan workspace = m_workspaces->lend();
    calcStartMotion(state, start, workspace->startMotion);
    workspace->tracker.track(m_problem, start, workspace->startMotion, before);
    return before.solution.status == PathStatus::NotConverged ? TrackedPath(path) : before;
}

void CableImpl::calcStartMotion(const State& state, const TrackedPath& start, PathMotion& motion) const {
    const BodyMotions& motions = m_cables.getStates().getStartMotions(state);
    motion.time = motions.time;
    m_elements.calcVelocities(start.pose, motions.V_GB, motion.V_GE);
}

void CableImpl::report(const std::vector<PathEvent>& events, const PathSolution& before, const TrackedPath& after,
                       const std::vector<SpatialVelocity>& V_GE) const {
    const Real rateBefore = calcLengthRate(before, after.pose, V_GE);
    const Real rateAfter = calcLengthRate(after.solution, after.pose, V_GE);
    for (const PathEvent& event : events) {
        m_counters.countEvent(event.kind);
        if (!m_listener) continue;
        m_listener({after.time, m_index, CableElementIndex(event.element), toContactEventKind(event.kind),
                    before.length, after.solution.length, rateBefore, rateAfter});
    }
}

PathStatus CableImpl::calcStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::calcStatus()");
    return areContactsFixed(state) ? PathTracker::calcStatus(m_problem, getCablePath(state)) : path.status;
}

std::string CableImpl::explainStatus(const State& state) const {
    const PathSolution& path = getPath(state, "Cable::explainStatus()");
    return areContactsFixed(state) ? PathTracker::explainStatus(m_problem, getCablePath(state))
                                   : tautline::explainStatus(m_problem, getPose(state), path);
}

void CableImpl::countStep(const State& state) const {
    const double pathError = getPath(state, "CablePathSubsystem::countStep()").pathError;
    m_counters.countStep(calcStatus(state) != PathStatus::Solved, pathError);
}

}  // namespace tautline
