// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/osim_reader.h"

#include <fstream>
#include <sstream>

#include "read_bodies.h"
#include "read_constraints.h"
#include "read_forces.h"
#include "read_joints.h"
#include "read_wrap_objects.h"

namespace tautline::models {
namespace {

/** The last version with joints inside bodies, and those of the present layout that are known. */
constexpr int kLastOldVersion = 30500;
constexpr int kFirstNewVersion = 40000;
constexpr int kLastNewVersion = 40600;

/** Along -y, of a model that says nothing about it [m/s^2]. */
constexpr double kDefaultGravity = 9.80665;

int readVersion(const Element& document, const std::string& attribute) {
    int version = 0;
    std::istringstream text(attribute);
    if (!(text >> version) || !text.eof()) document.fail("the document version '" + attribute + "' is not a number");
    if (version > kLastNewVersion) {
        document.fail("document version " + attribute + " is newer than " + std::to_string(kLastNewVersion) +
                      ", the newest that is known");
    }
    if (version > kLastOldVersion && version < kFirstNewVersion)
        document.fail("document version " + attribute + " is an interim layout that is not read");
    return version;
}

void checkUnits(Element& model, const std::string& tag, const std::vector<std::string>& accepted) {
    const Element units = model.find(tag);
    if (!units) return;
    for (const std::string& name : accepted)
        if (units.getText() == name) return;
    units.fail(tag + " are '" + units.getText() + "' instead of '" + accepted[0] + "'");
}

/** Sets whose members would act on the motion, and of which none is known. */
void refuseMembers(Element& model, const std::string& setTag, const std::string& what) {
    Element set = model.find(setTag);
    if (!set) return;
    for (const Element& member : set.getSetMembers()) member.fail("unknown " + what + " " + member.describe());
    set.skipThis("Model", "empty");
}

void collectComponents(Element& model, BodyParts& parts) {
    for (const char* tag : {"ComponentSet", "components"}) {
        Element set = model.find(tag);
        if (!set) continue;
        const bool isSet = std::string(tag) == "ComponentSet";
        for (const Element& member : isSet ? set.getSetMembers() : set.getChildren()) {
            if (member.getTag() != "PhysicalOffsetFrame") member.fail("unknown component " + member.describe());
            addOffsetFrame(member, isSet ? "/componentset" : "", parts);
        }
    }
}

void skipWithoutEffect(Element& model) {
    model.skip({"defaults"}, "defaults are no part of the model");
    model.skip({"credits", "publications", "ModelVisualPreferences", "FrameGeometry"}, "says nothing about the motion");
    model.skip({"MarkerSet", "ProbeSet"}, "only measures the motion");
    model.skip({"ContactGeometrySet"}, "acts only through contact forces, which are refused");
    model.skip({"assembly_accuracy"}, "the poses are set, not assembled");
}

void readModel(Element& element) {
    ModelDescription& model = element.updReading().model;
    model.name = element.getName();
    model.gravity = element.getVec3Or("gravity", Vec3(0, -kDefaultGravity, 0));
    checkUnits(element, "length_units", {"meters", "m"});
    checkUnits(element, "force_units", {"N", "newtons", "Newtons"});
    BodyParts parts;
    readBodies(element, parts);
    collectJoints(element, parts);
    collectComponents(element, parts);
    readJoints(parts);
    readWrapObjects(parts);
    readConstraints(element, parts.frames);
    readForces(element, parts.frames);
    refuseMembers(element, "ControllerSet", "controller");
    skipWithoutEffect(element);
    element.refuseUnknown();
}

}  // namespace

ModelDescription readOsimText(std::string_view text, const std::string& fileName) {
    const XmlSource source(text, fileName);
    ModelDescription model;
    model.fileName = fileName;
    Reading reading{source, model};
    Element document(reading, source.getRoot());
    if (document.getTag() != "OpenSimDocument")
        document.fail("the document is a " + document.getTag() + ", not an OpenSimDocument");
    model.documentVersion = readVersion(document, source.getRoot().attribute("Version").value());
    Element element = document.require("Model");
    document.refuseUnknown();
    readModel(element);
    return model;
}

ModelDescription readOsimFile(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || std::filesystem::is_directory(file)) throw ModelError(file.string() + ": the file cannot be read");
    return readOsimText(text.str(), file.string());
}

}  // namespace tautline::models
