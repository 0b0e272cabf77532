// SPDX-License-Identifier: Apache-2.0
#include "body_forces.h"

#include <algorithm>

#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

using SimTK::Real;
using SimTK::State;
using SimTK::Vector;

/** A generalized force on one coordinate. */
class CoordinateForce : public SimTK::Force::Custom::Implementation {
public:
    CoordinateForce(const BuiltModel& model, std::string coordinate)
        : m_model(model), m_coordinate(std::move(coordinate)) {}

    void calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>&, SimTK::Vector_<SimTK::Vec3>&,
                   Vector& mobilityForces) const override {
        const auto& slot = m_model.getCoordinateSlot(m_coordinate);
        m_model.getMatter().getMobilizedBody(slot.body).applyOneMobilityForce(state, slot.u, calcForceOn(state),
                                                                              mobilityForces);
    }
    Real calcPotentialEnergy(const State&) const override { return 0; }

protected:
    virtual Real calcForceOn(const State& state) const = 0;
    Real getValue(const State& state) const { return m_model.getCoordinate(state, m_coordinate); }
    Real getSpeed(const State& state) const { return m_model.getCoordinateSpeed(state, m_coordinate); }

private:
    BuiltModel m_model;
    std::string m_coordinate;
};

/** Beyond a limit by d: stiffness and damping grow by the step S(d / transition), S(x) = 10 x^3 - 15 x^4 + 6 x^5, to
their whole, so that force = -k S d - c S qdot. */
class LimitForce : public CoordinateForce {
public:
    LimitForce(const BuiltModel& model, const CoordinateLimitForce& limits)
        : CoordinateForce(model, limits.coordinate), m_limits(limits) {}

    Real calcPotentialEnergy(const State& state) const override {
        const Real q = getValue(state);
        return calcEnergy(m_limits.upperStiffness, q - m_limits.upperLimit) +
               calcEnergy(m_limits.lowerStiffness, m_limits.lowerLimit - q);
    }

protected:
    Real calcForceOn(const State& state) const override {
        const Real above = getValue(state) - m_limits.upperLimit, below = m_limits.lowerLimit - getValue(state);
        const Real stepAbove = calcStep(above), stepBelow = calcStep(below);
        return m_limits.lowerStiffness * stepBelow * below - m_limits.upperStiffness * stepAbove * above -
               m_limits.damping * (stepAbove + stepBelow) * getSpeed(state);
    }

private:
    Real calcStep(Real d) const { return SimTK::stepUp(std::clamp(d / m_limits.transition, Real(0), Real(1))); }

    /** The integral of k S(d / t) d. */
    Real calcEnergy(Real k, Real d) const {
        if (d <= 0) return 0;
        const Real t = m_limits.transition, x = std::min(d / t, Real(1));
        const Real inside = k * t * t * x * x * x * x * x * (2 - 2.5 * x + 6 * x * x / 7);
        return d <= t ? inside : inside + k * (d * d - t * t) / 2;
    }

    CoordinateLimitForce m_limits;
};

class SpringForce : public CoordinateForce {
public:
    SpringForce(const BuiltModel& model, const CoordinateSpringForce& spring)
        : CoordinateForce(model, spring.coordinate), m_spring(spring) {}

    Real calcPotentialEnergy(const State& state) const override {
        return m_spring.stiffness * SimTK::square(getValue(state) - m_spring.restLength) / 2;
    }

protected:
    Real calcForceOn(const State& state) const override {
        return -m_spring.stiffness * (getValue(state) - m_spring.restLength) - m_spring.viscosity * getSpeed(state);
    }

private:
    CoordinateSpringForce m_spring;
};

/** optimal force times the control, or times an activation a that follows it: da/dt = (control - a) / tau. */
class ActuatorForce : public CoordinateForce {
public:
    ActuatorForce(SimTK::GeneralForceSubsystem& forces, const BuiltModel& model, const CoordinateActuator& actuator,
                  Control control)
        : CoordinateForce(model, actuator.coordinate),
          m_forces(forces),
          m_actuator(actuator),
          m_control(std::move(control)) {}

    void realizeTopology(State& state) const override {
        if (!m_actuator.activationTime) return;
        m_activation = m_forces.allocateZ(state, Vector(1, m_actuator.defaultActivation));
    }
    void realizeAcceleration(const State& state) const override {
        if (!m_actuator.activationTime) return;
        m_forces.updZDot(state)[m_activation] =
            (calcControl(state) - m_forces.getZ(state)[m_activation]) / *m_actuator.activationTime;
    }

protected:
    Real calcForceOn(const State& state) const override {
        const Real factor = m_actuator.activationTime ? m_forces.getZ(state)[m_activation] : calcControl(state);
        return m_actuator.optimalForce * factor;
    }

private:
    Real calcControl(const State& state) const {
        const Real control = m_control ? m_control(state.getTime()) : 0;
        return std::clamp(control, m_actuator.controlRange[0], m_actuator.controlRange[1]);
    }

