// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Where exceptions stop and become results and messages. */
#include <exception>
#include <string>

#include "tautline/plugin.h"

namespace tautline::plugin {

/** An error that has a result of its own. */
class BorderError : public std::exception {
public:
    BorderError(tautline_result result, std::string message) : m_result(result), m_message(std::move(message)) {}
    const char* what() const noexcept override { return m_message.c_str(); }
    tautline_result getResult() const { return m_result; }

private:
    tautline_result m_result;
    std::string m_message;
};

/** @throws BorderError TAUTLINE_BAD_ARGUMENT for null */
void requirePointer(const void* pointer, const char* name);

/** Inside a catch block: the result for the exception, and its message. @param error   may be null */
tautline_result reportException(tautline_error* error) noexcept;

/** Writes what fits, cut at the end. */
void report(tautline_error* error, int line, const char* message) noexcept;

/** Calls work(), and reports what it throws. */
template <class Work>
tautline_result guard(tautline_error* error, Work work) noexcept {
    try {
        work();
        return TAUTLINE_OK;
    } catch (...) {
        return reportException(error);
    }
}

}  // namespace tautline::plugin
