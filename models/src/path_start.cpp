// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/path_start.h"

namespace tautline::models {
namespace {

GeodesicStart makeStart(const Surface& surface, const WrapStart& given) {
    GeodesicStart start;
    start.point = surface.findSurfacePoint(given.point);
    start.tangent = surface.calcFrame(start.point, given.direction).t;
    start.length = given.length;
    return start;
}

}  // namespace

PathStart makePathStart(const std::vector<BoundWrap>& wraps, const Cable& cable) {
    PathStart start;
    std::size_t next = 0;
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e) {
        if (!cable.isObstacle(e)) continue;
        const std::optional<WrapStart>& given = wraps[next++].start;
        if (!given) continue;
        start.resize(static_cast<std::size_t>(cable.getNumElements()));
        start[static_cast<std::size_t>(e)] = makeStart(*cable.getSurface(e), *given);
    }
    return start;
}

}  // namespace tautline::models
