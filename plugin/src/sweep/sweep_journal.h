// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "sweep/sweep_run.h"

namespace tautline {

/** The results of a sweep as they come, a line of JSON each (journal.jsonl): what a sweep that was killed goes on from.
The first line tells what sweep it is. */
class SweepJournal {
public:
    /** Opens the journal of a folder, or begins it.
    @param fingerprint   of the sweep: calcFingerprint()
    @throws std::runtime_error if the folder has another sweep, or a line before the last one cannot be read */
    SweepJournal(const std::filesystem::path& folder, std::uint64_t fingerprint);

    /** Of the runs that have ended, by their numbers. */
    const std::map<int, SweepResult>& getResults() const { return m_results; }
    /** Writes a result to the file. @throws std::runtime_error if that fails */
    void add(const SweepResult& result);
    /** Forgets failed runs, so that they are done again. */
    void forgetFailed();

private:
    void read(std::uint64_t fingerprint);

    std::filesystem::path m_file;
    std::map<int, SweepResult> m_results;
    std::ofstream m_stream;
};

/** Of the texts of the model and of the sweep's file, and of the program's version: two sweeps with the same one have
the same runs, but for other files that they name. */
std::uint64_t calcFingerprint(const std::filesystem::path& modelFile, const std::filesystem::path& sweepFile);

/** @name A result as a line of JSON, and back.
@throws std::runtime_error if it cannot be read */
///@{
std::string toLine(const SweepResult& result);
SweepResult parseResult(const std::string& line);
///@}

}  // namespace tautline
