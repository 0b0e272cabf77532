// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>
#include <string>
#include <vector>

namespace tautline {

/** With so many decimals, or in scientific notation with so many digits after the point. */
std::string format(double value, int digits, bool isScientific = false);

/** In percent; 0 % and 100 % only where it is none or all. */
std::string formatShare(std::size_t count, std::size_t all);

/** Rows of texts under headings, in columns as wide as what stands in them. */
class TextTable {
public:
    /** One heading and its second line, such as a unit, per column. @param isLeft   numbers stand to the right */
    void addColumn(const std::string& heading, const std::string& below = "", bool isLeft = false);
    /** A text per column. */
    void addRow(std::vector<std::string> row) { m_rows.push_back(std::move(row)); }
    void print(std::ostream& out) const;

private:
    struct Column {
        std::string heading, below;
        bool isLeft;
    };
    std::vector<Column> m_columns;
    std::vector<std::vector<std::string>> m_rows;
};

}  // namespace tautline
