// SPDX-License-Identifier: Apache-2.0
/** Feeds the readers of meshes and solids with anything, and what they accept to the repair of meshes and to the
solid's function: all must give finite answers or refuse by the exception that they promise. */
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "surfaces/checksum.h"
#include "tautline/error.h"
#include "tautline/meshes/mesh_distance.h"
#include "tautline/meshes/mesh_repair.h"
#include "tautline/models/mesh_file.h"
#include "tautline/models/model_error.h"
#include "tautline/surfaces/solid_file.h"

namespace {

using namespace tautline;

const Vector3 kSomewhere(0.1, 0.2, 0.3);

void check(bool holds) {
    if (!holds) std::abort();
}

void readMesh(std::string_view bytes, const char* fileName) {
    TriangleMesh mesh;
    try {
        mesh = models::readMeshContent(bytes, fileName);
    } catch (const models::ModelError&) {
        return;  // refused, which is what most of this deserves
    }
    requireMesh(mesh);  // throws: a mesh that was read is one
    try {
        const MeshDistance distance(repairMesh(mesh).mesh);
        check(distance.findNearest(kSomewhere).point.allFinite());
        check(std::isfinite(distance.calcWindingNumber(kSomewhere)));
    } catch (const InvalidInput&) {
        // No triangle of it has an area, or its numbers are too large.
    }
}

void readSolid(std::string_view bytes) {
    try {
        const BSplineSolid solid = decodeSolid(bytes, "fuzzed.solid");
        for (const Vector3& p : {kSomewhere, Vector3(solid.calcBox().center()), Vector3(1e6 * kSomewhere)}) {
            Vector3 N;
            check(!std::isnan(solid.calcHeightAndNormal(p, N)));
            solid.calcImplicit(p);
        }
    } catch (const InvalidInput&) {
        // Refused.
    }
}

/** One brick of a plane z = 0 through its middle. */
std::string makeSolidFile() {
    SolidGrid grid;
    grid.spacing = 0.1, grid.farSpacing = 0.4, grid.size = 1, grid.width = 0.1;
    grid.blendBegin = 0.2, grid.blendEnd = 0.3;
    grid.numBricks = {1, 1, 1}, grid.bricks = {0};
    grid.origin = Vector3::Constant(-0.4), grid.farOrigin = Vector3::Constant(-1);
    for (int i = 0; i < SolidGrid::kBrickControls; ++i)
        grid.controls.push_back(0.1F * static_cast<float>(i % SolidGrid::kControls - 5));
    grid.numFarControls = {8, 8, 8};
    for (int i = 0; i < 512; ++i) grid.farControls.push_back(0.4F * static_cast<float>(std::abs(i % 8 - 4)));
    return encodeSolid(BSplineSolid(grid));
}

/** That file with other bytes at places that the data names by threes: where, where, what; a byte that is left over
cuts so many off. Length and checksum are then put right, or nothing behind them would ever be read. */
std::string makeAlteredSolidFile(std::string_view data) {
    static const std::string kWhole = makeSolidFile();
    constexpr std::size_t kLengthAt = 16;
    std::string bytes = kWhole;
    std::size_t at = 0;
    const auto take = [&] { return static_cast<unsigned char>(data[at++]); };
    while (at + 3 <= data.size()) {
        const std::size_t where = take() + 256U * take();
        bytes[where % bytes.size()] = data[at++];
    }
    if (at < data.size()) bytes.resize(bytes.size() - take());
    const std::uint64_t length = bytes.size();
    std::memcpy(bytes.data() + kLengthAt, &length, sizeof(length));
    const std::size_t end = bytes.size() - sizeof(length);
    const std::uint64_t sum = calcChecksum(std::string_view(bytes).substr(0, end));
    std::memcpy(bytes.data() + end, &sum, sizeof(sum));
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // The first byte chooses the kind of file.
    if (size == 0) return 0;
    constexpr const char* kNames[] = {"fuzzed.vtp", "fuzzed.obj", "fuzzed.stl", "fuzzed.ply"};
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const int kind = data[0] % 6;
    if (kind < 4)
        readMesh(bytes, kNames[kind]);
    else
        readSolid(kind == 4 ? std::string(bytes) : makeAlteredSolidFile(bytes));
    return 0;
}
