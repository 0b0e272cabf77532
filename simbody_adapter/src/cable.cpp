// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable.h"

#include "cable_impl.h"
#include "cable_path_subsystem_impl.h"
#include "tautline/error.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/simbody/contact_geometry_surface.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

using SimTK::MobilizedBody;
using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::State;

namespace {

CableElement makePoint(const CableImpl& cable, SimTK::MobilizedBodyIndex body, const SimTK::Vec3& station_B,
                       std::string name) {
    require(station_B.isFinite(), "cable '", cable.getName(), "': the station of ",
            name.empty() ? "a point" : "'" + name + "'", " is not finite: ", station_B);
    CableElement point;
    point.name = std::move(name), point.body = body, point.X_BE = SimTK::Transform(station_B);
    return point;
}

StartHint toStartHint(const std::optional<SimTK::Vec3>& hint_S) {
    if (!hint_S) return {};
    return PassNear{toEigen(*hint_S)};
}

void requireTension(const Cable& cable, Real tension) {
    // A NaN is passed on: it is to be seen.
    require(!(tension < 0), "cable '", cable.getName(), "': a string cannot push, but the tension is ", tension);
}

}  // namespace

SimTK::MobilizedBodyIndex CableBody::findIndex(const SimTK::SimbodyMatterSubsystem& matter,
                                               const std::string& cable) const {
    if (m_body) {
        require(m_body->isInSubsystem() && m_body->getMatterSubsystem().isSameSubsystem(matter), "cable '", cable,
                "': a body does not belong to the cable's system");
        return m_body->getMobilizedBodyIndex();
    }
    require(m_index.isValid() && m_index < matter.getNumBodies(), "cable '", cable, "': no body ",
            static_cast<int>(m_index), " of ", matter.getNumBodies());
    return m_index;
}

Cable::Cable(CablePathSubsystem& cables, const CableBody& originBody, const SimTK::Vec3& originStation_B,
             const CableBody& insertionBody, const SimTK::Vec3& insertionStation_B, std::string name) {
    CablePathSubsystemImpl& owner = cables.updImpl();
    const SimTK::MobilizedBodyIndex first = originBody.findIndex(owner.getMatter(), name);
    const SimTK::MobilizedBodyIndex last = insertionBody.findIndex(owner.getMatter(), name);
    require(originStation_B.isFinite() && insertionStation_B.isFinite(), "cable '", name,
            "': an end is not finite: origin ", originStation_B, ", insertion ", insertionStation_B);
    m_impl = &owner.addCable(std::move(name));
    m_impl->setEnds(makePoint(get(), first, originStation_B, "origin"),
                    makePoint(get(), last, insertionStation_B, "insertion"));
}

SimTK::MobilizedBodyIndex Cable::findBody(const CableBody& body) const {
    return body.findIndex(get().getSubsystemImpl().getMatter(), getName());
}

CableImpl& Cable::upd() const {
    require(m_impl != nullptr, "cable: an empty handle was used");
    return *m_impl;
}

const CableImpl& Cable::get() const {
    return upd();
}

CableElementIndex Cable::addViaPoint(const CableBody& body, const SimTK::Vec3& station_B, std::string name) {
    return upd().insertElement(makePoint(get(), findBody(body), station_B, std::move(name)));
}

CableElementIndex Cable::addMovingPoint(const CableBody& body, std::shared_ptr<const MovingStation> station,
                                        std::string name) {
    const SimTK::MobilizedBodyIndex index = findBody(body);
    require(station != nullptr, "cable '", getName(), "': the moving point '", name, "' has no station");
    CableElement point = makePoint(get(), index, SimTK::Vec3(0), std::move(name));
    point.moving = std::move(station);
    return upd().insertElement(std::move(point));
}

CableElementIndex Cable::addConditionalPoint(const CableBody& body, const SimTK::Vec3& station_B,
                                             std::function<bool(const State&)> isActive, std::string name) {
    const SimTK::MobilizedBodyIndex index = findBody(body);
    require(isActive != nullptr, "cable '", getName(), "': the conditional point '", name, "' has no condition");
    CableElement point = makePoint(get(), index, station_B, std::move(name));
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

CableElementIndex Cable::addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                     std::shared_ptr<const Surface> surface, std::optional<SimTK::Vec3> hint_S,
                                     std::string name) {
    return addObstacle(body, X_BS, std::move(surface), toStartHint(hint_S), std::move(name));
}

CableElementIndex Cable::addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                     std::shared_ptr<const Surface> surface, const StartHint& hint, std::string name) {
    const SimTK::MobilizedBodyIndex index = findBody(body);
    require(surface != nullptr, "cable '", getName(), "': obstacle '", name, "' has no surface");
    CableElement obstacle;
    obstacle.name = std::move(name), obstacle.body = index, obstacle.X_BE = X_BS;
    obstacle.surface = std::move(surface), obstacle.hint = hint;
    return upd().insertElement(std::move(obstacle));
}

