// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_description.h"

#include <algorithm>

namespace tautline::models {
namespace {

template <class Item>
const Item* findByName(const std::vector<Item>& items, const std::string& name) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
}

/** Of coordinate `index` of a joint. */
bool isRotational(const Joint& joint, std::size_t index) {
    switch (joint.type) {
        case JointType::Slider:
            return false;
        case JointType::Planar:
            return index == 0;
        case JointType::Free:
            return index < 3;
        case JointType::Custom:
            return std::any_of(joint.axes.begin(), joint.axes.begin() + 3, [&](const TransformAxis& axis) {
                return std::count(axis.coordinates.begin(), axis.coordinates.end(), joint.coordinates[index].name) > 0;
            });
        default:
            return true;
    }
}

}  // namespace

const Body* findBody(const ModelDescription& model, const std::string& name) {
    return findByName(model.bodies, name);
}

const Coordinate* findCoordinate(const ModelDescription& model, const std::string& name) {
    for (const Joint& joint : model.joints)
        if (const Coordinate* found = findByName(joint.coordinates, name)) return found;
    return nullptr;
}

bool isRotational(const ModelDescription& model, const std::string& coordinate) {
    for (const Joint& joint : model.joints)
        for (std::size_t i = 0; i < joint.coordinates.size(); ++i)
            if (joint.coordinates[i].name == coordinate) return isRotational(joint, i);
    return false;
}

const Muscle* findMuscle(const ModelDescription& model, const std::string& name) {
    return findByName(model.muscles, name);
}

const PathSpring* findSpring(const ModelDescription& model, const std::string& name) {
    return findByName(model.springs, name);
}

const PathForce* findPathForce(const ModelDescription& model, const std::string& name) {
    return findByName(model.pathForces, name);
}

const WrapObject* findWrapObject(const ModelDescription& model, const std::string& name) {
    return findByName(model.wrapObjects, name);
}

}  // namespace tautline::models
