// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>

namespace tautline::models {

/** A model that cannot be read or built. The message names the file, the line and the element. */
class ModelError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    /** @param line   counted from 1, of the element that `what` is about */
    ModelError(const std::string& fileName, int line, const std::string& what)
        : std::runtime_error(fileName + ":" + std::to_string(line) + ": " + what), m_line(line) {}

    /** 0 if it is about no line. */
    int getLine() const { return m_line; }

protected:
    ModelError(const std::string& message, int line) : std::runtime_error(message), m_line(line) {}

private:
    int m_line = 0;
};

}  // namespace tautline::models
