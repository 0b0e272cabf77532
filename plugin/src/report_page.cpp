// SPDX-License-Identifier: Apache-2.0
#include "report_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>

#include "report_assets.h"

namespace tautline {
namespace {

/** The largest whole number of 16 bits. */
constexpr double kMost = 32767;

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
    void add(const std::string& item) {
        if (!m_items.empty()) m_items += ',';
        m_items += item;
    }
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

/** The unit [m] in which points are whole numbers. */
class Unit {
public:
    void hold(const Vector3& point) {
        if (point.allFinite()) m_most = std::max(m_most, point.cwiseAbs().maxCoeff());
    }
    double get() const { return m_most / kMost; }

private:
    double m_most = 1e-3;
};

std::string encodePoints(const std::vector<Vector3>& points, double unit) {
    std::vector<std::int16_t> numbers;
    numbers.reserve(3 * points.size());
    for (const Vector3& point : points)
        for (int i = 0; i < 3; ++i) numbers.push_back(toWhole(point[i], unit));
    return encode(numbers);
}

/** Where each body is, in units, and its quaternion, in 32767ths. */
std::string encodePoses(const std::vector<SimTK::Transform>& poses, double unit) {
    std::vector<std::int16_t> numbers;
    for (const SimTK::Transform& X : poses) {
        const SimTK::Quaternion turn = X.R().convertRotationToQuaternion();  // the real part first
        for (int i = 0; i < 3; ++i) numbers.push_back(toWhole(X.p()[i], unit));
        for (int i = 0; i < 4; ++i) numbers.push_back(toWhole(turn[i], 1 / kMost));
    }
    return encode(numbers);
}

/** Column by column, as the page's library wants it. */
std::string toMatrix(const SimTK::Transform& X) {
    const SimTK::Mat44 matrix = X.toMat44();
    JsonList list;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.add(toNumber(matrix(row, column)));
    return list.get();
}

std::string encodeTriangles(const ReportPage::Mesh& mesh, bool isShort) {
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : mesh.triangles)
        for (const int corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
    return isShort ? encode(std::vector<std::uint16_t>(corners.begin(), corners.end())) : encode(corners);
}

/** In 32767ths of the scale; null where there are none. */
std::string encodeValues(const std::vector<double>& values, double largest) {
    if (values.empty()) return "null";
    std::vector<std::int16_t> numbers;
    numbers.reserve(values.size());
    for (const double value : values) numbers.push_back(toWhole(std::clamp(value, -largest, largest), largest / kMost));
    return encode(numbers);
}

std::string describeMeshes(const std::vector<ReportPage::Mesh>& meshes, double largestValue) {
    JsonList list;
    for (const ReportPage::Mesh& mesh : meshes) {
        Unit unit;
        for (const Vector3& point : mesh.points_M) unit.hold(point);
        const bool isShort = mesh.points_M.size() < 65536;
        list.add("{\"body\":" + std::to_string(mesh.body) + ",\"pose\":" + toMatrix(mesh.X_BM) +
                 ",\"unit\":" + toNumber(unit.get(), 9) + ",\"points\":" + encodePoints(mesh.points_M, unit.get()) +
                 ",\"short\":" + (isShort ? "true" : "false") + ",\"faces\":" + encodeTriangles(mesh, isShort) +
                 ",\"values\":" + encodeValues(mesh.values, largestValue) + "}");
    }
    return list.get();
}

double calcUnit(const ReportPage& page) {
    Unit unit;
    for (const ReportPage::Frame& frame : page.frames) {
        for (const SimTK::Transform& X : frame.X_GB) unit.hold(Vector3(X.p()[0], X.p()[1], X.p()[2]));
        for (const ReportPage::Path& path : frame.paths)
            for (const Vector3& point : path.points_G) unit.hold(point);
    }
    return unit.get();
}

std::string describeFrame(const ReportPage::Frame& frame, double unit) {
    JsonList paths, arcs, touched;
    for (const ReportPage::Path& path : frame.paths) {
        paths.add(encodePoints(path.points_G, unit));
        JsonList ranges;
        for (const auto& arc : path.arcs) ranges.add("[" + std::to_string(arc[0]) + "," + std::to_string(arc[1]) + "]");
        arcs.add(ranges.get());
    }
    for (const std::size_t surface : frame.touched) touched.add(std::to_string(surface));
    return "{\"t\":" + toNumber(frame.time, 9) + ",\"bodies\":" + encodePoses(frame.X_GB, unit) +
           ",\"paths\":" + paths.get() + ",\"arcs\":" + arcs.get() + ",\"touched\":" + touched.get() + "}";
}

std::string describeFrames(const ReportPage& page, double unit) {
    const std::size_t stride = (page.frames.size() + kMostFrames - 1) / kMostFrames;
    JsonList frames;
    for (std::size_t i = 0; i < page.frames.size(); i += stride) frames.add(describeFrame(page.frames[i], unit));
    return frames.get();
}

/** Nothing of a curve that is zero or none everywhere. */
void addCurve(const ReportPage::Curve& curve, JsonList& curves) {
    double least = kInfinity, most = -kInfinity;
    for (const double value : curve.values)
        if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    if (!(least <= most) || (least == 0 && most == 0)) return;
    // The largest whole number stands for what is none.
    const double step = most > least ? (most - least) / 65534 : 1.0;
    std::vector<std::uint16_t> values;
    for (const double value : curve.values)
        values.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(std::lround((value - least) / step))
                                              : std::uint16_t(65535));
    curves.add("{\"path\":" + std::to_string(curve.path) + ",\"quantity\":" + quote(curve.quantity) +
               ",\"of\":" + quote(curve.of) + ",\"least\":" + toNumber(least, 9) + ",\"step\":" + toNumber(step, 9) +
               ",\"values\":" + encode(values) + "}");
}

std::string describeCurves(const ReportPage& page) {
    JsonList curves;
    for (const ReportPage::Curve& curve : page.curves) addCurve(curve, curves);
    return curves.get();
}

std::string describeEvents(const ReportPage& page) {
    JsonList events;
    for (const ReportPage::Event& event : page.events)
        events.add("{\"t\":" + toNumber(event.time, 9) + ",\"path\":" + quote(event.path) +
                   ",\"obstacle\":" + quote(event.obstacle) + ",\"kind\":" + quote(event.kind) + "}");
    return events.get();
}

std::string describeWords(const std::vector<std::string>& words) {
    JsonList list;
    for (const std::string& word : words) list.add(quote(word));
    return list.get();
}

std::string describeRows(const ReportPage& page) {
    JsonList rows;
    for (const ReportPage::Row& row : page.rows)
        rows.add("{\"fault\":" + std::string(row.isFault ? "true" : "false") +
                 ",\"cells\":" + describeWords(row.cells) + "}");
    return rows.get();
}

std::string describe(const ReportPage& page) {
    const double unit = calcUnit(page);
    JsonList up, times;
    for (int i = 0; i < 3; ++i) up.add(toNumber(page.up[i]));
    for (const double time : page.curveTimes) times.add(toNumber(time, 9));
    return "{\"title\":" + quote(page.title) + ",\"summary\":" + quote(page.summary) + ",\"up\":" + up.get() +
           ",\"surfaces\":" + describeMeshes(page.surfaces, page.largestValue) +
           ",\"bones\":" + describeMeshes(page.bones, page.largestValue) + ",\"valueName\":" + quote(page.valueName) +
           ",\"largestValue\":" + toNumber(page.largestValue, 3) + ",\"paths\":" + describeWords(page.paths) +
           ",\"unit\":" + toNumber(unit, 9) + ",\"frames\":" + describeFrames(page, unit) +
           ",\"times\":" + times.get() + ",\"curves\":" + describeCurves(page) + ",\"events\":" + describeEvents(page) +
           ",\"headings\":" + describeWords(page.headings) + ",\"rows\":" + describeRows(page) + "}";
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

void requireReportAssets() {
    if (!*report::kThree || !*report::kControls || !*report::kLines || !*report::kChart)
        throw std::runtime_error(
            "--report: this program was built without the libraries of the page (Debian: libjs-three, libjs-chart.js)");
}

std::string writePage(const ReportPage& page) {
    const std::string licenses = std::string("three.js, OrbitControls.js and LineSegments2.js\n") +
                                 report::kThreeLicense + "\nChart.js\n" + report::kChartLicense;
    return fill(report::kPage, {{"TITLE", escape(page.title)},
                                {"STYLE", report::kStyle},
                                {"LICENSES", escape(licenses)},
                                {"THREE", report::kThree},
                                {"CONTROLS", report::kControls},
                                {"LINES", report::kLines},
                                {"CHART", report::kChart},
                                {"DATA", describe(page)},
                                {"SCRIPT", report::kScript}});
}

}  // namespace tautline
