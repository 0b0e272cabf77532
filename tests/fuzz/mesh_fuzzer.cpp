// SPDX-License-Identifier: Apache-2.0
/** Feeds the readers of meshes and solids with anything: they must return what they read or refuse it by the exception
that they promise. */
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tautline/error.h"
#include "tautline/models/mesh_file.h"
#include "tautline/models/model_error.h"
#include "tautline/surfaces/solid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tautline;
    // The first byte chooses the kind of file.
    if (size == 0) return 0;
    constexpr const char* kNames[] = {"fuzzed.vtp", "fuzzed.obj", "fuzzed.stl", "fuzzed.ply"};
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (data[0] % 5 < 4)
            requireMesh(models::readMeshContent(bytes, kNames[data[0] % 5]));
        else
            decodeSolid(bytes, "fuzzed.solid").calcImplicit(Vector3(0.1, 0.2, 0.3));
    } catch (const models::ModelError&) {
        // Refused, which is what most of this deserves. Anything else that is thrown ends the fuzzer.
    } catch (const InvalidInput&) {
        if (data[0] % 5 < 4) throw;  // a mesh that was read is one
    }
    return 0;
}
