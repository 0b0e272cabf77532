// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_builder.h"

#include <algorithm>

#include "multibody_plan.h"
#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

using SimTK::MobilizedBody;

/** A ScalarFunction of the first argument, or of time. */
class SimtkFunction : public SimTK::Function {
public:
    explicit SimtkFunction(ScalarFunction function) : m_function(std::move(function)) {}

    SimTK::Real calcValue(const SimTK::Vector& x) const override { return m_function.calcValue(x[0]); }
    SimTK::Real calcDerivative(const SimTK::Array_<int>& order, const SimTK::Vector& x) const override {
        return m_function.calcDerivativeOfOrder(static_cast<int>(order.size()), x[0]);
    }
    int getArgumentSize() const override { return 1; }
    int getMaxDerivativeOrder() const override { return 2; }
    SimtkFunction* clone() const override { return new SimtkFunction(*this); }

private:
    ScalarFunction m_function;
};

/** Drives all coordinates of a mobilizer, each by its own function of time. */
class DrivenMotion : public SimTK::Motion::Custom::Implementation {
public:
    explicit DrivenMotion(std::vector<ScalarFunction> functions) : m_functions(std::move(functions)) {}

    DrivenMotion* clone() const override { return new DrivenMotion(*this); }
    SimTK::Motion::Level getLevel(const SimTK::State&) const override { return SimTK::Motion::Position; }
    void calcPrescribedPosition(const SimTK::State& state, int nq, SimTK::Real* q) const override {
        calcDerivatives(0, state, nq, q);
    }
    void calcPrescribedPositionDot(const SimTK::State& state, int nq, SimTK::Real* qdot) const override {
        calcDerivatives(1, state, nq, qdot);
    }
    void calcPrescribedPositionDotDot(const SimTK::State& state, int nq, SimTK::Real* qdotdot) const override {
        calcDerivatives(2, state, nq, qdotdot);
    }

private:
    void calcDerivatives(int order, const SimTK::State& state, int nq, SimTK::Real* values) const {
        SimTK_ASSERT_ALWAYS(nq == static_cast<int>(m_functions.size()), "DrivenMotion: one function per coordinate");
        for (int i = 0; i < nq; ++i) values[i] = m_functions[i].calcDerivativeOfOrder(order, state.getTime());
    }

    std::vector<ScalarFunction> m_functions;
};

/** A MultivariateFunction for Simbody. */
class SimtkMultivariate : public SimTK::Function {
public:
    explicit SimtkMultivariate(MultivariateFunction function) : m_function(std::move(function)) {}

    SimTK::Real calcValue(const SimTK::Vector& x) const override { return m_function.calcValue(&x[0]); }
    SimTK::Real calcDerivative(const SimTK::Array_<int>& arguments, const SimTK::Vector& x) const override {
        return m_function.calcDerivative({arguments.begin(), arguments.end()}, &x[0]);
    }
    int getArgumentSize() const override { return m_function.getNumArguments(); }
    int getMaxDerivativeOrder() const override { return 2; }
    SimtkMultivariate* clone() const override { return new SimtkMultivariate(*this); }

private:
    MultivariateFunction m_function;
};

/** Whether all mobilities of a joint are prescribed. */
bool isDriven(const PlannedJoint& planned) {
    const std::vector<Coordinate>& coordinates = planned.joint->coordinates;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        if (planned.axes.mobilities[i] >= 0 && !(coordinates[i].prescribedMotion && !coordinates[i].locked))
            return false;
    return planned.axes.numMobilities > 0;
}

/** scale * f(independent...) - dependent, to be held at zero. */
class CouplerFunction : public SimTK::Function {
public:
    explicit CouplerFunction(const CoordinateCoupler& coupler)
        : m_function(coupler.function.scaledBy(coupler.scaleFactor)) {}

    SimTK::Real calcValue(const SimTK::Vector& x) const override {
        return m_function.calcValue(&x[0]) - x[getDependent()];
    }
    SimTK::Real calcDerivative(const SimTK::Array_<int>& components, const SimTK::Vector& x) const override {
        const bool byDependent = std::count(components.begin(), components.end(), getDependent()) > 0;
        if (byDependent) return components.size() == 1 ? -1.0 : 0.0;
        return m_function.calcDerivative({components.begin(), components.end()}, &x[0]);
    }
    int getArgumentSize() const override { return getDependent() + 1; }
    int getMaxDerivativeOrder() const override { return 2; }
    CouplerFunction* clone() const override { return new CouplerFunction(*this); }

private:
    int getDependent() const { return m_function.getNumArguments(); }

    MultivariateFunction m_function;
};

SimTK::MassProperties makeMassProperties(const Body& body) {
    const SimTK::Vec3 center = toSimTK(body.massCenter);
    const auto& I = body.inertia;
    const SimTK::Inertia central(I[0], I[1], I[2], I[3], I[4], I[5]);
    return {body.mass, center, central.shiftFromMassCenter(center, body.mass)};
}

