// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable.h"

#include "cable_impl.h"
#include "cable_subsystem_impl.h"
#include "tautline/error.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

using SimTK::MobilizedBody;
using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::State;

namespace {

CableElement makePoint(const CableImpl& cable, const MobilizedBody& body, const SimTK::Vec3& station_B,
                       std::string name) {
    require(station_B.isFinite(), "cable '", cable.getName(), "': the station of ",
            name.empty() ? "a point" : "'" + name + "'", " is not finite: ", station_B);
    CableElement point;
    point.name = std::move(name), point.body = body.getMobilizedBodyIndex(), point.X_BE = SimTK::Transform(station_B);
    return point;
}

StartHint toStartHint(const std::optional<SimTK::Vec3>& hint_S) {
    if (!hint_S) return {};
    return PassNear{toEigen(*hint_S)};
}

/** A body of another system would be taken for one of ours with the same index. */
void requireOwnBody(const CableSubsystemImpl& cables, const std::string& cable, const MobilizedBody& body) {
    require(body.isInSubsystem() && body.getMatterSubsystem().isSameSubsystem(cables.getMatter()), "cable '", cable,
            "': a body does not belong to the cable's system");
}

}  // namespace

Cable::Cable(CableSubsystem& cables, const MobilizedBody& originBody, const SimTK::Vec3& originStation_B,
             const MobilizedBody& insertionBody, const SimTK::Vec3& insertionStation_B, std::string name) {
    CableSubsystemImpl& owner = cables.updImpl();
    requireOwnBody(owner, name, originBody);
    requireOwnBody(owner, name, insertionBody);
    require(originStation_B.isFinite() && insertionStation_B.isFinite(), "cable '", name,
            "': an end is not finite: origin ", originStation_B, ", insertion ", insertionStation_B);
    m_impl = &owner.addCable(std::move(name));
    m_impl->setEnds(makePoint(get(), originBody, originStation_B, "origin"),
                    makePoint(get(), insertionBody, insertionStation_B, "insertion"));
}

CableImpl& Cable::upd() const {
    require(m_impl != nullptr, "cable: an empty handle was used");
    return *m_impl;
}

const CableImpl& Cable::get() const {
    return upd();
}

CableElementIndex Cable::addViaPoint(const MobilizedBody& body, const SimTK::Vec3& station_B, std::string name) {
    requireOwnBody(get().getSubsystemImpl(), getName(), body);
    return upd().insertElement(makePoint(get(), body, station_B, std::move(name)));
}

CableElementIndex Cable::addMovingPoint(const MobilizedBody& body, std::shared_ptr<const MovingStation> station,
                                        std::string name) {
    requireOwnBody(get().getSubsystemImpl(), getName(), body);
    require(station != nullptr, "cable '", getName(), "': the moving point '", name, "' has no station");
    CableElement point = makePoint(get(), body, SimTK::Vec3(0), std::move(name));
    point.moving = std::move(station);
    return upd().insertElement(std::move(point));
}

CableElementIndex Cable::addConditionalPoint(const MobilizedBody& body, const SimTK::Vec3& station_B,
                                             std::function<bool(const State&)> isActive, std::string name) {
    requireOwnBody(get().getSubsystemImpl(), getName(), body);
    require(isActive != nullptr, "cable '", getName(), "': the conditional point '", name, "' has no condition");
    CableElement point = makePoint(get(), body, station_B, std::move(name));
    point.isActive = std::move(isActive);
    return upd().insertElement(std::move(point));
}

void Cable::setMovingOrigin(std::shared_ptr<const MovingStation> station) {
    require(station != nullptr, "cable '", getName(), "': the moving origin has no station");
    upd().setMovingEnd(true, std::move(station));
}

void Cable::setMovingInsertion(std::shared_ptr<const MovingStation> station) {
    require(station != nullptr, "cable '", getName(), "': the moving insertion has no station");
    upd().setMovingEnd(false, std::move(station));
}

