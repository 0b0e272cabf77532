// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <vector>

#include "tautline/simbody/cable.h"
#include "weave.h"

namespace tautline::compare {

/** The bodies of the weave, one for each obstacle, each free to move; who adds a cable to them calls begin() then. */
struct WeaveBodies {
    explicit WeaveBodies(const WeaveRow& row);

    /** Realizes the model. */
    void begin();
    /** Moves the bodies to a pose of the row, and realizes positions. */
    void moveTo(int pose);

    /** Calls add(index of obstacle) and addPoint(point in ground) along the path. */
    template <class AddObstacle, class AddPoint>
    void forEachElement(AddObstacle addObstacle, AddPoint addPoint) const {
        for (int e = 1; e + 1 < row.problem.getNumElements(); ++e)
            if (row.isPointBetween(e))
                addPoint(row.poses.front().X_GE[static_cast<std::size_t>(e)].p);
            else
                addObstacle(row.getObstacle(e));
    }

    SimTK::Vec3 getEnd(bool isInsertion) const;
    SimTK::ContactGeometry makeGeometry() const;
    /** A point in S near which the path runs over an obstacle. */
    SimTK::Vec3 getHint(int obstacle) const { return {0, obstacle % 2 == 0 ? 0.4 : -0.4, 0}; }

    const WeaveRow& row;
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    std::vector<SimTK::MobilizedBody> bodies;
    SimTK::State state;

private:
    std::vector<SimTK::Vector> m_q;  ///< by pose
};

}  // namespace tautline::compare
