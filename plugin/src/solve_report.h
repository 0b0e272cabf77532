// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>
#include <vector>

#include "tautline/models/path_study.h"

namespace tautline {

/** A table of the paths: of one pose what they are, of several what they do over all of them. Then a line for each
path that is somewhere no verified shortest one, switched off an object, or runs elsewhere than asked. */
void printStudy(const models::PathStudy& study, const std::vector<double>& times,
                const std::vector<models::PoseAnswer>& answers, std::ostream& out);

}  // namespace tautline
