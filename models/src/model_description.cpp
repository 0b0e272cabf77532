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

}  // namespace

const Body* findBody(const ModelDescription& model, const std::string& name) {
    return findByName(model.bodies, name);
}

const Coordinate* findCoordinate(const ModelDescription& model, const std::string& name) {
    for (const Joint& joint : model.joints)
        if (const Coordinate* found = findByName(joint.coordinates, name)) return found;
    return nullptr;
}

const Muscle* findMuscle(const ModelDescription& model, const std::string& name) {
    return findByName(model.muscles, name);
}

const PathSpring* findSpring(const ModelDescription& model, const std::string& name) {
    return findByName(model.springs, name);
}

const WrapObject* findWrapObject(const ModelDescription& model, const std::string& name) {
    return findByName(model.wrapObjects, name);
}

}  // namespace tautline::models
