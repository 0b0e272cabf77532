// SPDX-License-Identifier: Apache-2.0
/** Time for lengths and moment arms of a model in many poses, by as many threads as asked: what model_poses.py compares
Python with. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "tautline/models/osim_reader.h"
#include "tautline/models/path_study.h"

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

/** Works through the poses: each worker has a study of its own and takes blocks of poses. */
std::vector<PoseAnswer> solveAll(std::vector<PathStudy>& studies, const std::vector<double>& numbers) {
    constexpr std::size_t kBlock = PathStudy::kPosesPerBlock;
    const std::vector<std::string>& names = studies.front().getCoordinateNames();
    const std::size_t count = numbers.size() / names.size();
    std::vector<PoseAnswer> answers(count);
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (PathStudy& study : studies)
        threads.emplace_back([&] {
            for (std::size_t first = next.fetch_add(kBlock); first < count; first = next.fetch_add(kBlock))
                for (std::size_t i = first; i < std::min(first + kBlock, count); ++i) {
                    ModelPose pose;
                    for (std::size_t c = 0; c < names.size(); ++c)
                        pose.values[names[c]] = numbers[i * names.size() + c];
                    answers[i] = study.solve(pose, static_cast<int>(i));
                }
        });
    for (std::thread& thread : threads) thread.join();
    return answers;
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
        std::vector<PathStudy> studies;
        for (int i = 0; i < numThreads; ++i) studies.emplace_back(description);
        const std::vector<double> numbers = readNumbers(poses);
        const auto begin = std::chrono::steady_clock::now();
        const std::vector<PoseAnswer> answers = solveAll(studies, numbers);
        std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() << "\n";
        if (!out.empty()) writeNumbers(studies.front(), answers, out);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
