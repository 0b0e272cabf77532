// SPDX-License-Identifier: Apache-2.0
#include "system_watch.h"

#include <dlfcn.h>

#include <mutex>
#include <vector>

namespace tautline::plugin {
namespace {

/** Over all watches. */
struct Holds {
    std::mutex mutex;
    std::vector<void*> old;
};

Holds& getHolds() {
    static Holds holds;
    return holds;
}

/** Another reference to this module, so that it stays when the host unloads it. */
void* holdModule() {
    Dl_info here;
    if (dladdr(reinterpret_cast<const void*>(&holdModule), &here) == 0) return nullptr;
    return dlopen(here.dli_fname, RTLD_NOW | RTLD_NOLOAD);
}

/** Lies in the watched system and ends with it. */
class WatchGuts : public SimTK::Subsystem::Guts {
public:
    explicit WatchGuts(std::shared_ptr<SystemWatch> watch) : Guts("tautline_watch", "1"), m_watch(std::move(watch)) {}
    ~WatchGuts() override {
        if (m_watch) m_watch->endSystem();
    }
    WatchGuts* cloneImpl() const override { return new WatchGuts(nullptr); }

private:
    std::shared_ptr<SystemWatch> m_watch;
};

class WatchSubsystem : public SimTK::Subsystem {
public:
    WatchSubsystem(SimTK::MultibodySystem& system, std::shared_ptr<SystemWatch> watch) {
        adoptSubsystemGuts(new WatchGuts(std::move(watch)));
        system.adoptSubsystem(*this);
    }
};

}  // namespace

std::shared_ptr<SystemWatch> SystemWatch::watch(SimTK::MultibodySystem& system) {
    std::shared_ptr<SystemWatch> watch(new SystemWatch);
    WatchSubsystem subsystem(system, watch);
    watch->m_hold = holdModule();
    return watch;
}

bool SystemWatch::isSystemGone() const {
    const std::lock_guard<std::mutex> lock(getHolds().mutex);
    return m_isSystemGone;
}

void SystemWatch::endHandle() {
    {
        const std::lock_guard<std::mutex> lock(getHolds().mutex);
        m_isHandleGone = true;
        if (m_isSystemGone) queueHold();
    }
    dropOldHolds();
}

void SystemWatch::endSystem() {
    const std::lock_guard<std::mutex> lock(getHolds().mutex);
    m_isSystemGone = true;
    if (m_isHandleGone) queueHold();
}

void SystemWatch::queueHold() {
    if (m_hold) getHolds().old.push_back(m_hold);
    m_hold = nullptr;
}

void SystemWatch::dropOldHolds() {
    std::vector<void*> old;
    {
        const std::lock_guard<std::mutex> lock(getHolds().mutex);
        old.swap(getHolds().old);
    }
    for (void* hold : old) dlclose(hold);
}

}  // namespace tautline::plugin
