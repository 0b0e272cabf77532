// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <cmath>

namespace tautline {
namespace {

/** Of time left; rough, so that it does not flicker. */
std::string describeTime(double seconds) {
    if (seconds < 60) return std::to_string(std::lround(std::ceil(seconds))) + " s";
    if (seconds < 3600) return std::to_string(std::lround(seconds / 60)) + " min";
    return std::to_string(std::lround(seconds / 3600)) + " h";
}

}  // namespace

void ProgressBar::show(double share) {
    if (!m_isShown) return;
    const int percent = static_cast<int>(100 * share), filled = percent * 40 / 100;
    const double passed = std::chrono::duration<double>(Clock::now() - m_begin).count();
    std::string text =
        "[" + std::string(filled, '#') + std::string(40 - filled, '.') + "] " + std::to_string(percent) + " %";
    // The first second says little of those to come.
    if (share > 0 && passed > 1) text += ", " + describeTime(passed * (1 - share) / share) + " left";
    if (text == m_text) return;
    const std::string space(m_text.size() > text.size() ? m_text.size() - text.size() : 0, ' ');
    m_out << "\r" << text << space << std::flush;
    m_text = text;
}

void ProgressBar::clear() {
    if (!m_text.empty()) m_out << "\r" << std::string(m_text.size(), ' ') << "\r" << std::flush;
    m_text.clear();
}

}  // namespace tautline
