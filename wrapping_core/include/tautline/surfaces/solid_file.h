// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Files of solids, so that a mesh is fitted once. */
#include <filesystem>
#include <string>
#include <string_view>

#include "tautline/surfaces/bspline_solid.h"

namespace tautline {

/** The bytes of a solid's file:

    "TautSld\n"  version (u32)  0x01020304 (u32)  length of the file (u64)
    12 doubles: origin, spacing, farOrigin, farSpacing, blendBegin, blendEnd, size, width
    6 int32: numBricks, numFarControls;  3 u64: lengths of bricks, controls, farControls, which follow in this order
    checksum (u64) of all that stands before it

Numbers are as the machine has them; a machine of the other byte order refuses the file. What is read back is the same
to the last bit. */
std::string encodeSolid(const BSplineSolid& solid);

/** @param fileName   for messages
@throws InvalidInput that names the file if it is no solid's, of another version or byte order, cut off, longer than it
says, or altered: every byte counts in the checksum */
BSplineSolid decodeSolid(std::string_view bytes, const std::string& fileName);

/** @throws InvalidInput that names the file if it cannot be written or read, or decodeSolid() refuses it */
void writeSolidFile(const BSplineSolid& solid, const std::filesystem::path& file);
BSplineSolid readSolidFile(const std::filesystem::path& file);

}  // namespace tautline
