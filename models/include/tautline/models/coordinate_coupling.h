// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <string>
#include <vector>

#include "tautline/models/model_builder.h"

namespace tautline::models {

/** How all coordinates of a model move when one of them does, in one pose, and so its moment arms.

Geometric: -dl/dq, all other coordinates held where they are, whatever constraints say. Effective: -dl/dq along the
motions that the model's constraints allow, as Sherman, Seth and Delp (2013), Sec. 4, and OpenSim define it. The speeds
of the others are then those of the allowed motion nearest to that of the one alone (least sum of squares): couplers,
loops of bodies and locks are followed, and whatever is held neither by one nor by the other stays. A locked or driven
coordinate is let go for its own arm. */
class CoordinateCoupling {
public:
    CoordinateCoupling() = default;
    /** In no pose yet: update() it before anything is asked. The model must outlive it. */
    explicit CoordinateCoupling(const BuiltModel& model);
    /** In the pose of a State. Stage: Position, of the matter subsystem. */
    CoordinateCoupling(const BuiltModel& model, const SimTK::State& state) : CoordinateCoupling(model) {
        update(state);
    }
    /** Goes over to another pose. Stage: as above. */
    void update(const SimTK::State& state);

    /** In the order of BuiltModel::getCoordinateNames(), as for all that follows. */
    int getNumCoordinates() const { return static_cast<int>(m_mobilities.size()); }

    /** @param unitForces   -d(length rate)/du, one per mobility: Cable::calcUnitMobilityForces()
    @return [m/rad or 1] */
    double calcGeometricArm(const SimTK::Vector& unitForces, int coordinate) const {
        return unitForces[m_mobilities[static_cast<std::size_t>(coordinate)]];
    }
    /** As above; NaN if constraints hold the coordinate in this pose. */
    double calcEffectiveArm(const SimTK::Vector& unitForces, int coordinate) const;

    std::vector<double> calcGeometricArms(const SimTK::Vector& unitForces) const;
    std::vector<double> calcEffectiveArms(const SimTK::Vector& unitForces) const;

private:
    struct Share {
        int mobility;
        double speed;  ///< per speed of the coordinate
    };

    const BuiltModel* m_model = nullptr;
    std::vector<const BuiltModel::CoordinateSlot*> m_slots;  ///< by coordinate
    bool m_hasLoops = false;  ///< constraints that are neither couplers, locks nor drives
    std::vector<int> m_mobilities;
    std::vector<std::vector<Share>> m_motions;  ///< by coordinate; empty: held
};

}  // namespace tautline::models
