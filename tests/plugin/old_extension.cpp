// SPDX-License-Identifier: Apache-2.0
// An extension as if it had been built for a Tautline of long ago.
extern "C" const char* tautline_extension_build() {
    return "Tautline 0.0.1, Simbody with asserts";
}

extern "C" void tautline_extension_register(void*) {}