CableElementIndex Cable::addObstacle(const MobilizedBody& body, const SimTK::Transform& X_BS,
                                     std::shared_ptr<const Surface> surface, std::optional<SimTK::Vec3> hint_S,
                                     std::string name) {
    return addObstacle(body, X_BS, std::move(surface), toStartHint(hint_S), std::move(name));
}

CableElementIndex Cable::addObstacle(const MobilizedBody& body, const SimTK::Transform& X_BS,
                                     std::shared_ptr<const Surface> surface, const StartHint& hint, std::string name) {
    requireOwnBody(get().getSubsystemImpl(), getName(), body);
    require(surface != nullptr, "cable '", getName(), "': obstacle '", name, "' has no surface");
    require(X_BS.p().isFinite() && X_BS.R().isFinite(), "cable '", getName(), "': the pose of obstacle '", name,
            "' is not finite");
    CableElement obstacle;
    obstacle.name = std::move(name), obstacle.body = body.getMobilizedBodyIndex(), obstacle.X_BE = X_BS;
    obstacle.surface = std::move(surface), obstacle.hint = hint;
    return upd().insertElement(std::move(obstacle));
}

void Cable::setCondition(CableElementIndex obstacle, std::function<bool(const State&)> isActive) {
    upd().setCondition(obstacle, std::move(isActive));
}

void Cable::setHint(CableElementIndex obstacle, std::optional<SimTK::Vec3> hint_S) {
    upd().setHint(obstacle, toStartHint(hint_S));
}
void Cable::setHint(CableElementIndex obstacle, const StartHint& hint) {
    upd().setHint(obstacle, hint);
}

void Cable::setOptions(const PathSolverOptions& options) {
    upd().setOptions(options);
}
const PathSolverOptions& Cable::getOptions() const {
    return get().getOptions();
}
void Cable::setDisabledByDefault(bool isDisabled) {
    upd().setDisabledByDefault(isDisabled);
}
bool Cable::isDisabledByDefault() const {
    return get().isDisabledByDefault();
}

void Cable::setContactListener(std::function<void(const ContactEvent&)> listener) const {
    upd().setListener(std::move(listener));
}

const std::string& Cable::getName() const {
    return get().getName();
}
CableIndex Cable::getCableIndex() const {
    return get().getIndex();
}

const CableSubsystem& Cable::getSubsystem() const {
    // The System's own handle is a plain Subsystem; ours adds no data to it.
    return static_cast<const CableSubsystem&>(get().getSubsystemImpl().getOwnerSubsystemHandle());
}

const SimTK::SimbodyMatterSubsystem& Cable::getMatterSubsystem() const {
    return get().getSubsystemImpl().getMatter();
}

int Cable::getNumElements() const {
    return get().getElements().size();
}

bool Cable::isObstacle(CableElementIndex element) const {
    return get().getElements().get(element).surface != nullptr;
}

const std::string& Cable::getElementName(CableElementIndex element) const {
    return get().getElements().get(element).name;
}

CableElementIndex Cable::findElement(const std::string& name) const {
    for (CableElementIndex e(0); e < getNumElements(); ++e)
        if (get().getElements().get(e).name == name) return e;
    throw InvalidInput("cable '" + getName() + "': no element '" + name + "'");
}

SimTK::MobilizedBodyIndex Cable::getElementBody(CableElementIndex element) const {
    return get().getElements().get(element).body;
}

SimTK::Transform Cable::getElementFrame(CableElementIndex element) const {
    return get().getElements().get(element).X_BE;
}

bool Cable::hasMovingPoints() const {
    return get().getElements().hasMovingPoints();
}

const PathProblem& Cable::getPathProblem() const {
    return get().getProblem();
}

std::shared_ptr<const Surface> Cable::getSurface(CableElementIndex element) const {
    return get().getElements().get(element).surface;
}

void Cable::disable(State& state) const {
    get().setDisabled(state, true);
}
void Cable::enable(State& state) const {
    get().setDisabled(state, false);
}
bool Cable::isDisabled(const State& state) const {
    return get().isDisabled(state);
}

