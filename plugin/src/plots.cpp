// SPDX-License-Identifier: Apache-2.0
#include "plots.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tautline {
namespace {

using PathView = models::ModelSystem::PathView;

/** More events than this are not marked: they would only blacken the picture. */
constexpr std::size_t kMaxMarks = 60;

/** Of an error on a logarithmic axis: that of a path of straight lines is exactly 0. */
const std::string kSmallestDrawn = "1e-18";
constexpr double kLowestTop = 1e-12;  ///< of that axis

std::string quote(const std::string& text) {
    std::string quoted = "'";
    for (char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    return quoted + "'";
}

/** Names in models may hold anything; those of files had better not. */
std::string toFileName(std::string name) {
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
    return name;
}

/** A curve of a storage file: column and color counted from 1; an obstacle has the same color in every panel. */
struct Curve {
    std::string file, title;
    std::size_t column = 0;
    int color = 1;
};

struct Panel {
    std::string title, unit;
    bool isLogarithmic = false;
    double largest = 0;  ///< number in it
    std::vector<Curve> curves;
};

std::vector<std::string> findObstacles(const Cable& cable) {
    std::vector<std::string> names;
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e)
        if (cable.isObstacle(e)) names.push_back(cable.getElementName(e));
    return names;
}

void addCurve(const StorageTable& table, const std::string& label, const std::string& title, int color, Panel& panel) {
    const auto at = std::find(table.labels.begin(), table.labels.end(), label);
    if (at == table.labels.end()) return;
    // gnuplot takes a curve without any point for an error.
    const auto column = static_cast<std::size_t>(at - table.labels.begin());
    const auto isDrawable = [&](const std::vector<double>& row) { return std::isfinite(row[column]); };
    if (std::none_of(table.rows.begin(), table.rows.end(), isDrawable)) return;
    for (const std::vector<double>& row : table.rows)
        if (isDrawable(row)) panel.largest = std::max(panel.largest, row[column]);
    panel.curves.push_back({table.name + ".sto", title, column + 1, color});
}

std::vector<Panel> makePanels(const PathView& path, const SimulationResult& result) {
    std::vector<Panel> panels;
    const auto addPanel = [&](const Panel& panel) {
        if (!panel.curves.empty()) panels.push_back(panel);
    };
    const auto addOfPath = [&](const std::string& quantity, const std::string& unit, bool isLogarithmic) {
        Panel panel{quantity == "path_error" ? "path error" : quantity, unit, isLogarithmic, 0, {}};
        addCurve(result.paths, path.path + "|" + quantity, "", 1, panel);
        addPanel(panel);
    };
    const auto addOfObstacles = [&](const std::string& quantity, const std::string& title, const std::string& unit) {
        Panel panel{title, unit, false, 0, {}};
        int color = 0;
        for (const std::string& name : findObstacles(path.cable))
            addCurve(result.clearances, path.path + "|" + quantity + "." + name, name, ++color, panel);
        if (panel.curves.size() == 1) panel.title += " of " + std::exchange(panel.curves[0].title, "");
        addPanel(panel);
    };
    addOfPath("length", "m", false);
    addOfPath("rate", "m/s", false);
    addOfPath("tension", "N", false);
    addOfPath("path_error", "", true);
    addOfObstacles("distance", "signed distance d", "m");
    addOfObstacles("line_coordinate", "line coordinate s_0", "m");
    addOfObstacles("u", "surface coordinate u_C", "");
    addOfObstacles("v", "surface coordinate v_C", "");
    return panels;
}

/** Times at which the path's contacts changed, from events.csv. */
std::vector<std::string> findEventTimes(const PathView& path, const std::string& events) {
    std::vector<std::string> times;
    std::istringstream lines(events);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t comma = line.find(',');
        if (line.compare(comma + 1, path.path.size() + 1, path.path + ",") == 0) times.push_back(line.substr(0, comma));
    }
    return times;
}

void writePanel(const Panel& panel, std::ostream& script) {
    script << "set title " << quote(panel.title + (panel.unit.empty() ? "" : " [" + panel.unit + "]")) << "\n"
           << (panel.isLogarithmic ? "set logscale y\nset format y '%.0e'\nset yrange [" + kSmallestDrawn + ":" +
                                         toText(std::max(kLowestTop, 2 * panel.largest)) + "]\n"
                                   : "unset logscale\nset format y\nset yrange [*:*]\n")
           << "plot ";
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        const Curve& curve = panel.curves[i];
        // Storage files: seven lines of header and labels.
        const std::string column = std::to_string(curve.column), number = "$" + column;
        script << (i ? ", \\\n     " : "") << quote(curve.file) << " skip 7 using 1:"
               << (panel.isLogarithmic
                       ? "(" + number + " > " + kSmallestDrawn + " ? " + number + " : " + kSmallestDrawn + ")"
                       : column)
               << " with lines lw 1.5 lc " << curve.color << " "
               << (curve.title.empty() ? "notitle" : "title " + quote(curve.title));
    }
    script << "\n";
}

