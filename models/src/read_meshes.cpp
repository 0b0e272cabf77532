// SPDX-License-Identifier: Apache-2.0
#include "read_meshes.h"

namespace tautline::models {
namespace {

/** How a mesh lies in the frame that has it: turned and moved, then scaled in its own frame. */
struct Placing {
    Pose X_FM;
    Vector3 scale = Vector3::Ones();
};

void addMesh(const Element& element, const std::string& file, const BodyFrame& frame, const Placing& placing) {
    if (file.empty()) return;
    element.updReading().model.meshes.push_back(
        {file, frame.body, frame.X_BF * placing.X_FM, placing.scale, element.findLine()});
}

/** <scale_factors>, and <transform> of documents before 30500: three body-fixed angles, then a shift. */
Placing readPlacing(Element& element) {
    Placing placing;
    placing.scale = element.getVec3Or("scale_factors", Vector3::Ones());
    if (const Element transform = element.find("transform")) {
        const std::vector<double> numbers = transform.getNumbers(6);
        placing.X_FM = makePose({numbers[3], numbers[4], numbers[5]}, {numbers[0], numbers[1], numbers[2]});
    }
    return placing;
}

/** In another frame than its owner's if its socket says so. */
void readMesh(Element element, const FrameElement& owner, const BodyParts& parts) {
    if (element.getTag() != "Mesh") return;  // balls and bricks
    if (Element appearance = element.find("Appearance"))
        if (!appearance.getBoolOr("visible", true)) return;
    BodyFrame frame = parts.frames.resolvePath(owner.path);
    const Element socket = element.findSocket("frame");
    if (socket && socket.getText() != ".." && !socket.getText().empty())
        frame = parts.frames.resolve(socket, owner.path + "/" + element.getName());
    addMesh(element, element.require("mesh_file").getText(), frame,
            {{}, element.getVec3Or("scale_factors", Vector3::Ones())});
}

/** Of a set, in its <objects> or not; whatever else is in it is only drawn, too. None of a set that is not there. */
std::vector<Element> getMembers(Element set) {
    const Element objects = set.find("objects");
    return (objects ? objects : set).getChildren();
}

/** As OpenSim reads <VisibleObject> of documents before 30500: what it says of all its parts comes on top of what each
says of itself. */
void readVisibleObject(Element visible, const BodyFrame& frame) {
    const Placing all = readPlacing(visible);
    if (const Element files = visible.find("geometry_files"))  // before 20101
        for (const std::string& file : files.getWords()) addMesh(files, file, frame, all);
    for (Element& part : getMembers(visible.find("GeometrySet"))) {
        if (part.getTag() != "DisplayGeometry") continue;
        const Placing own = readPlacing(part);
        const Element file = part.find("geometry_file");
        if (file) addMesh(part, file.getText(), frame, {all.X_FM * own.X_FM, all.scale.cwiseProduct(own.scale)});
    }
}

void readMeshesOf(const FrameElement& owner, const BodyParts& parts) {
    Element element = owner.element;
    for (const char* tag : {"attached_geometry", "geometry", "GeometrySet"})
        for (const Element& mesh : getMembers(element.find(tag))) readMesh(mesh, owner, parts);
    if (const Element visible = element.find("VisibleObject"))
        readVisibleObject(visible, parts.frames.resolvePath(owner.path));
}

}  // namespace

void readMeshes(const BodyParts& parts) {
    for (const FrameElement& owner : parts.wrapOwners) {
        try {
            readMeshesOf(owner, parts);
        } catch (const ModelError& error) {
            owner.element.note("meshes of " + owner.element.describe() + " are not drawn: " + error.what());
        }
    }
}

}  // namespace tautline::models