void Cable::setCondition(CableElementIndex obstacle, std::function<bool(const State&)> isActive) {
    CableElement changed = get().getElements().getObstacle(obstacle);
    require(!changed.isActive, "cable '", getName(), "': obstacle '", changed.name, "' has a condition already");
    changed.isActive = std::move(isActive);
    upd().setElement(obstacle, std::move(changed));
}

CableElementIndex Cable::addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                     const std::shared_ptr<const SimTK::ContactGeometry>& geometry,
                                     std::optional<SimTK::Vec3> hint_S, std::string name) {
    return addObstacle(body, X_BS, geometry, toStartHint(hint_S), std::move(name));
}

CableElementIndex Cable::addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                     const std::shared_ptr<const SimTK::ContactGeometry>& geometry,
                                     const StartHint& hint, std::string name) {
    require(geometry != nullptr, "cable '", getName(), "': obstacle '", name, "' has no geometry");
    return addObstacle(body, X_BS, makeSurface(*geometry), hint, std::move(name));
}

void Cable::setBody(CableElementIndex element, const CableBody& body) {
    CableElement changed = get().getElements().get(element);
    changed.body = findBody(body);
    upd().setElement(element, std::move(changed));
}

void Cable::setStation(CableElementIndex point, const SimTK::Vec3& station_B) {
    CableElement changed = get().getElements().get(point);
    require(!changed.surface, "cable '", getName(), "': '", changed.name, "' is an obstacle and has no station");
    changed.X_BE = SimTK::Transform(station_B);
    changed.moving = nullptr;
    upd().setElement(point, std::move(changed));
}

void Cable::setObstacleFrame(CableElementIndex obstacle, const SimTK::Transform& X_BS) {
    CableElement changed = get().getElements().getObstacle(obstacle);
    changed.X_BE = X_BS;
    upd().setElement(obstacle, std::move(changed));
}

void Cable::setSurface(CableElementIndex obstacle, std::shared_ptr<const Surface> surface) {
    CableElement changed = get().getElements().getObstacle(obstacle);
    require(surface != nullptr, "cable '", getName(), "': obstacle '", changed.name, "' has no surface");
    changed.surface = std::move(surface);
    upd().setElement(obstacle, std::move(changed));
}

void Cable::setSurface(CableElementIndex obstacle, const std::shared_ptr<const SimTK::ContactGeometry>& geometry) {
    setSurface(obstacle, geometry ? makeSurface(*geometry) : nullptr);
}

