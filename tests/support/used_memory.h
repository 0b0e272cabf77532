// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <malloc.h>

namespace tautline::testing {

/** Memory that the program has allocated and not freed [bytes]; 0 where the allocator does not tell, as under a
sanitizer. */
inline double getUsedMemory() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace tautline::testing
