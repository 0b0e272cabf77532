// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_system.h"

#include <algorithm>
#include <set>

#include "body_forces.h"
#include "model_skeleton.h"
#include "path_force_laws.h"
#include "tautline/models/coordinate_coupling.h"
#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

/** Where a moving point is on its body, its coordinate clipped to the range: past it the point rests. */
std::shared_ptr<const MovingStation> makeStation(const MovingLocation& moving, const BuiltModel& model) {
    const BuiltModel::CoordinateSlot& slot = model.getCoordinateSlot(moving.coordinate);
    const SimTK::Transform X_BF = toTransform(moving.X_BF);
    const auto calcLocation = [location_F = moving.location_F](int order, double q) {
        SimTK::Vec3 result;
        for (int i = 0; i < 3; ++i) result[i] = location_F[i].calcDerivativeOfOrder(order, q);
        return result;
    };
    const std::array<double, 2> range = slot.range;
    return std::make_shared<CoordinateStation>(
        model.getMatter().getMobilizedBody(slot.body), slot.q, slot.u,
        [=](double q) { return X_BF * calcLocation(0, std::clamp(q, range[0], range[1])); },
        [=](double q) { return q < range[0] || q > range[1] ? SimTK::Vec3(0) : X_BF.R() * calcLocation(1, q); });
}

std::function<bool(const SimTK::State&)> makeCondition(const PathPoint& point, const BuiltModel& model) {
    return [point, model](const SimTK::State& state) { return isPointActive(point, model, state); };
}

/** A cable between the ends of a path. */
Cable makeCable(CableSubsystem& cables, const ModelDescription& description, const std::string& owner,
                const std::string& name, const MusclePath& path, const BuiltModel& model) {
    const PathPoint &first = path.points.front(), &last = path.points.back();
    for (const PathPoint* end : {&first, &last})
        if (std::holds_alternative<ConditionalLocation>(end->kind))
            throw ModelError(description.fileName, end->line,
                             owner + ": point '" + end->name +
                                 "' is an end of the path and conditional, which a simulated path cannot do");
    const auto getStation = [](const PathPoint& end) {
        return std::holds_alternative<FixedLocation>(end.kind) ? toSimTK(end.location) : SimTK::Vec3(0);
    };
    Cable cable(cables, model.getBody(first.body), getStation(first), model.getBody(last.body), getStation(last), name);
    if (const auto* moving = std::get_if<MovingLocation>(&first.kind))
        cable.setMovingOrigin(makeStation(*moving, model));
    if (const auto* moving = std::get_if<MovingLocation>(&last.kind))
        cable.setMovingInsertion(makeStation(*moving, model));
    return cable;
}

void addPoint(Cable& cable, const PathPoint& point, const BuiltModel& model) {
    const SimTK::MobilizedBody& body = model.getBody(point.body);
    if (const auto* moving = std::get_if<MovingLocation>(&point.kind))
        cable.addMovingPoint(body, makeStation(*moving, model), point.name);
    else if (std::holds_alternative<ConditionalLocation>(point.kind))
        cable.addConditionalPoint(body, toSimTK(point.location), makeCondition(point, model), point.name);
    else
        cable.addViaPoint(body, toSimTK(point.location), point.name);
}

/** An object that is bound to several segments is told apart by a number. */
std::string makeObstacleName(const ModelDescription& description, const std::vector<BoundWrap>& wraps,
                             std::size_t index) {
    const std::string& name = description.wrapObjects[wraps[index].object].name;
    const auto isSame = [&](const BoundWrap& wrap) { return description.wrapObjects[wrap.object].name == name; };
    const auto before = std::count_if(wraps.begin(), wraps.begin() + static_cast<std::ptrdiff_t>(index), isSame);
    return before == 0 ? name : name + "_" + std::to_string(before + 1);
}

/** Calls visit(owner) for all forces with paths. */
template <class Visitor>
void forEachOwner(const ModelDescription& description, Visitor visit) {
    for (const Muscle& muscle : description.muscles) visit(muscle);
    for (const PathSpring& spring : description.springs) visit(spring);
    for (const PathForce& force : description.pathForces) visit(force);
}

}  // namespace

ModelSystem::ModelSystem(const ModelDescription& description)
    : m_matter(m_system), m_forces(m_system), m_cables(m_system), m_model(buildMultibody(description, m_matter)) {
    addGravity(description, m_forces, m_model);
    addBodyForces(description, {m_system, m_forces, m_contacts, m_model});
    // Poses are sampled in a system of its own: muscles must be added before the topology is realized.
    const ModelSkeleton binding(description);
    std::vector<const MusclePath*> paths;
    forEachOwner(description, [&](const auto& owner) { paths.push_back(&owner.path); });
    const auto wraps = bindWraps(description, paths, binding.model, binding.state);
    std::size_t next = 0;
    forEachOwner(description, [&](const auto& owner) { addOwner(description, owner, wraps[next++]); });
}

template <class Owner>
void ModelSystem::addOwner(const ModelDescription& description, const Owner& owner,
                           const std::vector<BoundWrap>& wraps) {
    if (owner.path.functions)
        m_functionPaths.push_back(
            {owner.name, "/forceset/" + owner.name, FunctionBasedPath(*owner.path.functions, m_model)});
    else
        add(description, owner, wraps);
}