MobilizedBody addFunctionBased(const PlannedJoint& planned, MobilizedBody& inboard,
                               const SimTK::Transform& inboardFrame, const SimTK::Body& body,
                               const SimTK::Transform& outboardFrame, MobilizedBody::Direction direction) {
    SimTK::Array_<const SimTK::Function*> functions;
    SimTK::Array_<SimTK::Array_<int>> arguments;
    SimTK::Array_<SimTK::Vec3> axes;
    for (std::size_t i = 0; i < 6; ++i) {
        const MultivariateFunction& function = planned.axes.functions[i];
        const std::vector<int>& mobilities = planned.axes.arguments[i];
        axes.push_back(planned.axes.axes[i]);
        arguments.push_back(SimTK::Array_<int>(mobilities.begin(), mobilities.end()));
        if (mobilities.empty())
            functions.push_back(new SimTK::Function::Constant(calcRestingValue(function), 0));
        else
            functions.push_back(new SimtkMultivariate(function));
    }
    return MobilizedBody::FunctionBased(inboard, inboardFrame, body, outboardFrame, planned.axes.numMobilities,
                                        functions, arguments, axes, direction);
}

MobilizedBody addMobilizer(const PlannedJoint& planned, MobilizedBody& inboard) {
    const Joint& joint = *planned.joint;
    const SimTK::Body::Rigid body(makeMassProperties(*planned.outboardBody));
    SimTK::Transform X_PF = toTransform(joint.parentOffset);
    SimTK::Transform X_CM = toTransform(joint.childOffset);
    const bool moves = planned.axes.numMobilities > 0;
    if (!moves) X_PF = X_PF * calcFixedTransform(planned.axes);
    const SimTK::Transform& inboardFrame = planned.reversed ? X_CM : X_PF;
    const SimTK::Transform& outboardFrame = planned.reversed ? X_PF : X_CM;
    const auto direction = planned.reversed ? MobilizedBody::Reverse : MobilizedBody::Forward;
    if (!moves) return MobilizedBody::Weld(inboard, inboardFrame, body, outboardFrame);
    if (joint.type == JointType::Pin) return MobilizedBody::Pin(inboard, inboardFrame, body, outboardFrame, direction);
    if (joint.type == JointType::Slider)
        return MobilizedBody::Slider(inboard, inboardFrame, body, outboardFrame, direction);
    return addFunctionBased(planned, inboard, inboardFrame, body, outboardFrame, direction);
}

}  // namespace

/** Carries out a plan; the steps that fill a BuiltModel. */
class MultibodyAssembly {
public:
    explicit MultibodyAssembly(SimTK::SimbodyMatterSubsystem& matter) : m_matter(matter) {
        m_built.m_matter = &matter;
        m_built.m_bodies[kGroundName] = matter.getGround().getMobilizedBodyIndex();
    }

    void addJoint(const PlannedJoint& planned) {
        const Joint& joint = *planned.joint;
        const std::string& inboardName = planned.reversed ? joint.childBody : joint.parentBody;
        MobilizedBody& inboard = m_matter.updMobilizedBody(m_built.m_bodies.at(inboardName));
        const SimTK::MobilizedBodyIndex index = addMobilizer(planned, inboard).getMobilizedBodyIndex();
        m_built.m_bodies[planned.outboardBody->name] = index;
        for (std::size_t i = 0; i < joint.coordinates.size(); ++i) {
            const int mobility = planned.axes.mobilities[i];
            if (mobility < 0)
                addCoordinate(joint.coordinates[i], addIdleBody(), 0, false);
            else
                addCoordinate(joint.coordinates[i], index, mobility, isDriven(planned));
        }
        if (isDriven(planned)) driveMobilizer(planned, index);
    }

    void addConstraint(const CoordinateCoupler& coupler) {
        SimTK::Array_<SimTK::MobilizedBodyIndex> bodies;
        SimTK::Array_<SimTK::MobilizerQIndex> coordinates;
        std::vector<std::string> names = coupler.independentCoordinates;
        names.push_back(coupler.dependentCoordinate);
        for (const std::string& name : names) {
            const auto& slot = m_built.getCoordinateSlot(name);
            bodies.push_back(slot.body);
            coordinates.push_back(slot.q);
        }
        SimTK::Constraint::CoordinateCoupler(m_matter, new CouplerFunction(coupler), bodies, coordinates);
        m_built.m_couplers.push_back(coupler);
    }

    void addConstraint(const PointConstraint& points) {
        MobilizedBody& body1 = m_matter.updMobilizedBody(m_built.getBodyIndex(points.body1));
        MobilizedBody& body2 = m_matter.updMobilizedBody(m_built.getBodyIndex(points.body2));
        SimTK::Constraint::Ball(body1, toSimTK(points.location1), body2, toSimTK(points.location2));
    }

    void addConstraint(const WeldConstraint& weld) {
        MobilizedBody& body1 = m_matter.updMobilizedBody(m_built.getBodyIndex(weld.body1));
        MobilizedBody& body2 = m_matter.updMobilizedBody(m_built.getBodyIndex(weld.body2));
        SimTK::Constraint::Weld(body1, toTransform(weld.X_B1F), body2, toTransform(weld.X_B2F));
    }

