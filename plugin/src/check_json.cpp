// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "check_report.h"

namespace tautline {
namespace {

using nlohmann::ordered_json;

const char* getName(models::Effect effect) {
    return effect == models::Effect::None ? "nothing" : effect == models::Effect::Forces ? "forces" : "motion";
}

ordered_json toJson(const models::UnknownElement& element) {
    return {{"kind", element.kind},
            {"type", element.type},
            {"name", element.name},
            {"line", element.line},
            {"changes", getName(element.effect)}};
}

ordered_json toJson(const models::SkippedElements& skipped) {
    return {{"element", skipped.element}, {"owner", skipped.owner},   {"count", skipped.count},
            {"line", skipped.firstLine},  {"reason", skipped.reason}, {"changes", getName(skipped.effect)}};
}

ordered_json toJson(const models::CheckedObstacle& obstacle) {
    return {{"name", obstacle.name},
            {"shape", obstacle.shape},
            {"segment", obstacle.segment},
            {"posesTouched", obstacle.numTouched},
            {"posesPointInside", obstacle.numEntered},
            {"posesPassedOver", obstacle.numPassedOver}};
}

ordered_json toJson(const models::CheckedDeviation& deviation) {
    const bool isSection = deviation.kind == models::CheckedDeviation::Kind::PlaneSection;
    return {{"how", isSection ? "section" : "several"},
            {"object", deviation.obstacle},
            {"poses", deviation.numPoses},
            {"byLength", deviation.byLength},
            {"at", deviation.where}};
}

ordered_json toJson(const models::CheckedMuscle& muscle) {
    return {{"shortestFiber", muscle.shortestFiber}, {"longestFiber", muscle.longestFiber},
            {"longestAt", muscle.longestAt},         {"largestTendonForce", muscle.largestTendonForce},
            {"posesTooShort", muscle.numTooShort},   {"canBeTooLong", muscle.canBeTooLong()}};
}

ordered_json toJson(const models::CheckedPath& path);

template <class Range>
ordered_json toArray(const Range& range) {
    ordered_json array = ordered_json::array();
    for (const auto& item : range) array.push_back(toJson(item));
    return array;
}

ordered_json toJson(const models::CheckedPath& path) {
    ordered_json json = {{"name", path.name},
                         {"type", path.type},
                         {"points", path.numPoints},
                         {"shortest", path.shortest},
                         {"longest", path.longest},
                         {"posesNotSolved", path.numUnsound},
                         {"firstFault", path.firstFault}};
    json["wraps"] = toArray(path.obstacles);
    json["differsFromOpenSim"] = toArray(path.deviations);
    json["muscle"] = path.muscle ? toJson(*path.muscle) : ordered_json();
    return json;
}

ordered_json toJson(const models::Coordinate& coordinate) {
    ordered_json json = {{"name", coordinate.name}, {"default", coordinate.defaultValue}};
    // JSON has no infinity: null.
    json["range"] = {coordinate.range[0], coordinate.range[1]};
    for (int i : {0, 1})
        if (!std::isfinite(coordinate.range[static_cast<std::size_t>(i)])) json["range"][i] = nullptr;
    json["locked"] = coordinate.locked;
    json["driven"] = coordinate.prescribedMotion.has_value();
    return json;
}

}  // namespace

void printCheckAsJson(const CheckedModel& model, std::ostream& out) {
    const models::ModelDescription& description = model.description;
    ordered_json json = {{"file", description.fileName},
                         {"model", description.name},
                         {"documentVersion", description.documentVersion},
                         {"bodies", description.bodies.size()},
                         {"muscles", description.muscles.size()}};
    json["coordinates"] = ordered_json::array();
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates)
            json["coordinates"].push_back(toJson(coordinate));
    json["notSupported"] = toArray(model.unknown);
    json["leftOut"] = toArray(description.skipped);
    json["notes"] = ordered_json::array();
    for (const models::ReadingNote& note : description.notes)
        json["notes"].push_back({{"line", note.line}, {"text", note.text}});
    json["poses"] = model.check.numPoses;
    json["posesWithBrokenConstraints"] = model.check.numBrokenConstraints;
    json["paths"] = toArray(model.check.paths);
    // Names in files may be in any encoding.
    out << json.dump(2, ' ', false, ordered_json::error_handler_t::replace) << "\n";
}

}  // namespace tautline
