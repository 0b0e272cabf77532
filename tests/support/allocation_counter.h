// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Counts allocations of the whole program. This header replaces the global operator new: include it in one
source file of a program only, the one that counts. */
#include <atomic>
#include <cstdlib>
#include <new>

namespace tautline::testing {

inline std::atomic<long> allocationCount{0};

inline void* allocateCounted(std::size_t size, std::size_t alignment) {
    ++allocationCount;
    const std::size_t rounded = (size + alignment) / alignment * alignment;
    if (void* memory = std::aligned_alloc(alignment, rounded)) return memory;
    throw std::bad_alloc();
}

}  // namespace tautline::testing

[[gnu::noinline]] void* operator new(std::size_t size) {
    return tautline::testing::allocateCounted(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    return tautline::testing::allocateCounted(size, static_cast<std::size_t>(alignment));
}
// GCC 12 takes the pairs apart when it inlines one half: kept out of line.
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
