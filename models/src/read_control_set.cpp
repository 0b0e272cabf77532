// SPDX-License-Identifier: Apache-2.0
#include "document.h"
#include "read_text.h"
#include "tautline/models/control_set.h"

namespace tautline::models {
namespace {

const char* const kOfTools = "of the tools that compute controls";

/** What the controls of a file are where they do not say otherwise. */
struct Defaults {
    bool hasSteps = false, extrapolates = true;
};

Defaults readDefaults(Element& set) {
    Defaults found;
    Element defaults = set.find("defaults");
    Element control = defaults ? defaults.find("ControlLinear") : defaults;
    if (!control) return found;
    found.hasSteps = control.getBoolOr("use_steps", found.hasSteps);
    found.extrapolates = control.getBoolOr("extrapolate", found.extrapolates);
    return found;
}

Control readControl(Element& element, const Defaults& defaults) {
    Control control;
    control.name = element.getRequiredName();
    control.line = element.findLine();
    element.skip({"is_model_control", "default_min", "default_max", "filter_on"}, kOfTools);
    control.extrapolates = element.getBoolOr("extrapolate", defaults.extrapolates);
    return control;
}

Control readConstant(Element element) {
    Control control = readControl(element, {});
    control.nodes.push_back({0.0, element.requireNumber("value")});
    element.refuseUnknown();
    return control;
}

std::array<double, 2> readNode(Element element) {
    const std::array<double, 2> node = {element.requireNumber("t"), element.requireNumber("value")};
    element.refuseUnknown();
    return node;
}

Control readLinear(Element element, const Defaults& defaults) {
    Control control = readControl(element, defaults);
    control.hasSteps = element.getBoolOr("use_steps", defaults.hasSteps);
    element.skip({"min_nodes", "max_nodes", "kp", "kv"}, kOfTools);
    Element list = element.findAny({"x_nodes", "nodes"});
    for (const Element& child : list ? list.getChildren() : std::vector<Element>()) {
        if (child.getTag() != "ControlLinearNode") {
            child.refuse("node", Effect::Forces);
            continue;
        }
        const std::array<double, 2> node = readNode(child);
        if (!control.nodes.empty() && !(node[0] > control.nodes.back()[0]))
            child.fail("the nodes of " + element.describe() + " do not increase in time: " + std::to_string(node[0]) +
                       " s comes after " + std::to_string(control.nodes.back()[0]) + " s");
        control.nodes.push_back(node);
    }
    if (control.nodes.empty()) element.fail(element.describe() + " has no nodes");
    element.refuseUnknown();
    return control;
}

}  // namespace

std::vector<Control> readControlSet(const std::filesystem::path& file) {
    Document document(readText(file), file.string(), {});
    std::vector<Control> controls;
    document.read([&] {
        // Older files are the set itself.
        Element& root = document.updRoot();
        Element set = root.getTag() == "ControlSet" ? root : root.require("ControlSet");
        const Defaults defaults = readDefaults(set);
        for (const Element& member : set.getSetMembers()) {
            if (member.getTag() == "ControlLinear")
                controls.push_back(readLinear(member, defaults));
            else if (member.getTag() == "ControlConstant")
                controls.push_back(readConstant(member));
            else
                member.refuse("control", Effect::Forces);
        }
    });
    return controls;
}

}  // namespace tautline::models
