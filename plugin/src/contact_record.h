// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Where the paths of a model touch their obstacles when a run ends, so that another one can go on with them: sides and
windings are not to be seen from the pose alone. */
#include <filesystem>
#include <string>
#include <vector>

#include "tautline/models/model_system.h"

namespace tautline {

/** An arc on an obstacle, in the obstacle's frame. */
struct RecordedContact {
    std::string path, obstacle;  ///< "/forceset/<name>", name of the element
    Vector3 point, direction;    ///< where the arc begins [m], and a unit vector along it
    double length = 0;           ///< [m]
};

/** contacts.csv: path,obstacle,x,y,z,dx,dy,dz,length. Stage: Position. */
std::string makeContactText(const models::ModelSystem& model, const SimTK::State& state);

/** @throws std::runtime_error naming file and line of what is no contact */
std::vector<RecordedContact> readContacts(const std::filesystem::path& file);

/** Has all paths that have a shortest one with these contacts begin with it. Stage: Position; the others, and what was
lifted, are found anew.
@throws std::runtime_error naming a path or obstacle that the model does not have */
void continueContacts(const std::vector<RecordedContact>& contacts, const models::ModelSystem& model,
                      SimTK::State& state);

}  // namespace tautline