    void addConstraint(const PointOnLineConstraint& line) {
        MobilizedBody& lineBody = m_matter.updMobilizedBody(m_built.getBodyIndex(line.lineBody));
        MobilizedBody& follower = m_matter.updMobilizedBody(m_built.getBodyIndex(line.followerBody));
        SimTK::Constraint::PointOnLine(lineBody, SimTK::UnitVec3(toSimTK(line.direction)), toSimTK(line.pointOnLine),
                                       follower, toSimTK(line.follower));
    }

    void addConstraint(const ConstantDistanceConstraint& rod) {
        MobilizedBody& body1 = m_matter.updMobilizedBody(m_built.getBodyIndex(rod.body1));
        MobilizedBody& body2 = m_matter.updMobilizedBody(m_built.getBodyIndex(rod.body2));
        SimTK::Constraint::Rod(body1, toSimTK(rod.location1), body2, toSimTK(rod.location2), rod.distance);
    }

    /** The names in the order of the file, not of the tree. */
    BuiltModel finish(const ModelDescription& model) {
        for (const Joint& joint : model.joints)
            for (const Coordinate& coordinate : joint.coordinates) {
                m_built.m_coordinateNames.push_back(coordinate.name);
                m_built.m_coordinates.at(coordinate.name).path = "/jointset/" + joint.name + "/" + coordinate.name;
            }
        return m_built;
    }

private:
    /** A unit mass on a rail, away from gravity, that is a coordinate of a joint which does not use it: conditions,
    couplers and the user may. */
    SimTK::MobilizedBodyIndex addIdleBody() {
        const SimTK::Body::Rigid body(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1.0)));
        MobilizedBody::Slider idle(m_matter.updGround(), SimTK::Transform(), body, SimTK::Transform());
        m_built.m_idleBodies.push_back(idle.getMobilizedBodyIndex());
        return idle.getMobilizedBodyIndex();
    }

    void driveMobilizer(const PlannedJoint& planned, SimTK::MobilizedBodyIndex body) {
        std::vector<ScalarFunction> functions;
        const std::vector<Coordinate>& coordinates = planned.joint->coordinates;
        for (std::size_t i = 0; i < coordinates.size(); ++i)
            if (planned.axes.mobilities[i] >= 0) functions.push_back(*coordinates[i].prescribedMotion);
        SimTK::Motion::Custom(m_matter.updMobilizedBody(body), new DrivenMotion(std::move(functions)));
    }

    void addCoordinate(const Coordinate& coordinate, SimTK::MobilizedBodyIndex body, int index, bool isDriven) {
        BuiltModel::CoordinateSlot slot;
        slot.body = body;
        slot.q = SimTK::MobilizerQIndex(index);
        slot.u = SimTK::MobilizerUIndex(index);
        slot.defaultValue = coordinate.defaultValue;
        slot.defaultSpeed = coordinate.locked ? 0.0 : coordinate.defaultSpeed;
        slot.range = coordinate.range;
        slot.clamped = coordinate.clamped;
        slot.locked = coordinate.locked;
        if (coordinate.locked) {
            // A mobilizer can only be locked as a whole; a coordinate by a constraint.
            SimTK::Constraint::ConstantCoordinate lock(m_matter.updMobilizedBody(body), slot.q,
                                                       coordinate.defaultValue);
            slot.lock = lock.getConstraintIndex();
        } else if (coordinate.prescribedMotion && !isDriven) {
            // A Motion drives a mobilizer as a whole; a coordinate among free ones needs a constraint.
            SimTK::Constraint::PrescribedMotion drive(m_matter, new SimtkFunction(*coordinate.prescribedMotion), body,
                                                      slot.q);
            slot.drive = drive.getConstraintIndex();
        }
        if (!coordinate.locked) slot.prescribedMotion = coordinate.prescribedMotion;
        m_built.m_coordinates[coordinate.name] = slot;
    }

    SimTK::SimbodyMatterSubsystem& m_matter;
    BuiltModel m_built;
};

BuiltModel buildMultibody(const ModelDescription& model, SimTK::SimbodyMatterSubsystem& matter) {
    const std::vector<PlannedJoint> plan = planMultibody(model);
    MultibodyAssembly assembly(matter);
    for (const PlannedJoint& planned : plan) assembly.addJoint(planned);
    for (const ModelConstraint& constraint : model.constraints)
        std::visit([&](const auto& known) { assembly.addConstraint(known); }, constraint);
    return assembly.finish(model);
}

SimTK::Force::Gravity addGravity(const ModelDescription& model, SimTK::GeneralForceSubsystem& forces,
                                 const BuiltModel& built) {
    SimTK::Force::Gravity gravity(forces, built.getMatter(), toSimTK(model.gravity));
    for (SimTK::MobilizedBodyIndex idle : built.getIdleBodies()) gravity.setDefaultBodyIsExcluded(idle, true);
    return gravity;
}

}  // namespace tautline::models
