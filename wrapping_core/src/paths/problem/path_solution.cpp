// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_solution.h"

namespace tautline {

const char* getName(PathStatus status) {
    switch (status) {
        case PathStatus::Solved:
            return "solved";
        case PathStatus::NotMinimum:
            return "not_minimum";
        case PathStatus::LeftDomain:
            return "left_domain";
        case PathStatus::EndInside:
            return "end_inside";
        case PathStatus::NotConverged:
            return "not_converged";
    }
    return "unknown";
}

const char* getName(StartStrategy strategy) {
    switch (strategy) {
        case StartStrategy::None:
            return "none";
        case StartStrategy::Continued:
            return "continued";
        case StartStrategy::AlongPrevious:
            return "along_previous";
        case StartStrategy::Inserted:
            return "inserted";
        case StartStrategy::Band:
            return "band";
        case StartStrategy::Released:
            return "released";
    }
    return "unknown";
}

}  // namespace tautline
