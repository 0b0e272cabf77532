// SPDX-License-Identifier: Apache-2.0
// reload_program MODULE TIMES: loads libtautline_plugin.so, attaches a string to a system, uses it, and unloads it, and
// fails unless the module is then gone from memory. The host ends things in different orders.
#include <Simbody.h>
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "tautline/plugin.h"

namespace {

const char* const kDescription =
    "<TautlineForces><ForceSet><objects><PathSpring name='s'><GeometryPath><PathPointSet><objects>"
    "<PathPoint name='a'><socket_parent_frame>0</socket_parent_frame><location>0.1 0.3 0</location></PathPoint>"
    "<PathPoint name='b'><socket_parent_frame>1</socket_parent_frame><location>0 0 0</location></PathPoint>"
    "</objects></PathPointSet></GeometryPath><resting_length>0.2</resting_length><stiffness>100</stiffness>"
    "<dissipation>0.1</dissipation></PathSpring></objects></ForceSet></TautlineForces>";

struct Host {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    SimTK::MobilizedBody::Pin bob{matter.Ground(), SimTK::Vec3(0),
                                  SimTK::Body::Rigid(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::UnitInertia(1))),
                                  SimTK::Vec3(0, 0.5, 0)};
};

void require(bool condition, const char* what) {
    if (condition) return;
    std::printf("failed: %s\n", what);
    std::exit(1);
}

bool isLoaded(const char* module) {
    void* loaded = dlopen(module, RTLD_NOW | RTLD_NOLOAD);
    if (loaded) dlclose(loaded);
    return loaded != nullptr;
}

const tautline_plugin* open(void* module) {
    const auto function = reinterpret_cast<tautline_plugin_open_function>(dlsym(module, TAUTLINE_PLUGIN_OPEN));
    const tautline_host host = TAUTLINE_HOST;
    const tautline_plugin* plugin = nullptr;
    require(function && function(&host, &plugin, nullptr) == TAUTLINE_OK, "the module opens");
    return plugin;
}

/** Loads, attaches, steps, and ends in one of three orders. */
void useOnce(const char* file, int order) {
    void* module = dlopen(file, RTLD_NOW);
    require(module, "the module loads");
    const tautline_plugin* plugin = open(module);
    auto host = std::make_unique<Host>();
    tautline_attachment* attachment = nullptr;
    tautline_error error{};
    require(plugin->attach(&host->system, kDescription, nullptr, nullptr, 0, &attachment, &error) == TAUTLINE_OK,
            error.message);
    SimTK::State state = host->system.realizeTopology();
    host->system.realize(state, SimTK::Stage::Acceleration);
    if (order == 0) {  // the system, the handle, the module
        host.reset();
        state = SimTK::State();
        plugin->release(attachment);
        dlclose(module);
    } else if (order == 1) {  // the handle, the system, the module: the next call lets it go
        plugin->release(attachment);
        host.reset();
        state = SimTK::State();
        open(module);
        dlclose(module);
    } else {  // the module is unloaded while the system still needs it, and stays
        plugin->release(attachment);
        dlclose(module);
        require(isLoaded(file), "the module stays while a system needs it");
        host->system.realize(state, SimTK::Stage::Acceleration);
        host.reset();
        state = SimTK::State();
        module = dlopen(file, RTLD_NOW);
        open(module);
        dlclose(module);
    }
    require(!isLoaded(file), "the module is gone");
}

}  // namespace

int main(int argc, char** argv) {
    require(argc == 3, "MODULE and TIMES are given");
    for (int i = 0; i < std::atoi(argv[2]); ++i) useOnce(argv[1], i % 3);
}
