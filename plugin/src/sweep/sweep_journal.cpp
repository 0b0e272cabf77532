// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_journal.h"

#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tautline/version.h"

namespace tautline {
namespace {

using nlohmann::ordered_json;

std::string readWhole(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/** FNV-1a. */
std::uint64_t addToHash(std::uint64_t hash, const std::string& text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return (hash ^ 0xff) * 0x100000001b3u;
}

std::string makeHeader(std::uint64_t fingerprint) {
    return ordered_json{{"sweep", fingerprint}}.dump();
}

}  // namespace

std::uint64_t calcFingerprint(const std::filesystem::path& modelFile, const std::filesystem::path& sweepFile) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::string& text : {readWhole(modelFile), readWhole(sweepFile), std::string(TAUTLINE_VERSION)})
        hash = addToHash(hash, text);
    return hash;
}

std::string toLine(const SweepResult& result) {
    ordered_json values = ordered_json::array();
    for (const auto& [name, value] : result.values) values.push_back({name, value});  // NaN is written as null
    return ordered_json{{"run", result.run}, {"exit", result.exitCode}, {"reason", result.reason}, {"values", values}}
        .dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

SweepResult parseResult(const std::string& line) {
    try {
        const ordered_json json = ordered_json::parse(line);
        SweepResult result;
        result.run = json.at("run"), result.exitCode = json.at("exit"), result.reason = json.at("reason");
        for (const ordered_json& value : json.at("values"))
            result.values.emplace_back(value.at(0), value.at(1).is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                                          : value.at(1).get<double>());
        return result;
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error("this is no result of a run: " + line.substr(0, 60));
    }
}

SweepJournal::SweepJournal(const std::filesystem::path& folder, std::uint64_t fingerprint)
    : m_file(folder / "journal.jsonl") {
    std::filesystem::create_directories(folder);
    if (std::filesystem::exists(m_file)) read(fingerprint);
    // Written anew: a line that a killed program has begun goes.
    const std::filesystem::path next = m_file.string() + ".new";
    m_stream.open(next);
    m_stream << makeHeader(fingerprint) << "\n";
    for (const auto& [run, result] : m_results) m_stream << toLine(result) << "\n";
    m_stream.flush();
    if (!m_stream) throw std::runtime_error(next.string() + ": cannot be written");
    std::filesystem::rename(next, m_file);
}

void SweepJournal::read(std::uint64_t fingerprint) {
    std::ifstream stream(m_file);
    std::string line;
    std::getline(stream, line);
    if (line != makeHeader(fingerprint))
        throw std::runtime_error(m_file.string() +
                                 ": is of another sweep, model or version: choose another folder, or remove this one");
    for (int number = 2; std::getline(stream, line); ++number) {
        const bool isCut = stream.eof();  // no end of line: the program was killed while it wrote
        try {
            const SweepResult result = parseResult(line);
            if (!isCut) m_results[result.run] = result;
        } catch (const std::runtime_error& error) {
            if (!isCut) throw std::runtime_error(m_file.string() + ":" + std::to_string(number) + ": " + error.what());
        }
    }
}

void SweepJournal::add(const SweepResult& result) {
    m_results[result.run] = result;
    m_stream << toLine(result) << std::endl;
    if (!m_stream) throw std::runtime_error(m_file.string() + ": cannot be written");
}

void SweepJournal::forgetFailed() {
    for (auto next = m_results.begin(); next != m_results.end();)
        next = next->second.isFailed() ? m_results.erase(next) : std::next(next);
}

}  // namespace tautline
