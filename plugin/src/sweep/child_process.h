// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tautline {

/** The `tautline` program: beside the one that runs, or itself. */
std::filesystem::path findProgram();

/** A program that runs beside this one: what happens to it does not touch the one that has started it. */
class ChildProcess {
public:
    /** @param arguments   without the name of the program
    @param logFile   of what it prints, made anew
    @throws std::runtime_error if it cannot be started */
    ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& logFile);
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&&) = delete;
    /** Ends it. */
    ~ChildProcess();

    /** How it has ended: its exit code, or -signal; nothing while it runs. */
    std::optional<int> poll();

private:
    pid_t m_pid = -1;
};

}  // namespace tautline