void Cable::setHint(CableElementIndex obstacle, std::optional<SimTK::Vec3> hint_S) {
    setHint(obstacle, toStartHint(hint_S));
}
void Cable::setHint(CableElementIndex obstacle, const StartHint& hint) {
    CableElement changed = get().getElements().getObstacle(obstacle);
    changed.hint = hint;
    upd().setElement(obstacle, std::move(changed));
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

void Cable::setDefaultContactMode(ContactMode mode) {
    upd().setDefaultContactMode(mode);
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

const CablePathSubsystem& Cable::getSubsystem() const {
    // The System's own handle is a plain Subsystem; ours adds no data to it.
    return static_cast<const CablePathSubsystem&>(get().getSubsystemImpl().getOwnerSubsystemHandle());
}

const SimTK::SimbodyMatterSubsystem& Cable::getMatterSubsystem() const {
    return get().getSubsystemImpl().getMatter();
}

int Cable::getNumElements() const {
    return get().getElements().size();
}

int Cable::getNumObstacles() const {
    return get().getElements().countObstacles();
}
int Cable::getNumViaPoints() const {
    return getNumElements() - 2 - getNumObstacles();
}
CableElementIndex Cable::getObstacle(int number) const {
    return get().getElements().find(true, number);
}
CableElementIndex Cable::getViaPoint(int number) const {
    return get().getElements().find(false, number);
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

void Cable::setContactMode(State& state, ContactMode mode) const {
    get().setContactMode(state, mode);
}
ContactMode Cable::getContactMode(const State& state) const {
    return get().getContactMode(state);
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
    return get().areContactsFixed(state);
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

int Cable::getNumArcs(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    return get().getPath(state, "Cable::getNumArcs()").contacts[obstacle].getNumArcs();
}

Real Cable::getArcLength(const State& state, CableElementIndex obstacle) const {
    get().getElements().getObstacle(obstacle);
    const ObstacleContact& contact = get().getPath(state, "Cable::getArcLength()").contacts[obstacle];
    return contact.isTouched ? contact.calcArcLength() : SimTK::NaN;
}

bool Cable::getContactPoints(const State& state, CableElementIndex obstacle, SimTK::Vec3& P_G, SimTK::Vec3& Q_G,
                             int arc) const {
    const ContactArc* const found = get().findArc(state, obstacle, arc, "Cable::getContactPoints()");
    if (!found) return false;
    const Pose& X_GS = get().getPose(state).X_GE[obstacle];
    P_G = toSimTK(X_GS * found->geodesic.P.x);
    Q_G = toSimTK(X_GS * found->geodesic.Q.x);
    return true;
}

bool Cable::getContactFrames(const State& state, CableElementIndex obstacle, SimTK::Transform& X_GP,
                             SimTK::Transform& X_GQ, int arc) const {
    const ContactArc* const found = get().findArc(state, obstacle, arc, "Cable::getContactFrames()");
    if (!found) return false;
    X_GP = get().calcContactFrame(state, obstacle, found->geodesic.P);
    X_GQ = get().calcContactFrame(state, obstacle, found->geodesic.Q);
    return true;
}

bool Cable::getContactTangents(const State& state, CableElementIndex obstacle, SimTK::UnitVec3& atP_G,
                               SimTK::UnitVec3& atQ_G, int arc) const {
    const ContactArc* const found = get().findArc(state, obstacle, arc, "Cable::getContactTangents()");
    if (!found) return false;
    const Pose& X_GS = get().getPose(state).X_GE[obstacle];
    atP_G = SimTK::UnitVec3(toSimTK(X_GS.rotate(found->geodesic.P.t)));
    atQ_G = SimTK::UnitVec3(toSimTK(X_GS.rotate(found->geodesic.Q.t)));
    return true;
}

SimTK::UnitVec3 Cable::calcOriginTangent(const State& state) const {
    return SimTK::UnitVec3(toSimTK(get().getSegments(state, "Cable::calcOriginTangent()").front().e));
}

SimTK::UnitVec3 Cable::calcInsertionTangent(const State& state) const {
    return SimTK::UnitVec3(toSimTK(get().getSegments(state, "Cable::calcInsertionTangent()").back().e));
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
    std::vector<Vector3> points_G;
    tautline::calcDrawingPoints(path, get().getProblem(), get().getPose(state), maxAngle, points_G);
    std::vector<SimTK::Vec3> result;
    for (const Vector3& point_G : points_G) result.push_back(toSimTK(point_G));
    return result;
}

std::vector<SimTK::Vec3> Cable::calcResampledPoints(const State& state, int count) const {
    return get().calcResampledPoints(state, count);
}

std::vector<SimTK::Vec3> Cable::calcResampledArc(const State& state, CableElementIndex obstacle, int count,
                                                 int arc) const {
    return get().calcResampledArc(state, obstacle, count, arc);
}

std::vector<SimTK::Transform> Cable::calcResampledArcFrames(const State& state, CableElementIndex obstacle, int count,
                                                            int arc) const {
    return get().calcResampledArcFrames(state, obstacle, count, arc, "Cable::calcResampledArcFrames()");
}

void Cable::applyBodyForces(const State& state, Real tension, SimTK::Vector_<SpatialVec>& bodyForces) const {
    requireTension(*this, tension);
    get().addBodyForces(state, tension, bodyForces, "Cable::applyBodyForces()");
}

void Cable::applyMobilityForces(const State& state, Real tension, SimTK::Vector& mobilityForces) const {
    requireTension(*this, tension);
    get().addMobilityForces(state, tension, mobilityForces, "Cable::applyMobilityForces()");
}

void Cable::calcUnitBodyForces(const State& state, SimTK::Vector_<SpatialVec>& unitForces) const {
    unitForces.resize(getMatterSubsystem().getNumBodies());
    unitForces = SpatialVec(SimTK::Vec3(0));
    get().addBodyForces(state, 1, unitForces, "Cable::calcUnitBodyForces()");
}

SpatialVec Cable::calcUnitForceAboutBodyOrigin(const State& state, CableElementIndex element) const {
    get().getElements().get(element);
    const std::vector<SpatialForce>& F_GE = get().getElementForces(state, "Cable::calcUnitForceAboutBodyOrigin()");
    return get().getElements().calcForceAboutBodyOrigin(state, get().getPose(state), F_GE, element);
}

SpatialVec Cable::calcUnitForceAboutElementOrigin(const State& state, CableElementIndex element) const {
    get().getElements().get(element);
    return toSpatialVec(get().getElementForces(state, "Cable::calcUnitForceAboutElementOrigin()")[element]);
}

void Cable::calcUnitMobilityForces(const State& state, SimTK::Vector& unitForces) const {
    SimTK::Vector_<SpatialVec> F_G;
    calcUnitBodyForces(state, F_G);
    getMatterSubsystem().multiplyBySystemJacobianTranspose(state, F_G, unitForces);
    get().addMobilityForces(state, 1, unitForces, "Cable::calcUnitMobilityForces()");
}

void Cable::calcUnitMobilityForces(const State& state, const MobilityScrews& screws, SimTK::Vector& unitForces) const {
    get().calcUnitMobilityForces(state, screws, unitForces);
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
    requireTension(*this, tension);
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
