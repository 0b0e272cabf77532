// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The version of Tautline, here and nowhere else: CMake reads it from this line. */
#define TAUTLINE_VERSION "0.1.0"
