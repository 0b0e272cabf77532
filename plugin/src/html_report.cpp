// SPDX-License-Identifier: Apache-2.0
#include "html_report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>

#include "report_assets.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/surface_mesh.h"

namespace tautline {
namespace {

/** The largest whole number of 16 bits. */
constexpr double kMost = 32767;
/** Arcs turn by so much between points [rad]. */
constexpr double kMaxAngle = 0.15;
/** How far surfaces without end are drawn around where they are touched, in their sizes. */
constexpr double kExtent = 2.0;

/** A text as JSON has it, which may stand in a script. */
std::string quote(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (c == '<')
            quoted += "\\u003c";  // no </script> in a script
        else if (static_cast<unsigned char>(c) < 0x20)
            quoted += ' ';
        else
            quoted += c;
    }
    return quoted + "\"";
}

/** A number with as many digits as a curve shows; null where it is none. */
std::string toNumber(double number, int digits = 6) {
    if (!std::isfinite(number)) return "null";
    std::ostringstream text;
    text.precision(digits);
    text << number;
    return text.str();
}

/** Makes a list of what has been added, in brackets. */
class JsonList {
public:
    void add(const std::string& item) { m_items += (m_items.empty() ? "" : ",") + item; }
    std::string get() const { return "[" + m_items + "]"; }

private:
    std::string m_items;
};

/** The bytes of numbers in base 64, in quotes: a third of what digits take. */
template <class Number>
std::string encode(const std::vector<Number>& numbers) {
    static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    const std::size_t size = numbers.size() * sizeof(Number);
    std::string text = "\"";
    for (std::size_t i = 0; i < size; i += 3) {
        const unsigned group =
            bytes[i] << 16 | (i + 1 < size ? bytes[i + 1] << 8 : 0) | (i + 2 < size ? bytes[i + 2] : 0);
        text += kDigits[group >> 18];
        text += kDigits[group >> 12 & 63];
        text += i + 1 < size ? kDigits[group >> 6 & 63] : '=';
        text += i + 2 < size ? kDigits[group & 63] : '=';
    }
    return text + "\"";
}

std::int16_t toWhole(double number, double unit) {
    return std::isfinite(number) ? static_cast<std::int16_t>(std::lround(number / unit)) : std::int16_t(0);
}

/** Column by column, as the page's library wants it. */
std::string toMatrix(const SimTK::Transform& X) {
    const SimTK::Mat44 matrix = X.toMat44();
    JsonList list;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.add(toNumber(matrix(row, column)));
    return list.get();
}

/** The page with each @NAME@ of its own in its place; what is put there is left as it is. */
std::string fill(const std::string& page, const std::map<std::string, std::string>& parts) {
    std::string filled;
    std::size_t at = 0;
    while (at < page.size()) {
        const std::size_t begin = page.find('@', at), end = page.find('@', begin + 1);
        if (begin == std::string::npos || end == std::string::npos) break;
        filled += page.substr(at, begin - at) + parts.at(page.substr(begin + 1, end - begin - 1));
        at = end + 1;
    }
    return filled + page.substr(at);
}

/** As text between tags. */
std::string escape(std::string text) {
    std::string escaped;
    for (const char c : text) escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return escaped;
}

}  // namespace

ReportRecorder::ReportRecorder(const models::ModelSystem& model, const Vec3& gravity)
    : m_model(model),
      m_up(gravity.isZero() ? Vec3(Vec3::UnitY()) : Vec3(-gravity.normalized())),
      m_paths(model.getPaths()) {
    if (!*report::kThree || !*report::kControls || !*report::kChart)
        throw std::runtime_error(
            "--report: this program was built without the libraries of the page (Debian: libjs-three, libjs-chart.js)");
    for (const auto& path : m_paths) {
        m_obstacles.emplace_back();
        for (CableElementIndex e(0); e < path.cable.getNumElements(); ++e)
            if (path.cable.isObstacle(e)) m_obstacles.back().push_back({e, findSurface(path.cable, e)});
    }
}

