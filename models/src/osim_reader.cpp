// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/osim_reader.h"

#include <sstream>

#include "document.h"
#include "read_bodies.h"
#include "read_constraints.h"
#include "read_contact_geometry.h"
#include "read_controllers.h"
#include "read_forces.h"
#include "read_joints.h"
#include "read_meshes.h"
#include "read_paths.h"
#include "read_text.h"
#include "read_wrap_objects.h"
#include "tautline/models/function_based_path.h"

namespace tautline::models {
namespace {

/** The newest document version that is known. */
constexpr int kLastVersion = 40600;

/** Along -y, of a model that says nothing about it [m/s^2]. */
constexpr double kDefaultGravity = 9.80665;

int readVersion(const Element& document, const std::string& attribute) {
    int version = 0;
    std::istringstream text(attribute);
    if (!(text >> version) || !text.eof()) document.fail("the document version '" + attribute + "' is not a number");
    if (version > kLastVersion) {
        document.fail("document version " + attribute + " is newer than " + std::to_string(kLastVersion) +
                      ", the newest that is known");
    }
    return version;
}

/** The label of the units is only a label to OpenSim, too: it computes with the numbers as they are. */
void readUnits(Element& model, const std::string& tag, const std::vector<std::string>& accepted) {
    const Element units = model.find(tag);
    if (!units) return;
    for (const std::string& name : accepted)
        if (units.getText() == name) return;
    units.note(tag + " are '" + units.getText() + "'; the numbers are taken for " + accepted[0] + ", as OpenSim does");
}

void collectComponents(Element& model, BodyParts& parts) {
    if (Element set = model.find("ComponentSet"))
        for (const Element& member : set.getSetMembers()) addComponent(member, "/componentset", parts);
    if (const Element list = model.find("components"))
        for (const Element& member : list.getChildren()) addComponent(member, "", parts);
}

/** Constraints and forces between two frames may own them. */
void collectOwnedFrames(Element& model, BodyParts& parts) {
    for (const auto& [tag, path] :
         {std::pair("ConstraintSet", "/constraintset/"), std::pair("ForceSet", "/forceset/")}) {
        Element set = model.find(tag);
        if (!set) continue;
        Element members = set.find("objects");
        for (Element& owner : members.getChildren())
            if (const Element frames = owner.find("frames"))
                for (const Element& frame : frames.getChildren()) addComponent(frame, path + owner.getName(), parts);
    }
}

/** All that stands on bodies and pulls at them. */
void readActingParts(Element& element, BodyParts& parts) {
    readWrapObjects(parts);
    readMeshes(parts);
    readConstraints(element, parts.frames);
    readContactGeometries(element, parts.frames);
    readForces(element, parts.frames);
    readControllers(element);
}

void skipWithoutEffect(Element& model) {
    model.skip({"defaults"}, "defaults are no part of the model");
    model.skip({"credits", "publications", "ModelVisualPreferences", "FrameGeometry"}, "says nothing about the motion");
    model.skip({"MarkerSet", "ProbeSet"}, "only measures the motion");
    model.skip({"assembly_accuracy"}, "the poses are set, not assembled");
}

void readModel(Element& element) {
    ModelDescription& model = element.updReading().model;
    model.name = element.getName();
    model.gravity = element.getVec3Or("gravity", Vector3(0, -kDefaultGravity, 0));
    readUnits(element, "length_units", {"meters", "m", "Unassigned", ""});
    readUnits(element, "force_units", {"N", "newtons", "Newtons", "Unassigned", ""});
    BodyParts parts;
    readBodies(element, parts);
    collectJoints(element, parts);
    collectComponents(element, parts);
    collectOwnedFrames(element, parts);
    readJoints(parts);
    repairMasslessEnds(model);
    readActingParts(element, parts);
    skipWithoutEffect(element);
    element.refuseUnknown();
}

void readHostForces(Element& document, const std::vector<std::string>& bodies) {
    ModelDescription& model = document.updReading().model;
    model.name = document.getName();
    model.documentVersion = kLastVersion;
    for (const std::string& name : bodies) {
        model.bodies.emplace_back();
        model.bodies.back().name = name;
    }
    BodyParts parts;
    readPartsOfBodies(document, bodies, parts);
    collectComponents(document, parts);
    collectOwnedFrames(document, parts);
    readActingParts(document, parts);
    document.refuseUnknown();
    for (const BodyForce& force : model.bodyForces)
        throw ModelError(model.fileName, force.line,
                         "force '" + force.name + "' has no path: the host adds such forces itself");
}

/** What leaving an element out would change. */
std::string describeEffect(const UnknownElement& element) {
    if (!element.whyNeeded.empty()) return element.whyNeeded;
    switch (element.effect) {
        case Effect::Forces:
            return "forces would change without it";
        case Effect::Motion:
            return "poses, lengths and forces may change without it";
        case Effect::None:
            break;
    }
    return "nothing would change without it";
}

/** A line for each element. */
std::string listUnknown(const std::string& fileName, const std::vector<UnknownElement>& elements) {
    std::string list;
    for (const UnknownElement& element : elements) {
        const std::string name = element.name.empty() ? "" : " '" + element.name + "'";
        const std::string what = "unknown " + element.kind + " " + element.type + name + " in " + element.owner + ": " +
                                 describeEffect(element);
        list += (list.empty() ? "" : "\n") + std::string(ModelError(fileName, element.line, what).what());
    }
    return list;
}

}  // namespace

UnknownElementsError::UnknownElementsError(const std::string& fileName, std::vector<UnknownElement> elements,
                                           const std::string& andThen)
    : ModelError(listUnknown(fileName, elements) + (andThen.empty() ? "" : "\n" + andThen), elements.front().line),
      m_elements(std::move(elements)) {}

ModelDescription readOsimText(std::string_view text, const std::string& fileName, const ReadingOptions& options) {
    Document document(text, fileName, options);
    document.requireRoot("OpenSimDocument");
    Element& root = document.updRoot();
    document.updModel().documentVersion = readVersion(root, document.getVersion());
    Element element = root.require("Model");
    root.refuseUnknown();
    document.read([&] { readModel(element); });
    return std::move(document.updModel());
}

ModelDescription readForcesText(std::string_view text, const std::string& fileName,
                                const std::vector<std::string>& bodies, const ReadingOptions& options) {
    Document document(text, fileName, options);
    document.requireRoot("TautlineForces");
    document.read([&] { readHostForces(document.updRoot(), bodies); });
    return std::move(document.updModel());
}

ModelDescription readOsimFile(const std::filesystem::path& file, const ReadingOptions& options) {
    return readOsimText(readText(file), file.string(), options);
}

std::vector<OwnedPathFunctions> readFunctionBasedPaths(const std::filesystem::path& file,
                                                       const ModelDescription& model) {
    Document document(readText(file), file.string(), {}, model);
    Element set = document.updRoot().findAny({"Set_FunctionBasedPath_", "FunctionBasedPathSet"});
    if (!set) document.updRoot().fail("the document has no set of FunctionBasedPaths");
    std::vector<OwnedPathFunctions> paths;
    document.read([&] {
        for (const Element& member : set.getSetMembers()) {
            if (member.getTag() == "FunctionBasedPath")
                paths.push_back(
                    {member.getName(), *readPath(member, "'" + member.getName() + "'", FrameTable()).functions});
            else
                member.refuse("path", Effect::Motion);
        }
    });
    return paths;
}

}  // namespace tautline::models
