// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "document.h"
#include "frame_table.h"
#include "read_forces.h"
#include "read_text.h"
#include "tautline/models/external_loads.h"

namespace tautline::models {
namespace {

/** The text of a child, empty if it is missing or stands for nothing. */
std::string findText(Element& element, const std::string& tag) {
    const Element child = element.find(tag);
    const std::string text = child ? child.getText() : "";
    return text == "Unassigned" ? "" : text;
}

/** The name of a body or the ground; the ground if the file names none. */
std::string readFrame(Element& element, const std::string& tag, const FrameTable& frames) {
    return findText(element, tag).empty() ? kGroundName : frames.resolveBody(element.find(tag));
}

ExternalForce readExternalForce(Element element, const FrameTable& frames) {
    ExternalForce force;
    force.name = element.getName();
    force.line = element.findLine();
    force.appliesForce = readAppliesForce(element);
    force.body = frames.resolveBody(element.require("applied_to_body"));
    force.forceFrame = readFrame(element, "force_expressed_in_body", frames);
    force.pointFrame = readFrame(element, "point_expressed_in_body", frames);
    force.forceIdentifier = findText(element, "force_identifier");
    force.pointIdentifier = findText(element, "point_identifier");
    force.torqueIdentifier = findText(element, "torque_identifier");
    if (force.forceIdentifier.empty() && force.torqueIdentifier.empty())
        element.fail(element.describe() + " has neither a force_identifier nor a torque_identifier");
    element.acceptTag("data_source_name");
    element.refuseUnknown();
    return force;
}

}  // namespace

ExternalLoads readExternalLoads(const std::filesystem::path& file, const ModelDescription& model) {
    Document document(readText(file), file.string(), {}, model);
    FrameTable frames;
    frames.addBody(kGroundName);
    for (const Body& body : model.bodies) frames.addBody(body.name);
    Element set = document.updRoot().require("ExternalLoads");
    ExternalLoads loads;
    loads.fileName = file.string();
    loads.dataFile = findText(set, "datafile");
    set.skip({"external_loads_model_kinematics_file", "lowpass_cutoff_frequency_for_load_kinematics"},
             "of tools that move points between bodies");
    document.read([&] {
        for (const Element& member : set.getSetMembers()) {
            if (member.getTag() == "ExternalForce")
                loads.forces.push_back(readExternalForce(member, frames));
            else
                member.refuse("external load", Effect::Forces);
        }
    });
    return loads;
}

}  // namespace tautline::models
