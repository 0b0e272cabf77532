// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_builder.h"

namespace tautline::models {

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
    for (const auto& [name, slot] : m_coordinates) {
        const auto& motion = slot.prescribedMotion;
        setCoordinate(state, name, motion ? motion->calcValue(state.getTime()) : slot.defaultValue);
        setCoordinateSpeed(state, name, motion ? motion->calcDerivative(state.getTime()) : slot.defaultSpeed);
    }
    applyCouplers(state);
}

void BuiltModel::setCoordinate(SimTK::State& state, const std::string& name, double value) const {
    const CoordinateSlot& slot = getCoordinateSlot(name);
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
        const double q = getCoordinate(state, coupler.independentCoordinate);
        const double u = getCoordinateSpeed(state, coupler.independentCoordinate);
        const ScalarFunction coupled = coupler.function.scaledBy(coupler.scaleFactor);
        setCoordinate(state, coupler.dependentCoordinate, coupled.calcValue(q));
        setCoordinateSpeed(state, coupler.dependentCoordinate, coupled.calcDerivative(q) * u);
    }
}

SimTK::Vec3 BuiltModel::calcStationLocation(const SimTK::State& state, const std::string& body,
                                            const SimTK::Vec3& station_B) const {
    return getBody(body).findStationLocationInGround(state, station_B);
}

}  // namespace tautline::models
