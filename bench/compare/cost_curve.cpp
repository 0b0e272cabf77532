// SPDX-License-Identifier: Apache-2.0
#include "cost_curve.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>

#include "text_table.h"
#include "weave.h"

namespace tautline::compare {
namespace {

constexpr int kCounts[] = {10, 20, 50, 100, 200, 500, 1000};
constexpr double kTolerance = 1e-3, kTightTolerance = 1e-9;

/** By way: time per surface [us] by number of surfaces. */
using Curves = std::map<std::string, std::map<int, double>>;

void run(std::vector<Contestant>& contestants, const WeaveRow& row, int numRounds, const std::string& suffix,
         Curves& curves) {
    runRounds(contestants, row.lengths, numRounds);
    const int numPoses = static_cast<int>(row.poses.size());
    for (const Contestant& contestant : contestants)
        curves[contestant.way + suffix][row.count] = contestant.calcMicroseconds(numPoses) / row.count;
}

Curves measure(int numRounds) {
    constexpr int kSurfacesPerRound = 8000, kFewestPoses = 16;
    constexpr int kMostOfCablePath = 20, kMostOfCableSpan = 200;
    Curves curves;
    for (const int count : kCounts) {
        const int numPoses = std::max(kFewestPoses, kSurfacesPerRound / count);
        const WeaveRow row(Kind::Cylinders, count, numPoses, false);
        std::vector<Contestant> contestants{makeCore(row, kTolerance), makeThroughSimbody(row, kTolerance)};
        if (count <= kMostOfCablePath) contestants.push_back(makeCablePath(row));
#if TAUTLINE_SIMBODY_HAS_CABLE_SPAN
        if (count <= kMostOfCableSpan) contestants.push_back(makeCableSpan(row, kTolerance, true));
#else
        static_cast<void>(kMostOfCableSpan);
#endif
        run(contestants, row, numRounds, "", curves);
        std::vector<Contestant> tight{makeCore(row, kTightTolerance)};
        run(tight, row, numRounds, ", tol 1e-9", curves);
#if TAUTLINE_HAS_MUJOCO
        const WeaveRow broken(Kind::Cylinders, count, numPoses, true);
        std::vector<Contestant> others{makeMujoco(broken)};
        run(others, broken, numRounds, ", points between", curves);
#endif
    }
    return curves;
}

void print(const Curves& curves, std::ostream& out) {
    out << "us per surface and step, by number of cylinders; tol 1e-3 where nothing else is said\n";
    TextTable table;
    table.addColumn("way", "", true);
    for (const int count : kCounts) table.addColumn(std::to_string(count));
    for (const auto& [way, curve] : curves) {
        std::vector<std::string> row{way};
        for (const int count : kCounts) row.push_back(curve.count(count) ? format(curve.at(count), 2) : "");
        table.addRow(row);
    }
    table.print(out);
}

std::string writeScript(const Curves& curves, const std::filesystem::path& picture) {
    std::ostringstream script, plots;
    script << "set terminal svg size 760,460 enhanced font 'sans,13' background 'white'\n"
           << "set output '" << picture.string() << "'\n"
           << "set logscale xy\nset xrange [8:1250]\nset grid\nset key top right\n"
           << "set xlabel 'cylinders'\nset ylabel 'CPU time per cylinder and step [us]'\n";
    int number = 0;
    for (const auto& [way, curve] : curves) {
        script << "$curve" << number << " << EOD\n";
        for (const auto& [count, time] : curve) script << count << " " << time << "\n";
        script << "EOD\n";
        plots << (number == 0 ? "plot " : ", ") << "$curve" << number
              << " using 1:2 with linespoints lw 2 pt 7 ps 0.5 title \"" << way << "\"";
        ++number;
    }
    return script.str() + plots.str() + "\n";
}

}  // namespace

void drawCostCurve(int numRounds, const std::filesystem::path& picture, std::ostream& out) {
    const Curves curves = measure(numRounds);
    print(curves, out);
    FILE* gnuplot = popen("gnuplot", "w");
    if (!gnuplot) throw std::runtime_error("gnuplot cannot be run");
    std::fputs(writeScript(curves, picture).c_str(), gnuplot);
    if (pclose(gnuplot) != 0) throw std::runtime_error("gnuplot failed; it draws " + picture.string());
}

}  // namespace tautline::compare
