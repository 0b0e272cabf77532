// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tautline {

/** Whether a name matches a pattern, in which * stands for any characters and ? for one. */
bool matchesPattern(const std::string& name, const std::string& pattern);

/** Whether it matches one of several. */
bool matchesAny(const std::string& name, const std::vector<std::string>& patterns);

/** @throws std::runtime_error naming the option and a pattern that none of the names matches */
void requireMatches(const std::vector<std::string>& patterns, const std::vector<std::string>& names,
                    const std::string& option);

/** "a, b, c"; of long lists the beginning and how many there are. */
std::string listNames(const std::vector<std::string>& names);

}  // namespace tautline
