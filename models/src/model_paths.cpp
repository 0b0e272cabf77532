// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_paths.h"

#include <algorithm>

#include "body_forces.h"
#include "path_force_laws.h"
#include "tautline/models/crossed_coordinates.h"
#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"
#include "wrap_conditions.h"

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
    return [placed = PlacedPoint(point, model)](const SimTK::State& state) { return placed.isActive(state); };
}

/** A cable between the ends of a path. */
Cable makeCable(CablePathSubsystem& cables, const ModelDescription& description, const std::string& owner,
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

/** Where cables and forces are added. */
struct Site {
    const ModelDescription& description;
    const BuiltModel& bodies;
    SimTK::GeneralForceSubsystem& forces;
    CablePathSubsystem& cables;
};

Cable addCable(const Site& site, const std::string& kind, const std::string& name, const MusclePath& path,
               const std::vector<BoundWrap>& wraps) {
    const std::string owner = kind + " '" + name + "'";
    const std::vector<PathPoint>& points = path.points;
    Cable cable = makeCable(site.cables, site.description, owner, name, path, site.bodies);
    std::size_t next = 0;
    for (std::size_t p = 0; p + 1 < points.size(); ++p) {
        if (p > 0) addPoint(cable, points[p], site.bodies);
        for (; next < wraps.size() && wraps[next].segment == p; ++next) {
            const WrapObject& object = site.description.wrapObjects[wraps[next].object];
            const CableElementIndex obstacle =
                cable.addObstacle(site.bodies.getBody(object.body), toTransform(object.X_BW), wraps[next].surface,
                                  wraps[next].hint_W, makeObstacleName(site.description, wraps, next));
            if (auto isActive = makeWrapCondition(site.description, path, wraps[next], site.bodies))
                cable.setCondition(obstacle, std::move(isActive));
        }
    }
    return cable;
}

/** A slot with all that the slots of cables have in common. */
template <class Slot, class Owner>
Slot makeSlot(const Site& site, const std::string& kind, const Owner& owner, const std::vector<BoundWrap>& wraps) {
    Slot slot;
    slot.name = owner.name;
    slot.path = "/forceset/" + owner.name;
    slot.wraps = wraps;
    slot.cable = addCable(site, kind, owner.name, owner.path, wraps);
    slot.start = makePathStart(wraps, slot.cable);
    slot.coordinates = findCrossedCoordinates(site.description, owner.path);
    return slot;
}

ModelPaths::MuscleSlot add(const Site& site, const models::Muscle& muscle, const std::vector<BoundWrap>& wraps) {
    auto slot = makeSlot<ModelPaths::MuscleSlot>(site, "muscle", muscle, wraps);
    slot.muscle = tautline::Muscle(site.forces, slot.cable, muscle.model);
    if (!muscle.appliesForce) slot.muscle.setDisabledByDefault(true);
    return slot;
}

ModelPaths::SpringSlot add(const Site& site, const PathSpring& spring, const std::vector<BoundWrap>& wraps) {
    auto slot = makeSlot<ModelPaths::SpringSlot>(site, "path spring", spring, wraps);
    slot.spring =
        ElasticStringForce(site.forces, slot.cable, spring.stiffness, spring.restingLength, spring.dissipation);
    if (!spring.appliesForce) slot.spring.setDisabledByDefault(true);
    return slot;
}

ModelPaths::PathForceSlot add(const Site& site, const PathForce& force, const std::vector<BoundWrap>& wraps) {
    auto slot = makeSlot<ModelPaths::PathForceSlot>(site, force.type, force, wraps);
    slot.force = makePathForce(site.forces, slot.cable, force, findControl(site.description, force.name));
    if (!force.appliesForce) slot.force.setDisabledByDefault(true);
    return slot;
}

}  // namespace

ModelPaths::ModelPaths(const ModelDescription& description, const std::vector<std::vector<BoundWrap>>& wraps,
                       const BuiltModel& bodies, SimTK::GeneralForceSubsystem& forces, CablePathSubsystem& cables) {
    const Site site{description, bodies, forces, cables};
    std::size_t next = 0;
    const auto addTo = [&](auto& slots, const auto& owner) {
        if (owner.path.functions)
            m_functionPaths.push_back({owner.name, "/forceset/" + owner.name,
                                       FunctionBasedPath(*owner.path.functions, bodies),
                                       findCrossedCoordinates(description, owner.path)});
        else
            slots.push_back(add(site, owner, wraps[next]));
        ++next;
    };
    for (const models::Muscle& muscle : description.muscles) addTo(m_muscles, muscle);
    for (const PathSpring& spring : description.springs) addTo(m_springs, spring);
    for (const PathForce& force : description.pathForces) addTo(m_pathForces, force);
}

std::vector<ModelPaths::PathView> ModelPaths::getPaths() const {
    std::vector<PathView> paths;
    for (const MuscleSlot& slot : m_muscles)
        paths.push_back({slot.name, slot.path, slot.cable, slot.muscle, slot.wraps, slot.start, slot.coordinates});
    for (const SpringSlot& slot : m_springs)
        paths.push_back({slot.name, slot.path, slot.cable, slot.spring, slot.wraps, slot.start, slot.coordinates});
    for (const PathForceSlot& slot : m_pathForces)
        paths.push_back({slot.name, slot.path, slot.cable, slot.force, slot.wraps, slot.start, slot.coordinates});
    return paths;
}

std::vector<const MusclePath*> listPaths(const ModelDescription& description) {
    std::vector<const MusclePath*> paths;
    for (const models::Muscle& muscle : description.muscles) paths.push_back(&muscle.path);
    for (const PathSpring& spring : description.springs) paths.push_back(&spring.path);
    for (const PathForce& force : description.pathForces) paths.push_back(&force.path);
    return paths;
}

}  // namespace tautline::models
