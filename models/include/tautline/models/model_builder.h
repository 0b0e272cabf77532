// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <map>
#include <string>
#include <vector>

#include "tautline/models/model_description.h"
#include "tautline/models/model_error.h"

namespace tautline::models {

/** Where the bodies and coordinates of a model stand in a SimbodyMatterSubsystem. A light handle to copy; the matter
subsystem must outlive it. Unknown names throw ModelError. */
class BuiltModel {
public:
    struct CoordinateSlot {
        /** "/jointset/<joint>/<coordinate>": how files of states name it. */
        std::string path;
        SimTK::MobilizedBodyIndex body;
        SimTK::MobilizerQIndex q;
        SimTK::MobilizerUIndex u;
        double defaultValue = 0.0;
        double defaultSpeed = 0.0;
        std::array<double, 2> range{};
        bool clamped = false;
        bool locked = false;
        /** Of the constraint that holds a locked coordinate. */
        SimTK::ConstraintIndex lock;
        /** Of the constraint that drives it where its joint is not driven as a whole. */
        SimTK::ConstraintIndex drive;
        /** Motion as a function of time, enforced; none if locked or free. */
        std::optional<ScalarFunction> prescribedMotion;
    };

    const SimTK::SimbodyMatterSubsystem& getMatter() const { return *m_matter; }
    /** `ground` is the ground. */
    SimTK::MobilizedBodyIndex getBodyIndex(const std::string& name) const;
    const SimTK::MobilizedBody& getBody(const std::string& name) const;
    const CoordinateSlot& getCoordinateSlot(const std::string& name) const;
    /** In the order of the file. */
    const std::vector<std::string>& getCoordinateNames() const { return m_coordinateNames; }
    const std::vector<CoordinateCoupler>& getCouplers() const { return m_couplers; }
    /** Bodies of no name that carry the coordinates which their joints do not use. */
    const std::vector<SimTK::MobilizedBodyIndex>& getIdleBodies() const { return m_idleBodies; }

    /** Sets all coordinates and speeds to their defaults, driven ones to their motion at the state's time, then lets
    the couplers have their way. */
    void setDefaultPose(SimTK::State& state) const;
    /** The same with speeds of 0, but those of driven coordinates. */
    void setRestingPose(SimTK::State& state) const;
    /** Does not clip to the range, clamped or not. A locked coordinate stays locked at the value; a driven one goes
    where its motion says as soon as the state is simulated. */
    void setCoordinate(SimTK::State& state, const std::string& name, double value) const;
    double getCoordinate(const SimTK::State& state, const std::string& name) const;
    void setCoordinateSpeed(SimTK::State& state, const std::string& name, double speed) const;
    double getCoordinateSpeed(const SimTK::State& state, const std::string& name) const;
    /** The partial derivative of a coupler's dependent coordinate by its argument i. */
    double calcCouplingSlope(const SimTK::State& state, const CoordinateCoupler& coupler, int i) const;
    /** A coordinate without which its joint has fewer directions to move in, in this pose: in gimbal lock, or where
    two of its motions are alike. Null if there is none. The equations of motion are singular there. Needs
    Stage::Position. */
    const std::string* findSingularCoordinate(const SimTK::State& state) const;
    /** Gives every coupled coordinate the value and speed that its coupler asks for. */
    void applyCouplers(SimTK::State& state) const;

    /** The ground coordinates of a point fixed in a body. Needs Stage::Position. */
    SimTK::Vec3 calcStationLocation(const SimTK::State& state, const std::string& body,
                                    const SimTK::Vec3& station_B) const;

    /** Of bodies that somebody else has built, by name, and the ground; it has no coordinates.
    @throws ModelError for an index that no body has */
    static BuiltModel ofBodies(SimTK::SimbodyMatterSubsystem& matter,
                               const std::map<std::string, SimTK::MobilizedBodyIndex>& bodies);

private:
    friend class MultibodyAssembly;

    void setPose(SimTK::State& state, bool isAtRest) const;
    void setCoordinate(SimTK::State& state, const CoordinateSlot& slot, double value) const;

    SimTK::SimbodyMatterSubsystem* m_matter = nullptr;
    std::map<std::string, SimTK::MobilizedBodyIndex> m_bodies;
    std::map<std::string, CoordinateSlot> m_coordinates;
    std::vector<std::string> m_coordinateNames;
    std::vector<CoordinateCoupler> m_couplers;
    std::vector<SimTK::MobilizedBodyIndex> m_idleBodies;
};

/** Adds the bodies, joints, locks, prescribed motions and constraints of a model to a matter subsystem. Every
coordinate becomes a q whose u is its derivative; one that its joint does not use moves nothing. A joint all of whose
coordinates are prescribed is driven exactly, by a Motion; other prescribed coordinates by constraints. Forces are not
added. The defaults of the model are not those of the system: call BuiltModel::setDefaultPose().

@throws ModelError, before anything is added, if bodies are not joined to the ground in a tree, if two turning or two
shifting axes of a joint are parallel, or if a joint moves no mass. */
BuiltModel buildMultibody(const ModelDescription& model, SimTK::SimbodyMatterSubsystem& matter);

/** Adds the model's gravity. */
SimTK::Force::Gravity addGravity(const ModelDescription& model, SimTK::GeneralForceSubsystem& forces,
                                 const BuiltModel& built);

}  // namespace tautline::models
