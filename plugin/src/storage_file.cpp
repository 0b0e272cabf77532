// SPDX-License-Identifier: Apache-2.0
#include "storage_file.h"

#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tautline {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& what) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
}

std::vector<std::string> splitWords(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

double toNumber(const std::string& word, const std::filesystem::path& file, int line) {
    double value = 0;
    const char *begin = word.data(), *end = begin + word.size();
    const auto result = std::from_chars(begin, end, value);
    if (result.ec != std::errc() || result.ptr != end) fail(file, line, "'" + word + "' is not a number");
    return value;
}

/** "inDegrees=yes" in any spelling that OpenSim takes: spaces around the sign, capitals. */
void readUnits(const std::string& line, StorageTable& table) {
    std::string plain;
    for (const char c : line)
        if (!std::isspace(static_cast<unsigned char>(c)))
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (plain.rfind("indegrees=", 0) != 0) return;
    table.isInDegrees = plain == "indegrees=yes" || plain == "indegrees=true" || plain == "indegrees=1";
    table.saysUnits = true;
}

}  // namespace

std::string toText(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

void writeWhole(const std::string& text, const std::filesystem::path& file) {
    const std::filesystem::path part = file.string() + ".part";
    std::ofstream stream(part, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code error;
    if (stream) std::filesystem::rename(part, file, error);
    if (!stream || error) {
        std::filesystem::remove(part, error);
        throw std::runtime_error(file.string() + ": cannot be written");
    }
}

void writeStorage(const StorageTable& table, const std::filesystem::path& file) {
    std::string text = table.name + "\nversion=1\nnRows=" + std::to_string(table.rows.size()) +
                       "\nnColumns=" + std::to_string(table.labels.size()) +
                       "\ninDegrees=" + (table.isInDegrees ? "yes" : "no") + "\nendheader\n";
    for (std::size_t i = 0; i < table.labels.size(); ++i) text += (i ? "\t" : "") + table.labels[i];
    text += "\n";
    for (const std::vector<double>& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) text += (i ? "\t" : "") + toText(row[i]);
        text += "\n";
    }
    writeWhole(text, file);
}

StorageTable readStorage(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    StorageTable table;
    table.saysUnits = false;
    std::string line;
    int number = 0;
    bool isHeader = true;
    while (std::getline(stream, line)) {
        ++number;
        const std::vector<std::string> words = splitWords(line);
        if (words.empty()) continue;
        if (isHeader) {
            readUnits(line, table);
            if (table.name.empty()) table.name = words[0];
            isHeader = words[0] != "endheader";
        } else if (table.labels.empty()) {
            table.labels = words;
            if (words[0] != "time") fail(file, number, "the first column is '" + words[0] + "', not 'time'");
        } else {
            std::vector<double> row;
            for (const std::string& word : words) row.push_back(toNumber(word, file, number));
            if (row.size() != table.labels.size())
                fail(file, number,
                     std::to_string(row.size()) + " numbers for " + std::to_string(table.labels.size()) + " columns");
            if (!table.rows.empty() && !(row[0] > table.rows.back()[0])) fail(file, number, "time does not increase");
            table.rows.push_back(row);
        }
    }
    if (isHeader) fail(file, number, "no line 'endheader'");
    if (table.rows.empty()) fail(file, number, "no rows of numbers");
    return table;
}

}  // namespace tautline
