// SPDX-License-Identifier: Apache-2.0
#include "text_table.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace tautline {

std::string format(double value, int digits, bool isScientific) {
    std::ostringstream text;
    text << (isScientific ? std::scientific : std::fixed) << std::setprecision(digits) << value;
    return text.str();
}

std::string formatShare(std::size_t count, std::size_t all) {
    if (count == 0 || all == 0) return "0 %";
    const long percent = std::lround(100.0 * static_cast<double>(count) / static_cast<double>(all));
    return std::to_string(std::clamp<long>(percent, 1, count == all ? 100 : 99)) + " %";
}

void TextTable::addColumn(const std::string& heading, const std::string& below, bool isLeft) {
    m_columns.push_back({heading, below, isLeft});
}

void TextTable::print(std::ostream& out) const {
    std::vector<std::vector<std::string>> lines(1);
    const bool hasBelow =
        std::any_of(m_columns.begin(), m_columns.end(), [](const Column& column) { return !column.below.empty(); });
    for (const Column& column : m_columns) lines[0].push_back(column.heading);
    if (hasBelow) {
        lines.emplace_back();
        for (const Column& column : m_columns) lines.back().push_back(column.below);
    }
    lines.insert(lines.end(), m_rows.begin(), m_rows.end());
    std::vector<std::size_t> widths(m_columns.size(), 0);
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    for (const auto& line : lines) {
        std::string text;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string space(widths[i] - line[i].size(), ' ');
            text += (i ? "  " : "") + (m_columns[i].isLeft ? line[i] + space : space + line[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        out << text << "\n";
    }
}

}  // namespace tautline
