// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace tautline::testing {

/** Runs a command of the shell. @param output   standard output and error are added. @return its exit code, or -1 */
inline int runProgram(const std::string& command, std::string& output) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return -1;
    char part[4096];
    while (std::fgets(part, sizeof part, pipe)) output += part;
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace tautline::testing
