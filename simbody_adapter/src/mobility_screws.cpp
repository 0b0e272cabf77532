// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/mobility_screws.h"

#include <algorithm>

namespace tautline {

using SimTK::MobilizedBodyIndex;
using SimTK::SpatialVec;

void MobilityScrews::update(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state) {
    m_mobilizers.resize(static_cast<std::size_t>(matter.getNumBodies()));
    m_screws.resize(static_cast<std::size_t>(state.getNU()));
    for (MobilizedBodyIndex b(1); b < matter.getNumBodies(); ++b) {
        const SimTK::MobilizedBody& body = matter.getMobilizedBody(b);
        Mobilizer& mobilizer = m_mobilizers[b];
        mobilizer.parent = body.getParentMobilizedBody().getMobilizedBodyIndex();
        mobilizer.firstMobility = body.getFirstUIndex(state);
        mobilizer.numMobilities = body.getNumU(state);
        const SimTK::Vec3& origin_G = body.getBodyOriginLocation(state);
        for (SimTK::MobilizerUIndex u(0); u < mobilizer.numMobilities; ++u) {
            const SpatialVec column = body.getHCol(state, u);
            m_screws[mobilizer.firstMobility + u] = {column[0], column[1] - column[0] % origin_G};
        }
    }
}

/** The force on the outermost body acts on its mobilities, and from there on on its parent; bodies stand behind their
parents in Simbody's order. Once one body bears all that is left, that is nothing. */
void MobilityScrews::addBalancedForces(std::vector<BodyForceAtGround>& forces, SimTK::Vector& mobilityForces) const {
    const auto isInboard = [](const BodyForceAtGround& a, const BodyForceAtGround& b) { return a.body < b.body; };
    while (forces.size() > 1) {
        const auto outermost = std::max_element(forces.begin(), forces.end(), isInboard);
        const BodyForceAtGround moved = *outermost;
        *outermost = forces.back();
        forces.pop_back();
        const auto same =
            std::find_if(forces.begin(), forces.end(), [&](const auto& other) { return other.body == moved.body; });
        if (same != forces.end()) {
            same->force += moved.force;
            continue;
        }
        const Mobilizer& mobilizer = m_mobilizers[moved.body];
        for (int u = mobilizer.firstMobility; u < mobilizer.firstMobility + mobilizer.numMobilities; ++u)
            mobilityForces[u] += ~m_screws[u] * moved.force;
        forces.push_back({mobilizer.parent, moved.force});
    }
}

}  // namespace tautline