void writeCurves(const PathView& path, const SimulationResult& result, const std::string& picture,
                 std::ostream& script) {
    const std::vector<Panel> panels = makePanels(path, result);
    const std::size_t rows = (panels.size() + 1) / 2;
    script << "set terminal svg noenhanced size 1000," << 240 * rows + 40 << " font 'sans,11' background 'white'\n"
           << "set output " << quote(picture) << "\nunset arrow\nset key below\n";
    const std::vector<std::string> times = findEventTimes(path, result.events);
    if (times.size() <= kMaxMarks)
        for (const std::string& time : times)
            script << "set arrow from " << time << ", graph 0 to " << time << ", graph 1 nohead dt 2 lc 'gray'\n";
    script << "set multiplot layout " << rows << ",2 title " << quote(path.name + ": time in s") << "\n";
    for (const Panel& panel : panels) writePanel(panel, script);
    script << "unset multiplot\nunset output\n";
}

/** Errors over iterations, one curve per obstacle and one for all (thesis Fig. 8.4). */
void writeStart(const PathView& path, const std::string& picture, std::ostream& script) {
    std::vector<std::string> names{"all"};
    for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
        if (path.start[e]) names.push_back(path.cable.getElementName(e));
    script << "set terminal svg noenhanced size 700,450 font 'sans,11' background 'white'\nset output "
           << quote(picture)
           << "\nunset arrow\nset key below\nset datafile separator comma\nset datafile missing NaN\nset logscale y\n"
           << "set format y '%.0e'\nset xtics 1\nset title " << quote(path.name + ": path errors over iterations")
           << "\nplot ";
    for (std::size_t i = 0; i < names.size(); ++i)
        script << (i ? ", \\\n     " : "") << "'start.csv' skip 1 using ((strcol(1) eq " << quote(path.path)
               << " && strcol(3) eq " << quote(names[i]) << ") ? $2 : NaN):4 with linespoints pt 7 ps 0.6 title "
               << quote(names[i]);
    script << "\nunset output\nset datafile separator whitespace\nset xtics autofreq\n";
}

/** All that can be read from a file descriptor, which is closed. */
std::string readToEnd(int descriptor) {
    std::string text;
    char part[4096];
    for (ssize_t count; (count = read(descriptor, part, sizeof part)) > 0;)
        text.append(part, static_cast<std::size_t>(count));
    close(descriptor);
    return text;
}

/** @return what gnuplot says: warnings */
std::string runGnuplot(const std::filesystem::path& folder, const std::string& script) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("gnuplot cannot be run: no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::string program = "gnuplot", file = script;
    char* arguments[] = {program.data(), file.data(), nullptr};
    pid_t process = 0;
    const int error = posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    const std::string said = readToEnd(ends[0]);
    int status = -1;
    if (error == 0) waitpid(process, &status, 0);
    if (error != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error("gnuplot failed; its script is " + (folder / script).string() +
                                 (said.empty() ? "" : "; it says: " + said));
    return said;
}

}  // namespace

void requireGnuplot() {
    const char* variable = std::getenv("PATH");
    std::istringstream folders(variable ? variable : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((folder + "/gnuplot").c_str(), X_OK) == 0) return;
    throw std::runtime_error("--plot needs gnuplot, which was not found (Debian: apt-get install gnuplot-nox)");
}

std::vector<std::filesystem::path> drawCurves(const models::ModelSystem& model, const SimulationResult& result,
                                              const std::filesystem::path& folder, std::string& said) {
    std::vector<std::filesystem::path> pictures;
    std::ostringstream script;
    script << "# Draws the results beside it: gnuplot curves.gp\n";
    for (const PathView& path : model.getPaths()) {
        pictures.push_back(folder / ("curves_" + toFileName(path.name) + ".svg"));
        writeCurves(path, result, pictures.back().filename().string(), script);
        if (path.start.empty()) continue;
        pictures.push_back(folder / ("start_" + toFileName(path.name) + ".svg"));
        writeStart(path, pictures.back().filename().string(), script);
    }
    writeWhole(script.str(), folder / "curves.gp");
    said = runGnuplot(folder, "curves.gp");
    return pictures;
}

}  // namespace tautline