std::size_t ReportRecorder::findSurface(const Cable& cable, CableElementIndex element) {
    const Surface wanted{cable.getElementBody(element), cable.getElementFrame(element), cable.getSurface(element), {}};
    const auto isSame = [&](const Surface& other) {
        return other.surface == wanted.surface && other.body == wanted.body &&
               other.X_BS.toMat44() == wanted.X_BS.toMat44();
    };
    const auto found = std::find_if(m_surfaces.begin(), m_surfaces.end(), isSame);
    if (found != m_surfaces.end()) return static_cast<std::size_t>(found - m_surfaces.begin());
    m_surfaces.push_back(wanted);
    return m_surfaces.size() - 1;
}

ReportRecorder::Path ReportRecorder::recordPath(const SimTK::State& state, std::size_t path,
                                                std::vector<bool>& isTouched) {
    const Cable& cable = m_paths[path].cable;
    Path recorded;
    if (cable.isDisabled(state)) return recorded;
    recorded.points_G = cable.calcDrawingPoints(state, kMaxAngle);
    std::size_t next = 0;
    const auto findNext = [&](const SimTK::Vec3& p) {
        const auto begin = recorded.points_G.begin();
        const auto isNearer = [&p](const auto& a, const auto& b) { return (p - a).normSqr() < (p - b).normSqr(); };
        const auto nearest =
            std::min_element(begin + static_cast<std::ptrdiff_t>(next), recorded.points_G.end(), isNearer);
        return static_cast<std::size_t>(nearest - begin);
    };
    for (const Obstacle& obstacle : m_obstacles[path]) {
        SimTK::Vec3 P_G, Q_G;
        if (!cable.getContactPoints(state, obstacle.element, P_G, Q_G)) continue;
        isTouched[obstacle.surface] = true;
        Surface& surface = m_surfaces[obstacle.surface];
        const SimTK::Transform X_GS =
            cable.getMatterSubsystem().getMobilizedBody(surface.body).getBodyTransform(state) * surface.X_BS;
        if (m_frames.size() % 10 == 0) surface.touched_S.push_back(toEigen(X_GS.shiftBaseStationToFrame(P_G)));
        const std::size_t first = findNext(P_G);
        next = first;
        next = findNext(Q_G);
        recorded.arcs.push_back({first, next});
    }
    return recorded;
}

void ReportRecorder::recordFrame(const SimTK::State& state) {
    const SimTK::SimbodyMatterSubsystem& matter = m_model.getModel().getMatter();
    Frame frame;
    frame.time = state.getTime();
    for (SimTK::MobilizedBodyIndex body(0); body < matter.getNumBodies(); ++body)
        frame.X_GB.push_back(matter.getMobilizedBody(body).getBodyTransform(state));
    std::vector<bool> isTouched(m_surfaces.size(), false);
    for (std::size_t i = 0; i < m_paths.size(); ++i) frame.paths.push_back(recordPath(state, i, isTouched));
    for (std::size_t s = 0; s < isTouched.size(); ++s)
        if (isTouched[s]) frame.touched.push_back(s);
    m_frames.push_back(std::move(frame));
}

double ReportRecorder::calcUnit() const {
    double most = 1e-3;
    for (const Frame& frame : m_frames)
        for (const Path& path : frame.paths)
            for (const SimTK::Vec3& point : path.points_G)
                for (int i = 0; i < 3; ++i)
                    if (std::isfinite(point[i])) most = std::max(most, std::abs(point[i]));
    return most / kMost;
}