void Cable::fixContacts(State& state) const {
    get().keepContacts(state, get().calcSettledPath(state));
}

void Cable::continueFrom(State& state, const PathSolution& path) const {
    require(static_cast<int>(path.contacts.size()) == getNumElements(), "cable '", getName(), "': a path with ",
            path.contacts.size(), " contacts for ", getNumElements(), " elements");
    get().keepContacts(state, {path, PathPose(), state.getTime()});
}

void Cable::releaseContacts(State& state) const {
    get().releaseContacts(state);
}

bool Cable::areContactsFixed(const State& state) const {
    return get().getPathState().getMode(state).keepsContacts;
}

Real Cable::getLength(const State& state) const {
    return get().getPath(state, "Cable::getLength()").length;
}

PathStatus Cable::getStatus(const State& state) const {
    return get().getPath(state, "Cable::getStatus()").status;
}

PathStatus Cable::calcStatus(const State& state) const {
    return get().calcStatus(state);
}

Real Cable::getPathError(const State& state) const {
    return get().getPath(state, "Cable::getPathError()").pathError;
}

const PathSolution& Cable::getSolution(const State& state) const {
    return get().getPath(state, "Cable::getSolution()");
}

PathVerification Cable::calcVerification(const State& state) const {
    const PathSolution& path = get().getPath(state, "Cable::calcVerification()");
    return verifyPath(get().getProblem(), get().getPose(state), path);
}

std::string Cable::explainStatus(const State& state) const {
    return get().explainStatus(state);
}

const PathPose& Cable::getPathPose(const State& state) const {
    get().getPath(state, "Cable::getPathPose()");
    return get().getPose(state);
}

bool Cable::isActive(const State& state, CableElementIndex element) const {
    get().getElements().get(element);
    get().getPath(state, "Cable::isActive()");
    return get().getPose(state).hasElement(element);
}

SimTK::Vec3 Cable::calcStation(const State& state, CableElementIndex element) const {
    const CableElement& found = get().getElements().get(element);
    get().getSubsystemImpl().ensureStage(state, SimTK::Stage::Position, "Cable::calcStation()");
    return found.moving ? found.moving->calcStation(state) : found.X_BE.p();
}

bool Cable::isTouched(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    return get().getPath(state, "Cable::isTouched()").contacts[obstacle].isTouched;
}

Real Cable::getArcLength(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    const ObstacleContact& contact = get().getPath(state, "Cable::getArcLength()").contacts[obstacle];
    return contact.isTouched ? contact.geodesic.length : 0;
}

bool Cable::getContactPoints(const State& state, CableElementIndex obstacle, SimTK::Vec3& P_G, SimTK::Vec3& Q_G) const {
    get().getElements().getObstacle(obstacle);
    const PathSolution& path = get().getPath(state, "Cable::getContactPoints()");
    const ObstacleContact& contact = path.contacts[obstacle];
    if (!contact.isTouched) return false;
    const Pose& X_GS = get().getPose(state).X_GE[obstacle];
    P_G = toSimTK(X_GS * contact.geodesic.P.x);
    Q_G = toSimTK(X_GS * contact.geodesic.Q.x);
    return true;
}

bool Cable::getContactFrames(const State& state, CableElementIndex obstacle, SimTK::Transform& X_GP,
                             SimTK::Transform& X_GQ) const {
    get().getElements().getObstacle(obstacle);
    const ObstacleContact& contact = get().getPath(state, "Cable::getContactFrames()").contacts[obstacle];
    if (!contact.isTouched) return false;
    const Pose& X_GS = get().getPose(state).X_GE[obstacle];
    const auto calcFrame = [&](const DarbouxFrame& frame) {
        Mat3 R_SP;
        R_SP << frame.t, frame.N, frame.B;
        return toTransform(X_GS * Pose(R_SP, frame.x));
    };
    X_GP = calcFrame(contact.geodesic.P), X_GQ = calcFrame(contact.geodesic.Q);
    return true;
}

