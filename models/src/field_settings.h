// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tautline/models/model_description.h"
#include "xml_source.h"

namespace tautline::models {

/** Changes fields of a parsed document before it is read, so that a value is judged like one of the file.
@param settings   each ELEMENT/FIELD=VALUE: the child <FIELD> of the element of that name has the text VALUE, or with
*FACTOR the numbers it has times FACTOR; further names before ELEMENT are those of elements around it
@param notes   of each setting a line with the text that the file has
@throws ModelError naming a setting that is malformed, or that meets no field or more than one */
void applySettings(const std::vector<std::string>& settings, XmlSource& source, std::vector<ReadingNote>& notes);

}  // namespace tautline::models
