// SPDX-License-Identifier: Apache-2.0
/** Feeds the model reader with anything: it must return a model or refuse the text with a ModelError, whatever it is. */
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tautline/models/osim_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tautline::models;
    // The first byte chooses how it is read.
    if (size == 0) return 0;
    ReadingOptions options;
    options.lengthsOnly = data[0] & 1;
    if (data[0] & 2) options.ignored = {"Force", "Probe"};
    try {
        readOsimText(std::string_view(reinterpret_cast<const char*>(data), size), "fuzzed.osim", options);
    } catch (const ModelError&) {
        // Refused, which is what most of this deserves. Anything else that is thrown ends the fuzzer.
    }
    return 0;
}