Real Cable::getClearance(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    const ObstacleContact& contact = get().getPath(state, "Cable::getClearance()").contacts[obstacle];
    return contact.isTouched ? SimTK::NaN : contact.clearance.distance;
}

Real Cable::getWitness(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    return get().calcWitness(state, obstacle);
}

std::vector<SimTK::Vec3> Cable::calcDrawingPoints(const State& state, Real maxAngle) const {
    const PathSolution& path = get().getPath(state, "Cable::calcDrawingPoints()");
    std::vector<Vec3> points_G;
    tautline::calcDrawingPoints(path, get().getProblem(), get().getPose(state), maxAngle, points_G);
    std::vector<SimTK::Vec3> result;
    for (const Vec3& point_G : points_G) result.push_back(toSimTK(point_G));
    return result;
}

void Cable::applyBodyForces(const State& state, Real tension, SimTK::Vector_<SpatialVec>& bodyForces) const {
    get().addBodyForces(state, tension, bodyForces, "Cable::applyBodyForces()");
}

void Cable::applyMobilityForces(const State& state, Real tension, SimTK::Vector& mobilityForces) const {
    get().addMobilityForces(state, tension, mobilityForces, "Cable::applyMobilityForces()");
}

void Cable::calcUnitBodyForces(const State& state, SimTK::Vector_<SpatialVec>& unitForces) const {
    unitForces.resize(getMatterSubsystem().getNumBodies());
    unitForces = SpatialVec(SimTK::Vec3(0));
    get().addBodyForces(state, 1, unitForces, "Cable::calcUnitBodyForces()");
}

SpatialVec Cable::calcUnitElementForce(const State& state, CableElementIndex element) const {
    get().getElements().get(element);
    return toSpatialVec(get().getElementForces(state, "Cable::calcUnitElementForce()")[element]);
}

void Cable::calcUnitMobilityForces(const State& state, SimTK::Vector& unitForces) const {
    SimTK::Vector_<SpatialVec> F_G;
    calcUnitBodyForces(state, F_G);
    getMatterSubsystem().multiplyBySystemJacobianTranspose(state, F_G, unitForces);
    get().addMobilityForces(state, 1, unitForces, "Cable::calcUnitMobilityForces()");
}

Real Cable::calcMomentArm(const State& state, SimTK::MobilizedBodyIndex body, SimTK::MobilizerUIndex u) const {
    SimTK::Vector unitForces;
    calcUnitMobilityForces(state, unitForces);
    const MobilizedBody& mobilizedBody = getMatterSubsystem().getMobilizedBody(body);
    require(u.isValid() && u < mobilizedBody.getNumU(state), "cable '", getName(), "': body ", static_cast<int>(body),
            " has no mobility ", static_cast<int>(u));
    return unitForces[mobilizedBody.getFirstUIndex(state) + u];
}

Real Cable::getLengthRate(const State& state) const {
    return get().getLengthRate(state);
}

Real Cable::getLengthAccelerationBias(const State& state) const {
    return get().getLengthAccelerationBias(state);
}

Real Cable::calcPower(const State& state, Real tension) const {
    get().getSubsystemImpl().ensureStage(state, SimTK::Stage::Velocity, "Cable::calcPower()");
    SimTK::Vector_<SpatialVec> F_G;
    calcUnitBodyForces(state, F_G);
    SimTK::Vector f(state.getNU(), Real(0));
    get().addMobilityForces(state, 1, f, "Cable::calcPower()");
    Real power = ~f * state.getU();
    for (SimTK::MobilizedBodyIndex b(0); b < F_G.size(); ++b)
        power += ~F_G[b] * getMatterSubsystem().getMobilizedBody(b).getBodyVelocity(state);
    return tension * power;
}

CableStatistics Cable::getStatistics() const {
    return get().getStatistics();
}
void Cable::resetStatistics() const {
    get().resetStatistics();
}

}  // namespace tautline
