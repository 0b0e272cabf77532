// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <deque>
#include <memory>

#include "cable_impl.h"
#include "tautline/simbody/cable_subsystem.h"

namespace tautline {

/** What stands behind a CableSubsystem handle. */
class CableSubsystemImpl : public SimTK::Subsystem::Guts {
public:
    CableSubsystemImpl() : Guts("CableSubsystem", "0.1.0") {}

    const SimTK::MultibodySystem& getMultibodySystem() const;
    const SimTK::SimbodyMatterSubsystem& getMatter() const;

    CableImpl& addCable(std::string name);
    int getNumCables() const { return static_cast<int>(m_impls.size()); }
    Cable& updCable(CableIndex cable);

    void countStep(const SimTK::State& state) const;

    /** Makes sure that the cables are realized to a stage, Position or Velocity. While the System works on
    that stage other subsystems may ask for cables before their turn: as soon as the bodies are
    realized, the cables can be. @throws the stage error of `method` if they are not */
    void ensureStage(const SimTK::State& state, SimTK::Stage stage, const char* method) const;

    /** For constraints, which are asked for position errors while the matter subsystem is still at work on that stage
    but has placed its bodies. */
    void realizePositionOfPlacedBodies(const SimTK::State& state) const {
        if (getStage(state) < SimTK::Stage::Position) realizeSubsystemPosition(state);
    }

protected:
    CableSubsystemImpl* cloneImpl() const override;
    int realizeSubsystemTopologyImpl(SimTK::State& state) const override;
    int realizeSubsystemPositionImpl(const SimTK::State& state) const override;
    int realizeSubsystemVelocityImpl(const SimTK::State& state) const override;
    void handleEventsImpl(SimTK::State& state, SimTK::Event::Cause cause, const SimTK::Array_<SimTK::EventId>& events,
                          const SimTK::HandleEventsOptions& options,
                          SimTK::HandleEventsResults& results) const override;

private:
    std::vector<std::unique_ptr<CableImpl>> m_impls;
    std::deque<Cable> m_handles;  ///< for getCable(): references stay valid when cables are added
};

}  // namespace tautline
