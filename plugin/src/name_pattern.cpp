// SPDX-License-Identifier: Apache-2.0
#include "name_pattern.h"

#include <algorithm>
#include <stdexcept>

namespace tautline {
namespace {

/** Of a list in a message. */
constexpr std::size_t kMostNames = 40;

}  // namespace

bool matchesPattern(const std::string& name, const std::string& pattern) {
    std::size_t n = 0, p = 0, star = std::string::npos, afterStar = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++, afterStar = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p, ++n;
        } else if (star != std::string::npos) {
            p = star + 1, n = ++afterStar;  // let the last star take one more
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string::npos;
}

bool matchesAny(const std::string& name, const std::vector<std::string>& patterns) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) { return matchesPattern(name, pattern); });
}

void requireMatches(const std::vector<std::string>& patterns, const std::vector<std::string>& names,
                    const std::string& option) {
    for (const std::string& pattern : patterns) {
        const bool isUsed = std::any_of(names.begin(), names.end(),
                                        [&](const std::string& name) { return matchesPattern(name, pattern); });
        if (!isUsed) throw std::runtime_error(option + " '" + pattern + "' matches none of " + listNames(names));
    }
}

std::string listNames(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) text += (i ? ", " : "") + names[i];
    if (names.size() > kMostNames) text += ", ... (" + std::to_string(names.size()) + " in all)";
    return text;
}

}  // namespace tautline
