// SPDX-License-Identifier: Apache-2.0
#include "fitted_paths.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "../frame_times.h"
#include "tautline/models/function_based_path.h"
#include "tautline/models/osim_reader.h"
#include "text_table.h"

namespace tautline::compare {
namespace {

using Clock = std::chrono::steady_clock;
using models::ModelSystem;

/** The functions in the order of the model's paths, with the places of their arguments among all coordinates. */
struct FittedPath {
    models::MultivariateFunction length;
    std::vector<std::size_t> coordinates;
    std::vector<std::size_t> arms;  ///< places of the arguments among the coordinates that the path crosses; or none
};

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

std::size_t findName(const std::vector<std::string>& names, const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? kNowhere : static_cast<std::size_t>(at - names.begin());
}

std::vector<FittedPath> findFunctions(const std::vector<models::OwnedPathFunctions>& all, const ModelSystem& model) {
    std::vector<FittedPath> fitted;
    for (const ModelSystem::PathView& path : model.getPaths()) {
        const auto owned =
            std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.owner == path.path; });
        if (owned == all.end()) throw std::runtime_error("no function was fitted to " + path.path);
        fitted.push_back({owned->functions.length, {}, {}});
        for (const std::string& name : owned->functions.coordinates) {
            fitted.back().coordinates.push_back(findName(model.getModel().getCoordinateNames(), name));
            fitted.back().arms.push_back(findName(path.coordinates, name));
        }
    }
    return fitted;
}

/** Values of all coordinates by frame, dependent ones as their couplers say. */
std::vector<std::vector<double>> listCoordinates(ModelSystem& model, const Motion& motion) {
    SimTK::State state = model.makeDefaultState();
    std::vector<std::vector<double>> frames;
    for (const models::ModelPose& pose : motion.poses) {
        for (const auto& [name, value] : pose.values) model.getModel().setCoordinate(state, name, value);
        model.getModel().applyCouplers(state);
        frames.emplace_back();
        for (const std::string& name : model.getModel().getCoordinateNames())
            frames.back().push_back(model.getModel().getCoordinate(state, name));
    }
    return frames;
}

/** All lengths of a frame, and all their derivatives, one path's after the other's. */
void evaluate(const std::vector<FittedPath>& paths, const std::vector<double>& coordinates, double* lengths,
              double* derivatives) {
    double arguments[16];
    for (const FittedPath& path : paths) {
        for (std::size_t i = 0; i < path.coordinates.size(); ++i) arguments[i] = coordinates[path.coordinates[i]];
        *lengths++ = path.length.calcValueAndGradient(arguments, derivatives);
        derivatives += path.coordinates.size();
    }
}

/** Median and largest, in mm. */
std::string tellDifferences(const std::vector<double>& differences) {
    const double largest = *std::max_element(differences.begin(), differences.end());
    return format(1e3 * calcMedian(differences), 2) + ", " + format(1e3 * largest, 1);
}

}  // namespace

void compareFittedPaths(const std::filesystem::path& modelFile, const std::filesystem::path& motionFile,
                        const std::filesystem::path& fittedFile, int numRounds, std::ostream& out) {
    const models::ModelDescription description = models::readOsimFile(modelFile);
    const Motion motion = readMotion(motionFile, description, {});
    ModelSystem model(description);
    const std::vector<FittedPath> fitted =
        findFunctions(models::readFunctionBasedPaths(fittedFile, description), model);
    const std::vector<std::vector<double>> coordinates = listCoordinates(model, motion);
    std::size_t numArguments = 0;
    for (const FittedPath& path : fitted) numArguments += path.coordinates.size();

    std::vector<FrameAnswers> exact;
    double bodies = 1e300, lengths = 1e300, arms = 1e300, functions = 1e300;
    std::vector<double> fittedLengths(fitted.size()), derivatives(numArguments);
    std::vector<double> offLengths, offArms;
    for (int round = 0; round < numRounds; ++round) {
        const FrameTimes times = timeFrames(model, motion, round == 0 ? &exact : nullptr);
        bodies = std::min(bodies, calcMedian(times.bodies));
        lengths = std::min(lengths, calcMedian(times.lengths));
        arms = std::min(arms, calcMedian(times.arms));
        std::vector<double> each;
        for (std::size_t frame = 0; frame < coordinates.size(); ++frame) {
            const Clock::time_point begin = Clock::now();
            evaluate(fitted, coordinates[frame], fittedLengths.data(), derivatives.data());
            each.push_back(calcMicroseconds(Clock::now() - begin));
            if (round > 0) continue;
            const double* derivative = derivatives.data();
            for (std::size_t p = 0; p < fitted.size(); ++p) {
                offLengths.push_back(std::abs(fittedLengths[p] - exact[frame].lengths[p]));
                for (const std::size_t at : fitted[p].arms) {
                    const double arm = -*derivative++;
                    const double exactArm = at == kNowhere ? 0 : exact[frame].momentArms[p][at];
                    if (std::isfinite(exactArm)) offArms.push_back(std::abs(arm - exactArm));
                }
            }
        }
        functions = std::min(functions, calcMedian(each));
    }
    out << description.name << ", " << fitted.size() << " paths, " << motion.poses.size() << " frames of "
        << motionFile.filename().string() << "; medians per frame, the least of " << numRounds << " rounds\n";
    TextTable table;
    table.addColumn("way", "", true);
    table.addColumn("lengths and derivatives", "[us]");
    table.addColumn("ratio");
    table.addColumn("lengths off", "median, most [mm]");
    table.addColumn("arms off", "median, most [mm]");
    const double all = lengths + arms;
    table.addRow({"exact, bodies posed", format(all, 1), "1", "0", "0"});
    table.addRow({"exact, with the bodies' poses", format(bodies + all, 1), format((bodies + all) / all, 2), "0", "0"});
    table.addRow({"fitted polynomials", format(functions, 1), format(functions / all, 3), tellDifferences(offLengths),
                  tellDifferences(offArms)});
    table.print(out);
}

}  // namespace tautline::compare