std::string ReportRecorder::describeFrames(double unit) const {
    JsonList frames;
    for (const Frame& frame : m_frames) {
        std::vector<float> bodies;  // three columns of the rotation, then the origin
        for (const SimTK::Transform& X_GB : frame.X_GB)
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 3; ++row) bodies.push_back(static_cast<float>(X_GB.toMat34()(row, column)));
        JsonList paths, arcs, touched;
        for (const Path& path : frame.paths) {
            std::vector<std::int16_t> points;
            for (const SimTK::Vec3& point : path.points_G)
                for (int i = 0; i < 3; ++i) points.push_back(toWhole(point[i], unit));
            paths.add(encode(points));
            JsonList ranges;
            for (const Range& arc : path.arcs)
                ranges.add("[" + std::to_string(arc[0]) + "," + std::to_string(arc[1]) + "]");
            arcs.add(ranges.get());
        }
        for (const std::size_t surface : frame.touched) touched.add(std::to_string(surface));
        frames.add("{\"t\":" + toNumber(frame.time, 9) + ",\"bodies\":" + encode(bodies) + ",\"paths\":" + paths.get() +
                   ",\"arcs\":" + arcs.get() + ",\"touched\":" + touched.get() + "}");
    }
    return frames.get();
}

std::string ReportRecorder::describeSurfaces() const {
    JsonList surfaces;
    for (const Surface& surface : m_surfaces) {
        const SurfaceMesh mesh =
            calcSurfaceMesh(*surface.surface, kExtent * surface.surface->getSize(), surface.touched_S);
        double most = 1e-3;
        for (const Vec3& point : mesh.points) most = std::max(most, point.cwiseAbs().maxCoeff());
        const double unit = most / kMost;
        std::vector<std::int16_t> points;
        for (const Vec3& point : mesh.points)
            for (int i = 0; i < 3; ++i) points.push_back(toWhole(point[i], unit));
        std::vector<std::uint32_t> corners;
        std::vector<std::uint16_t> shortCorners;
        for (const auto& face : mesh.faces)
            for (const int corner : face) {
                corners.push_back(static_cast<std::uint32_t>(corner));
                shortCorners.push_back(static_cast<std::uint16_t>(corner));
            }
        const bool isShort = mesh.points.size() < 65536;
        surfaces.add("{\"body\":" + std::to_string(surface.body) + ",\"pose\":" + toMatrix(surface.X_BS) +
                     ",\"unit\":" + toNumber(unit) + ",\"points\":" + encode(points) +
                     ",\"short\":" + (isShort ? "true" : "false") +
                     ",\"faces\":" + (isShort ? encode(shortCorners) : encode(corners)) + "}");
    }
    return surfaces.get();
}

std::string ReportRecorder::describeCurves(const SimulationResult& result) const {
    JsonList curves;
    const auto addColumn = [&](const StorageTable& table, std::size_t column, std::size_t path,
                               const std::string& quantity, const std::string& of) {
        // Steps of a 65535th of the curve's range; the largest whole number stands for what is none.
        double least = kInfinity, most = -kInfinity;
        for (const auto& row : table.rows)
            if (std::isfinite(row[column])) least = std::min(least, row[column]), most = std::max(most, row[column]);
        if (!(least <= most) || (least == 0 && most == 0)) return;
        const double step = most > least ? (most - least) / 65534 : 1.0;
        std::vector<std::uint16_t> values;
        for (const auto& row : table.rows)
            values.push_back(std::isfinite(row[column])
                                 ? static_cast<std::uint16_t>(std::lround((row[column] - least) / step))
                                 : std::uint16_t(65535));
        curves.add("{\"path\":" + std::to_string(path) + ",\"quantity\":" + quote(quantity) + ",\"of\":" + quote(of) +
                   ",\"least\":" + toNumber(least, 9) + ",\"step\":" + toNumber(step, 9) +
                   ",\"values\":" + encode(values) + "}");
    };
    const std::pair<const char*, const char*> quantities[] = {{"length", "length [m]"},
                                                              {"rate", "rate [m/s]"},
                                                              {"tension", "tension [N]"},
                                                              {"moment_arm", "moment arm [m]"},
                                                              {"distance", "clearance of obstacles [m]"}};
    for (const auto& [key, quantity] : quantities)
        for (const StorageTable* table : {&result.paths, &result.clearances})
            for (std::size_t column = 1; column < table->labels.size(); ++column)
                for (std::size_t path = 0; path < m_paths.size(); ++path) {
                    const std::string begin = m_paths[path].path + "|" + key, &label = table->labels[column];
                    if (label != begin && label.rfind(begin + ".", 0) != 0) continue;
                    const std::string of = label == begin ? "" : label.substr(begin.size() + 1);
                    addColumn(*table, column, path, quantity, of);
                }
    return curves.get();
}

