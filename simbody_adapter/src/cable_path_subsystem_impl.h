// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <atomic>
#include <deque>
#include <memory>

#include "cable_impl.h"
#include "cable_states.h"
#include "tautline/simbody/cable_path_subsystem.h"

namespace tautline {

class CableDecorations;

/** What stands behind a CablePathSubsystem handle. */
class CablePathSubsystemImpl : public SimTK::Subsystem::Guts {
public:
    CablePathSubsystemImpl();
    ~CablePathSubsystemImpl() override;

    const CableStates& getStates() const { return m_states; }
    void setDefaultContactMode(ContactMode mode);
    ContactMode getDefaultContactMode() const { return m_defaultContactMode; }
    void setShowDecorations(bool shows) { m_showsDecorations = shows; }
    bool getShowDecorations() const { return m_showsDecorations; }
    void acceptPaths(SimTK::State& state) const;
    void forgetPaths(SimTK::State& state) const;
    /** Makes the paths and motions of this State [Velocity] the start of later solves, but for the paths that do not
    hold there. */
    void acceptHoldingPaths(SimTK::State& state) const;
    void realizePaths(const SimTK::State& state) const;
    void realizeMotions(const SimTK::State& state) const;
    /** A number that no other solve has. */
    std::uint64_t makeSerial() const { return ++m_lastSerial; }

    /** For the handler that mends what other handlers leave behind: whether at the present time paths were invalidated
    after an integrator had realized them, and hold contacts that do not fit the pose. */
    bool needsSettling(const SimTK::State& state) const;
    void settle(SimTK::State& state) const;

    const SimTK::MultibodySystem& getMultibodySystem() const;
    const SimTK::SimbodyMatterSubsystem& getMatter() const;

    CableImpl& addCable(std::string name);
    int getNumCables() const { return static_cast<int>(m_impls.size()); }
    Cable& updCable(CableIndex cable);
    Cable& updCable(const std::string& name);

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
    CablePathSubsystemImpl* cloneImpl() const override;
    int realizeSubsystemTopologyImpl(SimTK::State& state) const override;
    int realizeSubsystemPositionImpl(const SimTK::State& state) const override;
    int realizeSubsystemVelocityImpl(const SimTK::State& state) const override;
    int calcDecorativeGeometryAndAppendImpl(const SimTK::State& state, SimTK::Stage stage,
                                            SimTK::Array_<SimTK::DecorativeGeometry>& geometry) const override;
    void handleEventsImpl(SimTK::State& state, SimTK::Event::Cause cause, const SimTK::Array_<SimTK::EventId>& events,
                          const SimTK::HandleEventsOptions& options,
                          SimTK::HandleEventsResults& results) const override;

private:
    template <class Predicate>
    void startFromPaths(SimTK::State& state, Predicate isTaken) const;

    const SimTK::SimbodyMatterSubsystem* m_matter = nullptr;  ///< from Topology on
    std::vector<std::unique_ptr<CableImpl>> m_impls;
    std::vector<std::unique_ptr<CableWorkspaces>> m_workspaces;  ///< of cables with the same options
    ContactMode m_defaultContactMode = ContactMode::Events;
    bool m_showsDecorations = true;
    mutable std::unique_ptr<CableDecorations> m_decorations;  ///< made when first drawn: it keeps meshes
    CableStates m_states;
    mutable std::atomic<std::uint64_t> m_lastSerial{0};
    std::deque<Cable> m_handles;  ///< for getCable(): references stay valid when cables are added
};

}  // namespace tautline