Cable ModelSystem::addCable(const ModelDescription& description, const std::string& kind, const std::string& name,
                            const MusclePath& path, const std::vector<BoundWrap>& wraps) {
    const std::string owner = kind + " '" + name + "'";
    const std::vector<PathPoint>& points = path.points;
    Cable cable = makeCable(m_cables, description, owner, name, path, m_model);
    std::size_t next = 0;
    for (std::size_t p = 0; p + 1 < points.size(); ++p) {
        if (p > 0) addPoint(cable, points[p], m_model);
        for (; next < wraps.size() && wraps[next].segment == p; ++next) {
            const WrapObject& object = description.wrapObjects[wraps[next].object];
            cable.addObstacle(m_model.getBody(object.body), toTransform(object.X_BW), wraps[next].surface,
                              wraps[next].hint_W, makeObstacleName(description, wraps, next));
        }
    }
    return cable;
}

void ModelSystem::add(const ModelDescription& description, const models::Muscle& muscle,
                      const std::vector<BoundWrap>& wraps) {
    MuscleSlot slot;
    slot.name = muscle.name;
    slot.path = "/forceset/" + muscle.name;
    slot.wraps = wraps;
    slot.cable = addCable(description, "muscle", muscle.name, muscle.path, wraps);
    slot.start = makePathStart(wraps, slot.cable);
    slot.muscle = Muscle(m_forces, slot.cable, muscle.model);
    if (!muscle.appliesForce) slot.muscle.setDisabledByDefault(true);
    m_muscles.push_back(std::move(slot));
}

void ModelSystem::add(const ModelDescription& description, const PathSpring& spring,
                      const std::vector<BoundWrap>& wraps) {
    SpringSlot slot;
    slot.name = spring.name, slot.path = "/forceset/" + spring.name, slot.wraps = wraps;
    slot.cable = addCable(description, "path spring", spring.name, spring.path, wraps);
    slot.start = makePathStart(wraps, slot.cable);
    slot.spring = ElasticStringForce(m_forces, slot.cable, spring.restingLength, spring.stiffness, spring.dissipation);
    if (!spring.appliesForce) slot.spring.setDisabledByDefault(true);
    m_springs.push_back(std::move(slot));
}

void ModelSystem::add(const ModelDescription& description, const PathForce& force,
                      const std::vector<BoundWrap>& wraps) {
    PathForceSlot slot;
    slot.name = force.name;
    slot.path = "/forceset/" + force.name;
    slot.wraps = wraps;
    slot.cable = addCable(description, force.type, force.name, force.path, wraps);
    slot.start = makePathStart(wraps, slot.cable);
    slot.force = makePathForce(m_forces, slot.cable, force, findControl(description, force.name));
    if (!force.appliesForce) slot.force.setDisabledByDefault(true);
    m_pathForces.push_back(std::move(slot));
}

std::vector<ModelSystem::PathView> ModelSystem::getPaths() const {
    std::vector<PathView> paths;
    for (const MuscleSlot& slot : m_muscles)
        paths.push_back({slot.name, slot.path, slot.cable, slot.muscle, slot.wraps, slot.start});
    for (const SpringSlot& slot : m_springs)
        paths.push_back({slot.name, slot.path, slot.cable, slot.spring, slot.wraps, slot.start});
    for (const PathForceSlot& slot : m_pathForces)
        paths.push_back({slot.name, slot.path, slot.cable, slot.force, slot.wraps, slot.start});
    return paths;
}

SimTK::State ModelSystem::makeDefaultState() {
    SimTK::State state = m_system.realizeTopology();
    m_system.realizeModel(state);
    m_model.setDefaultPose(state);
    return state;
}

std::vector<MuscleEquilibrium> ModelSystem::equilibrateMuscles(SimTK::State& state) const {
    m_system.realize(state, SimTK::Stage::Position);
    std::vector<MuscleEquilibrium> found;
    for (const MuscleSlot& slot : m_muscles) found.push_back(slot.muscle.equilibrate(state));
    return found;
}

void ModelSystem::requireRegularPose(const SimTK::State& state) const {
    const std::string* singular = m_model.findSingularCoordinate(state);
    if (!singular) return;
    throw ModelError("coordinate '" + *singular + "' is at " + std::to_string(m_model.getCoordinate(state, *singular)) +
                     " where it moves nothing that other coordinates of its joint do not move, or nothing at all: a "
                     "simulation cannot start there");
}

double ModelSystem::calcMomentArm(const SimTK::State& state, const Cable& cable, const std::string& coordinate) const {
    m_model.getCoordinateSlot(coordinate);  // refuses unknown names
    const std::vector<std::string>& names = m_model.getCoordinateNames();
    const auto at = std::find(names.begin(), names.end(), coordinate);
    return calcMomentArms(state, cable)[static_cast<std::size_t>(at - names.begin())];
}

std::vector<double> ModelSystem::calcMomentArms(const SimTK::State& state, const Cable& cable) const {
    SimTK::Vector unitForces;
    cable.calcUnitMobilityForces(state, unitForces);
    return CoordinateCoupling(m_model, state).calcEffectiveArms(unitForces);
}

}  // namespace tautline::models