std::string ReportRecorder::describeTable(const SimulationResult& result) const {
    JsonList table;
    for (std::size_t i = 0; i < m_paths.size(); ++i) {
        const PathSummary& summary = result.summaries[i];
        const Cable& cable = m_paths[i].cable;
        const std::string words =
            summary.firstDegradation.empty() ? "a local minimum in every step" : "first " + summary.firstDegradation;
        table.add("{\"name\":" + quote(m_paths[i].name) +
                  ",\"length\":" + toNumber(cable.getLength(result.finalState)) +
                  ",\"rate\":" + toNumber(cable.getLengthRate(result.finalState)) +
                  ",\"tension\":" + toNumber(m_paths[i].force.getTension(result.finalState)) +
                  ",\"made\":" + std::to_string(summary.contactsMade) +
                  ",\"lost\":" + std::to_string(summary.contactsLost) + ",\"slips\":" + std::to_string(summary.slips) +
                  ",\"degraded\":" + std::to_string(summary.degradedSteps) + ",\"words\":" + quote(words) + "}");
    }
    return table.get();
}

std::string ReportRecorder::describeEvents(const SimulationResult& result) const {
    JsonList events;
    std::istringstream lines(result.events);
    std::string line;
    std::getline(lines, line);  // the labels
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string time, path, obstacle, kind;
        std::getline(std::getline(std::getline(std::getline(cells, time, ','), path, ','), obstacle, ','), kind, ',');
        events.add("{\"t\":" + time + ",\"path\":" + quote(path.substr(path.rfind('/') + 1)) +
                   ",\"obstacle\":" + quote(obstacle) + ",\"kind\":" + quote(kind) + "}");
    }
    return events.get();
}

std::string ReportRecorder::makePage(const std::string& title, const std::string& summary,
                                     const SimulationResult& result) const {
    JsonList bodies, paths, up;
    const double unit = calcUnit();
    for (int body = 0; body < m_model.getModel().getMatter().getNumBodies(); ++body) bodies.add(std::to_string(body));
    for (const auto& path : m_paths) paths.add("{\"name\":" + quote(path.name) + "}");
    for (int i = 0; i < 3; ++i) up.add(toNumber(m_up[i]));
    const std::string data = "{\"title\":" + quote(title) + ",\"summary\":" + quote(summary) + ",\"up\":" + up.get() +
                             ",\"bodies\":" + bodies.get() + ",\"surfaces\":" + describeSurfaces() +
                             ",\"paths\":" + paths.get() + ",\"unit\":" + toNumber(unit) +
                             ",\"frames\":" + describeFrames(unit) + ",\"curves\":" + describeCurves(result) +
                             ",\"table\":" + describeTable(result) + ",\"events\":" + describeEvents(result) + "}";
    const std::string licenses =
        std::string("three.js and OrbitControls.js\n") + report::kThreeLicense + "\nChart.js\n" + report::kChartLicense;
    return fill(report::kPage, {{"TITLE", escape(title)},
                                {"STYLE", report::kStyle},
                                {"LICENSES", escape(licenses)},
                                {"THREE", report::kThree},
                                {"CONTROLS", report::kControls},
                                {"CHART", report::kChart},
                                {"DATA", data},
                                {"SCRIPT", report::kScript}});
}

}  // namespace tautline
