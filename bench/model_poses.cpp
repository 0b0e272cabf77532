// SPDX-License-Identifier: Apache-2.0
/** Time for lengths and moment arms of a model in many poses, by as many threads as asked: what model_poses.py compares
Python with. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tautline/models/osim_reader.h"
#include "tautline/models/parallel_study.h"

namespace {

using namespace tautline::models;

std::vector<double> readNumbers(const std::string& file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) throw std::runtime_error("cannot read " + file);
    std::vector<double> numbers(static_cast<std::size_t>(stream.tellg()) / sizeof(double));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(double)));
    return numbers;
}

/** Of each pose the lengths, then by path the effective arms about all coordinates, 0 about those not crossed. */
void writeNumbers(const PathStudy& study, const std::vector<PoseAnswer>& answers, const std::string& file) {
    std::ofstream stream(file, std::ios::binary);
    const auto write = [&stream](double number) {
        stream.write(reinterpret_cast<const char*>(&number), sizeof number);
    };
    for (const PoseAnswer& answer : answers) {
        for (const PathAnswer& path : answer.paths) write(path.length);
        for (std::size_t p = 0; p < answer.paths.size(); ++p) {
            const std::vector<std::string>& crossed = study.getPaths()[p].coordinates;
            for (const std::string& name : study.getCoordinateNames()) {
                const auto at = std::find(crossed.begin(), crossed.end(), name);
                const auto index = static_cast<std::size_t>(at - crossed.begin());
                write(at == crossed.end() ? 0.0 : answer.paths[p].effectiveArms[index]);
            }
        }
    }
}

std::vector<PoseAnswer> solveAll(ParallelStudy& study, const std::vector<double>& numbers, int numThreads) {
    const std::vector<std::string>& names = study.getStudy().getCoordinateNames();
    std::vector<PoseAnswer> answers;
    const auto makePose = [&](int i) {
        ModelPose pose;
        for (std::size_t c = 0; c < names.size(); ++c)
            pose.values[names[c]] = numbers[static_cast<std::size_t>(i) * names.size() + c];
        return pose;
    };
    study.solveMany(static_cast<int>(numbers.size() / names.size()), makePose, answers, {numThreads, {}});
    return answers;
}

/** Numbers of the poses that have all threads make their systems. */
std::size_t countWarmUp(const ParallelStudy& study, int numThreads) {
    return static_cast<std::size_t>(numThreads * tautline::kPosesPerBlock) *
           study.getStudy().getCoordinateNames().size();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Solves the paths of a model in poses, and prints how long that took [s].");
    std::string model, poses, out;
    int numThreads = 1;
    app.add_option("MODEL", model, "model file (.osim)")->required();
    app.add_option("POSES", poses, "numbers of 8 bytes: a row of all coordinates for each pose")->required();
    app.add_option("--threads", numThreads, "that share the poses")->check(CLI::Range(1, 1024))->capture_default_str();
    app.add_option("--out", out, "file for lengths and effective moment arms, pose by pose");
    CLI11_PARSE(app, argc, argv);
    try {
        const ModelDescription description = readOsimFile(model, {{}, true});
        ParallelStudy study(description);
        const std::vector<double> numbers = readNumbers(poses);
        solveAll(study, {numbers.begin(), numbers.begin() + std::min(numbers.size(), countWarmUp(study, numThreads))},
                 numThreads);
        const auto begin = std::chrono::steady_clock::now();
        const std::vector<PoseAnswer> answers = solveAll(study, numbers, numThreads);
        std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() << "\n";
        if (!out.empty()) writeNumbers(study.getStudy(), answers, out);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
