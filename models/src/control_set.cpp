// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/control_set.h"

#include <algorithm>

namespace tautline::models {

double Control::calcValue(double time) const {
    const auto after = std::lower_bound(nodes.begin(), nodes.end(), time,
                                        [](const std::array<double, 2>& node, double t) { return node[0] < t; });
    const bool isBefore = after == nodes.begin(), isAfter = after == nodes.end();
    if (hasSteps || nodes.size() == 1 || (!extrapolates && (isBefore || isAfter)))
        return isAfter ? nodes.back()[1] : (*after)[1];
    const auto last = isBefore ? after + 1 : isAfter ? after - 1 : after;
    const std::array<double, 2>&a = *(last - 1), &b = *last;
    return a[1] + (time - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

}  // namespace tautline::models
