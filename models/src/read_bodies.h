// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** An element that may own wrap objects, and the path of the frame that it is. */
struct FrameElement {
    Element element;
    std::string path;
};

/** A joint, and in old documents the body that it stands in. */
struct JointElement {
    Element element;
    std::string childBody;
};

/** What the bodies hold that can be read only once all bodies and frames are known. */
struct BodyParts {
    FrameTable frames;
    std::vector<FrameElement> wrapOwners;
    std::vector<JointElement> joints;
};

/** Reads Ground and BodySet of a Model element. */
void readBodies(Element& model, BodyParts& parts);

/** Reads what Ground and BodySet add to bodies that are there already: wrap objects and frames.
@param names   of the bodies but the ground */
void readPartsOfBodies(Element& document, const std::vector<std::string>& names, BodyParts& parts);

/** Enters a component of a body, a joint or the model: a frame, which may own wrap objects, or a station. */
void addComponent(const Element& component, const std::string& ownerPath, BodyParts& parts);

/** Gives a body at the end of the tree that moves and has no mass so little of it that it can be simulated, with a
note. */
void repairMasslessEnds(ModelDescription& model);

}  // namespace tautline::models
