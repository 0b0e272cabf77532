// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_builder.h"

namespace tautline::models {
namespace {

std::vector<double> getArguments(const BuiltModel& model, const SimTK::State& state, const CoordinateCoupler& coupler) {
    std::vector<double> q;
    for (const std::string& name : coupler.independentCoordinates) q.push_back(model.getCoordinate(state, name));
    return q;
}

}  // namespace

BuiltModel BuiltModel::ofBodies(SimTK::SimbodyMatterSubsystem& matter,
                                const std::map<std::string, SimTK::MobilizedBodyIndex>& bodies) {
    for (const auto& [name, index] : bodies)
        if (index < 0 || index >= matter.getNumBodies())
            throw ModelError("body '" + name + "' is the mobilized body " + std::to_string(index) +
                             ", but the system has only 0 to " + std::to_string(matter.getNumBodies() - 1));
    BuiltModel built;
    built.m_matter = &matter;
    built.m_bodies = bodies;
    built.m_bodies[kGroundName] = matter.getGround().getMobilizedBodyIndex();
    return built;
}

SimTK::MobilizedBodyIndex BuiltModel::getBodyIndex(const std::string& name) const {
    const auto found = m_bodies.find(name);
    if (found == m_bodies.end()) throw ModelError("there is no body '" + name + "'");
    return found->second;
}

const SimTK::MobilizedBody& BuiltModel::getBody(const std::string& name) const {
    return m_matter->getMobilizedBody(getBodyIndex(name));
}

const BuiltModel::CoordinateSlot& BuiltModel::getCoordinateSlot(const std::string& name) const {
    const auto found = m_coordinates.find(name);
    if (found == m_coordinates.end()) throw ModelError("there is no coordinate '" + name + "'");
    return found->second;
}

void BuiltModel::setDefaultPose(SimTK::State& state) const {
    setPose(state, false);
}

void BuiltModel::setRestingPose(SimTK::State& state) const {
    setPose(state, true);
}

void BuiltModel::setPose(SimTK::State& state, bool isAtRest) const {
    for (const auto& [name, slot] : m_coordinates) {
        const auto& motion = slot.prescribedMotion;
        const double speed = isAtRest ? 0.0 : slot.defaultSpeed;
        setCoordinate(state, slot, motion ? motion->calcValue(state.getTime()) : slot.defaultValue);
        m_matter->getMobilizedBody(slot.body).setOneU(state, slot.u,
                                                      motion ? motion->calcDerivative(state.getTime()) : speed);
    }
    applyCouplers(state);
}

void BuiltModel::setCoordinate(SimTK::State& state, const std::string& name, double value) const {
    setCoordinate(state, getCoordinateSlot(name), value);
}

void BuiltModel::setCoordinate(SimTK::State& state, const CoordinateSlot& slot, double value) const {
    m_matter->getMobilizedBody(slot.body).setOneQ(state, slot.q, value);
    if (!slot.lock.isValid()) return;
    SimTK::Constraint::ConstantCoordinate::downcast(m_matter->getConstraint(slot.lock)).setPosition(state, value);
}

double BuiltModel::getCoordinate(const SimTK::State& state, const std::string& name) const {
    const CoordinateSlot& slot = getCoordinateSlot(name);
    return m_matter->getMobilizedBody(slot.body).getOneQ(state, slot.q);
}

void BuiltModel::setCoordinateSpeed(SimTK::State& state, const std::string& name, double speed) const {
    const CoordinateSlot& slot = getCoordinateSlot(name);
    m_matter->getMobilizedBody(slot.body).setOneU(state, slot.u, speed);
}

double BuiltModel::getCoordinateSpeed(const SimTK::State& state, const std::string& name) const {
    const CoordinateSlot& slot = getCoordinateSlot(name);
    return m_matter->getMobilizedBody(slot.body).getOneU(state, slot.u);
}

void BuiltModel::applyCouplers(SimTK::State& state) const {
    for (const CoordinateCoupler& coupler : m_couplers) {
        const std::vector<double> q = getArguments(*this, state, coupler);
        double speed = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i)
            speed += calcCouplingSlope(state, coupler, static_cast<int>(i)) *
                     getCoordinateSpeed(state, coupler.independentCoordinates[i]);
        setCoordinate(state, coupler.dependentCoordinate, coupler.scaleFactor * coupler.function.calcValue(q.data()));
        setCoordinateSpeed(state, coupler.dependentCoordinate, speed);
    }
}

double BuiltModel::calcCouplingSlope(const SimTK::State& state, const CoordinateCoupler& coupler, int i) const {
    const std::vector<double> q = getArguments(*this, state, coupler);
    return coupler.scaleFactor * coupler.function.calcDerivative({i}, q.data());
}

const std::string* BuiltModel::findSingularCoordinate(const SimTK::State& state) const {
    // Sine of the angle between a motion and those before it, below which it counts as one of theirs.
    constexpr double kLeastSine = 1e-6;
    std::map<SimTK::MobilizedBodyIndex, std::vector<SimTK::Vec6>> motions;
    for (const std::string& name : m_coordinateNames) {
        const CoordinateSlot& slot = getCoordinateSlot(name);
        const SimTK::SpatialVec column = m_matter->getMobilizedBody(slot.body).getHCol(state, slot.u);
        SimTK::Vec6 motion;
        motion.updSubVec<3>(0) = column[0];
        motion.updSubVec<3>(3) = column[1];
        const double size = motion.norm();
        for (const SimTK::Vec6& before : motions[slot.body]) motion -= ~before * motion * before;
        if (!(motion.norm() > kLeastSine * size)) return &name;
        motions[slot.body].push_back(motion / motion.norm());
    }
    return nullptr;
}

SimTK::Vec3 BuiltModel::calcStationLocation(const SimTK::State& state, const std::string& body,
                                            const SimTK::Vec3& station_B) const {
    return getBody(body).findStationLocationInGround(state, station_B);
}

}  // namespace tautline::models
