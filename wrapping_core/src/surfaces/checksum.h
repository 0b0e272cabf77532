// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Private: the sum by which a file of a solid tells that it is whole. */
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tautline {

/** FNV-1a over words of eight bytes, the last one filled up with zeros: each step is a bijection of the sum so far, so
that a change within one word always shows. */
inline std::uint64_t calcChecksum(std::string_view bytes) {
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(sum)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof(word), bytes.size() - at));
        sum = (sum ^ word) * 0x100000001b3u;
        sum ^= sum >> 29;  // or the high bits of words would only ever meet the high bits of the sum
    }
    return sum;
}

}  // namespace tautline
