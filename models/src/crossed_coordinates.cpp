// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/crossed_coordinates.h"

#include <algorithm>
#include <map>
#include <set>

namespace tautline::models {
namespace {

using Names = std::set<std::string>;

/** The joint by which a body hangs on the one that leads to the start of a search. */
using JointsToStart = std::map<std::string, const Joint*>;

/** The joints as a tree that hangs on a body, whichever way they are written in the file. */
JointsToStart findJointsTo(const ModelDescription& description, const std::string& start) {
    JointsToStart joints{{start, nullptr}};
    for (bool grows = true; grows;) {
        grows = false;
        for (const Joint& joint : description.joints) {
            const bool hasParent = joints.count(joint.parentBody) > 0, hasChild = joints.count(joint.childBody) > 0;
            if (hasParent == hasChild) continue;
            joints[hasParent ? joint.childBody : joint.parentBody] = &joint;
            grows = true;
        }
    }
    return joints;
}

/** Adds the coordinates of the joints between bodies. */
void addBetween(const ModelDescription& description, const std::vector<std::string>& bodies, Names& coordinates) {
    if (bodies.empty()) return;
    const JointsToStart joints = findJointsTo(description, bodies.front());
    for (std::string body : bodies) {
        for (auto at = joints.find(body); at != joints.end() && at->second; at = joints.find(body)) {
            const Joint& joint = *at->second;
            for (const Coordinate& coordinate : joint.coordinates) coordinates.insert(coordinate.name);
            body = joint.childBody == body ? joint.parentBody : joint.childBody;
        }
    }
}

/** The coordinates that a constraint binds together. */
Names findBound(const ModelDescription& description, const ModelConstraint& constraint) {
    Names names;
    if (const auto* coupler = std::get_if<CoordinateCoupler>(&constraint)) {
        names.insert(coupler->independentCoordinates.begin(), coupler->independentCoordinates.end());
        names.insert(coupler->dependentCoordinate);
    } else if (const auto* point = std::get_if<PointConstraint>(&constraint)) {
        addBetween(description, {point->body1, point->body2}, names);
    } else if (const auto* weld = std::get_if<WeldConstraint>(&constraint)) {
        addBetween(description, {weld->body1, weld->body2}, names);
    } else if (const auto* line = std::get_if<PointOnLineConstraint>(&constraint)) {
        addBetween(description, {line->lineBody, line->followerBody}, names);
    } else if (const auto* rod = std::get_if<ConstantDistanceConstraint>(&constraint)) {
        addBetween(description, {rod->body1, rod->body2}, names);
    }
    return names;
}

/** Adds what constraints make move along. */
void followConstraints(const ModelDescription& description, Names& coordinates) {
    std::vector<Names> bound;
    for (const ModelConstraint& constraint : description.constraints)
        bound.push_back(findBound(description, constraint));
    for (std::size_t before = 0; before != coordinates.size();) {
        before = coordinates.size();
        for (const Names& names : bound) {
            const bool meets = std::any_of(names.begin(), names.end(),
                                           [&](const std::string& name) { return coordinates.count(name) > 0; });
            if (meets) coordinates.insert(names.begin(), names.end());
        }
    }
}

}  // namespace

std::vector<std::string> findCrossedCoordinates(const ModelDescription& description, const MusclePath& path) {
    Names crossed;
    std::vector<std::string> bodies;
    for (const PathPoint& point : path.points) {
        bodies.push_back(point.body);
        if (const auto* moving = std::get_if<MovingLocation>(&point.kind)) crossed.insert(moving->coordinate);
    }
    for (const PathWrap& wrap : path.wraps)
        if (const WrapObject& object = description.wrapObjects[wrap.wrapObject]; object.active)
            bodies.push_back(object.body);
    addBetween(description, bodies, crossed);
    if (path.functions) crossed.insert(path.functions->coordinates.begin(), path.functions->coordinates.end());
    followConstraints(description, crossed);
    std::vector<std::string> names;
    for (const Joint& joint : description.joints)
        for (const Coordinate& coordinate : joint.coordinates)
            if (crossed.count(coordinate.name)) names.push_back(coordinate.name);
    return names;
}

}  // namespace tautline::models
