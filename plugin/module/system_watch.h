// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>

namespace tautline::plugin {

/** What becomes of a system and of the handle of an attachment to it, whichever ends first, and the hold on this module
that the system's forces need: their code is here. */
class SystemWatch {
public:
    /** Adds a subsystem to the system that does nothing but end with it, and takes the hold. */
    static std::shared_ptr<SystemWatch> watch(SimTK::MultibodySystem& system);

    bool isSystemGone() const;
    /** Called when the handle is released. Gives up the hold if the system is gone; else the first call of
    dropOldHolds() after its end does. */
    void endHandle();
    /** Called by the subsystem. The code that calls it is here, so the hold must wait. */
    void endSystem();

    /** Gives up the holds for systems that are gone and whose handles are released. To be called from functions that
    the host calls, for it then holds the module itself. */
    static void dropOldHolds();

private:
    SystemWatch() = default;
    void queueHold();

    bool m_isSystemGone = false, m_isHandleGone = false;
    void* m_hold = nullptr;
};

}  // namespace tautline::plugin