    SimTK::GeneralForceSubsystem& m_forces;
    CoordinateActuator m_actuator;
    Control m_control;
    mutable SimTK::ZIndex m_activation;
};

/** Adds a force of each kind. */
struct ForceAdder {
    const ModelDescription& description;
    const BodyForce& force;
    ForceTarget target;

    SimTK::Force operator()(const CoordinateLimitForce& limits) const {
        return SimTK::Force::Custom(target.forces, new LimitForce(target.model, limits));
    }
    SimTK::Force operator()(const CoordinateSpringForce& spring) const {
        return SimTK::Force::Custom(target.forces, new SpringForce(target.model, spring));
    }
    SimTK::Force operator()(const CoordinateActuator& actuator) const {
        return SimTK::Force::Custom(target.forces, new ActuatorForce(target.forces, target.model, actuator,
                                                                     findControl(description, force.name)));
    }
    SimTK::Force operator()(const BushingForce& bushing) const {
        return SimTK::Force::LinearBushing(target.forces, target.model.getBody(bushing.body1),
                                           toTransform(bushing.X_B1F), target.model.getBody(bushing.body2),
                                           toTransform(bushing.X_B2F), toVec6(bushing.stiffness),
                                           toVec6(bushing.damping));
    }
    SimTK::Force operator()(const PointToPointSpring& spring) const {
        return SimTK::Force::TwoPointLinearSpring(target.forces, target.model.getBody(spring.body1),
                                                  toSimTK(spring.point1), target.model.getBody(spring.body2),
                                                  toSimTK(spring.point2), spring.stiffness, spring.restLength);
    }
    SimTK::Force operator()(const HuntCrossleyContact& contact) const {
        if (!target.contacts) target.contacts.emplace(target.system);
        SimTK::GeneralContactSubsystem& contacts = *target.contacts;
        const SimTK::ContactSetIndex set = contacts.createContactSet();
        SimTK::HuntCrossleyForce made(target.forces, contacts, set);
        for (const HuntCrossleyContact::Surface& surface : contact.surfaces) {
            const ContactGeometry& geometry = description.contactGeometries[surface.geometry];
            const SimTK::ContactSurfaceIndex index(contacts.getNumBodies(set));
            contacts.addBody(set, target.model.getBody(geometry.body), makeGeometry(geometry),
                             toTransform(geometry.X_BS));
            const ContactMaterial& material = surface.material;
            made.setBodyParameters(index, material.stiffness, material.dissipation, material.staticFriction,
                                   material.dynamicFriction, material.viscousFriction);
        }
        made.setTransitionVelocity(contact.transitionVelocity);
        return made;
    }
    SimTK::Force operator()(const SmoothSphereContact& contact) const {
        const ContactGeometry& sphere = description.contactGeometries[contact.sphere];
        const ContactGeometry& halfSpace = description.contactGeometries[contact.halfSpace];
        const ContactMaterial& material = contact.material;
        SimTK::SmoothSphereHalfSpaceForce made(target.forces);
        made.setParameters(material.stiffness, material.dissipation, material.staticFriction, material.dynamicFriction,
                           material.viscousFriction, contact.transitionVelocity, contact.constantContactForce,
                           contact.hertzSmoothing, contact.huntCrossleySmoothing);
        made.setContactSphereBody(target.model.getBody(sphere.body));
        made.setContactSphereLocationInBody(toSimTK(sphere.X_BS.p));
        made.setContactSphereRadius(std::get<SphereShape>(sphere.shape).radius);
        made.setContactHalfSpaceBody(target.model.getBody(halfSpace.body));
        made.setContactHalfSpaceFrame(toTransform(halfSpace.X_BS));
        return made;
    }

private:
    static SimTK::Vec6 toVec6(const std::array<double, 6>& six) { return SimTK::Vec6(six.data()); }

    static SimTK::ContactGeometry makeGeometry(const ContactGeometry& geometry) {
        if (const auto* sphere = std::get_if<SphereShape>(&geometry.shape))
            return SimTK::ContactGeometry::Sphere(sphere->radius);
        return SimTK::ContactGeometry::HalfSpace();
    }
};

}  // namespace

Control findControl(const ModelDescription& description, const std::string& actuator) {
    for (const PrescribedControl& control : description.controls)
        if (control.actuator == actuator)
            return [function = control.control](double time) { return function.calcValue(time); };
    return nullptr;
}

void addBodyForces(const ModelDescription& description, ForceTarget target) {
    for (const BodyForce& force : description.bodyForces) {
        SimTK::Force added = std::visit(ForceAdder{description, force, target}, force.law);
        if (!force.appliesForce) added.setDisabledByDefault(true);
    }
}

}  // namespace tautline::models
