// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <ostream>
#include <string>

namespace tautline {

/** A bar on a terminal with the time that is left, nothing elsewhere. */
class ProgressBar {
public:
    ProgressBar(std::ostream& out, bool isShown) : m_out(out), m_isShown(isShown) {}
    /** @param share   of the work that is done, 0 to 1 */
    void show(double share);
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    std::ostream& m_out;
    bool m_isShown;
    std::string m_text;
    Clock::time_point m_begin = Clock::now();
};

}  // namespace tautline
