// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>

#include "tautline/models/model_description.h"

namespace tautline {

/** A line: what the model has. */
void printModelSummary(const models::ModelDescription& description, std::ostream& out);

/** What was left out, by what that changes, and what was read otherwise than it is written. */
void printReadingNotes(const models::ModelDescription& description, std::ostream& out);

/** How the muscles of each type are computed, and notes, each with the muscles that it is of. */
void printMuscleTypes(const models::ModelDescription& description, std::ostream& out);

}  // namespace tautline
