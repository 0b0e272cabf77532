// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>
#include <vector>

#include "tautline/models/model_check.h"
#include "tautline/models/osim_reader.h"

namespace tautline {

struct CheckedModel {
    models::ModelDescription description;
    std::vector<models::UnknownElement> unknown;  ///< that were left out to read it
    models::ModelCheck check;
};

/** Tables for people. */
void printCheck(const CheckedModel& model, std::ostream& out);

/** The same as one JSON object. */
void printCheckAsJson(const CheckedModel& model, std::ostream& out);

}  // namespace tautline
