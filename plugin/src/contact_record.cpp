// SPDX-License-Identifier: Apache-2.0
#include "contact_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "storage_file.h"

namespace tautline {
namespace {

using models::ModelSystem;

const char* const kHeading = "path,obstacle,x,y,z,dx,dy,dz,length";
constexpr std::size_t kNumFields = 9;

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& what) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
}

/** The last fields are numbers: names may have commas in them. */
std::vector<std::string> splitFields(const std::string& line) {
    std::vector<std::string> fields;
    std::string rest = line;
    while (fields.size() + 2 < kNumFields) {
        const std::size_t comma = rest.rfind(',');
        if (comma == std::string::npos) return {};
        fields.insert(fields.begin(), rest.substr(comma + 1));
        rest.resize(comma);
    }
    const std::size_t comma = rest.find(',');
    if (comma == std::string::npos) return {};
    fields.insert(fields.begin(), {rest.substr(0, comma), rest.substr(comma + 1)});
    return fields;
}

double parseNumber(const std::string& text, const std::filesystem::path& file, int line) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fail(file, line, "'" + text + "' is not a finite number");
    return value;
}

RecordedContact parseContact(const std::string& text, const std::filesystem::path& file, int line) {
    const std::vector<std::string> fields = splitFields(text);
    if (fields.empty()) fail(file, line, "a contact has the fields " + std::string(kHeading));
    RecordedContact contact;
    contact.path = fields[0], contact.obstacle = fields[1];
    for (int i = 0; i < 3; ++i) {
        contact.point[i] = parseNumber(fields[2 + static_cast<std::size_t>(i)], file, line);
        contact.direction[i] = parseNumber(fields[5 + static_cast<std::size_t>(i)], file, line);
    }
    contact.length = parseNumber(fields[8], file, line);
    return contact;
}

/** What one path touches, and where: arcs of one obstacle follow each other. @throws std::runtime_error naming an
 * obstacle that it does not have */
PathSolution makeStart(const std::vector<RecordedContact>& contacts, const ModelSystem::PathView& path) {
    PathSolution start;
    start.contacts.resize(static_cast<std::size_t>(path.cable.getNumElements()));
    for (const RecordedContact& contact : contacts) {
        if (contact.path != path.path) continue;
        const CableElementIndex e = path.cable.findElement(contact.obstacle);
        const std::shared_ptr<const Surface> surface = path.cable.getSurface(e);
        if (!surface) throw std::runtime_error("'" + contact.obstacle + "' of " + path.path + " is no obstacle");
        ObstacleContact& obstacle = start.contacts[static_cast<std::size_t>(e)];
        if (std::exchange(obstacle.isTouched, true)) obstacle.furtherArcs.emplace_back();
        GeodesicStart& arc = obstacle.updArc(obstacle.getNumArcs() - 1).start;
        arc.point = surface->findSurfacePoint(contact.point);
        arc.tangent = surface->calcFrame(arc.point, contact.direction).t;
        arc.length = contact.length;
    }
    return start;
}

std::string makeArcFields(const GeodesicStart& arc) {
    std::string text;
    for (const Vector3& vector : {arc.point.p, arc.tangent})
        for (int i = 0; i < 3; ++i) text += "," + toText(vector[i]);
    return text + "," + toText(arc.length);
}

}  // namespace

std::string makeContactText(const ModelSystem& model, const SimTK::State& state) {
    std::string text = std::string(kHeading) + "\n";
    for (const ModelSystem::PathView& path : model.getPaths())
        for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e) {
            if (!path.cable.isObstacle(e)) continue;
            const ObstacleContact& contact = path.cable.getSolution(state).contacts[e];
            for (int i = 0; i < contact.getNumArcs(); ++i)
                text += path.path + "," + path.cable.getElementName(e) + makeArcFields(contact.getArc(i).start) + "\n";
        }
    return text;
}

std::vector<RecordedContact> readContacts(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string text;
    if (!std::getline(stream, text) || text != kHeading)
        fail(file, 1, "is missing or does not begin with '" + std::string(kHeading) + "'");
    std::vector<RecordedContact> contacts;
    for (int line = 2; std::getline(stream, text); ++line) contacts.push_back(parseContact(text, file, line));
    return contacts;
}

void continueContacts(const std::vector<RecordedContact>& contacts, const ModelSystem& model, SimTK::State& state) {
    for (const RecordedContact& contact : contacts) {
        const auto paths = model.getPaths();
        if (std::none_of(paths.begin(), paths.end(), [&](const auto& path) { return path.path == contact.path; }))
            throw std::runtime_error("the model has no path '" + contact.path + "'");
    }
    for (const ModelSystem::PathView& path : model.getPaths()) {
        if (path.cable.isDisabled(state) || path.cable.getNumObstacles() == 0) continue;
        model.getSystem().realize(state, SimTK::Stage::Position);
        PathSolution solution = makeStart(contacts, path);
        PathSolver solver(path.cable.getOptions());
        solver.solveKeepingContacts(path.cable.getPathProblem(), path.cable.getPathPose(state), solution);
        if (solution.status == PathStatus::Solved) path.cable.continueFrom(state, solution);
    }
}

}  // namespace tautline
