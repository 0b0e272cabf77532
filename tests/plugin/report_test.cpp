// SPDX-License-Identifier: Apache-2.0
/** The page of a run or of poses: what is in it, and that it works in a browser where one is installed. */
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "program_support.h"
#include "report_assets.h"
#include "support/shared_data.h"
#include "tautline/types.h"

namespace {

using namespace tautline;
using namespace tautline::testing;

/** A page of a run, or nothing where its libraries were missing at build time. */
class Report : public ::testing::Test {
public:
    void SetUp() override {
        if (!*report::kThree || !*report::kChart) GTEST_SKIP() << "built without libjs-three or libjs-chart.js";
    }

    /** @param command   run or solve, with the model and options */
    std::string makePage(const std::string& command) {
        m_folder = makeFolder("report");
        const std::string file = m_folder.string() + "/page.html";
        const Outcome outcome = runTautline(command + " --out " + m_folder.string() + " --report " + file);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
        EXPECT_TRUE(outcome.has("page: " + file)) << outcome.text;
        return readAll(file);
    }

    static nlohmann::json readData(const std::string& page) {
        const std::string begin = "<script>const report = ", end = ";</script>";
        const std::size_t first = page.find(begin) + begin.size();
        return nlohmann::json::parse(page.substr(first, page.find(end, first) - first));
    }

    /** Numbers from their bytes in base 64. */
    template <class Number>
    static std::vector<Number> decode(const std::string& text) {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string bytes;
        unsigned bits = 0;
        int numBits = 0;
        for (const char digit : text) {
            if (digit == '=') break;
            bits = bits << 6 | static_cast<unsigned>(digits.find(digit));
            numBits += 6;
            if (numBits < 8) continue;
            numBits -= 8;
            bytes += static_cast<char>(bits >> numBits & 255);
        }
        EXPECT_EQ(bytes.size() % sizeof(Number), 0u);
        std::vector<Number> numbers(bytes.size() / sizeof(Number));
        std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
        return numbers;
    }

    std::filesystem::path m_folder;
};

const std::string kElbow = TAUTLINE_SOURCE_DIR "/models/elbow.osim";

TEST_F(Report, HoldsWhatTheFilesOfTheRunSay) {
    const std::string page = makePage("run " + kElbow + " --duration 0.5");
    EXPECT_LT(page.size(), 6e6);
    for (const char* loads : {"<script src", "<link", "<img", "@import"})  // it opens without a net
        EXPECT_EQ(page.find(loads), std::string::npos) << loads;
    EXPECT_NE(page.find("MIT"), std::string::npos);  // the licenses of the libraries in it
    const nlohmann::json data = readData(page);
    const StorageTable paths = readStorage(m_folder / "paths.sto");
    ASSERT_EQ(data["frames"].size(), paths.rows.size());
    const double unit = data["unit"];
    int numArcs = 0;
    for (std::size_t i = 0; i < paths.rows.size(); i += 7) {
        const nlohmann::json& frame = data["frames"][i];
        EXPECT_NEAR(frame["t"].get<double>(), paths.rows[i][0], 1e-9);
        for (std::size_t p = 0; p < data["paths"].size(); ++p) {
            const std::string name = "/forceset/" + data["paths"][p].get<std::string>();
            const auto points = decode<std::int16_t>(frame["paths"][p]);
            double length = 0;  // of the polygon that is drawn: chords of arcs, rounded
            for (std::size_t k = 3; k + 2 < points.size(); k += 3)
                length += unit * std::hypot(points[k] - points[k - 3], points[k + 1] - points[k - 2],
                                            points[k + 2] - points[k - 1]);
            EXPECT_NEAR(length, paths.rows[i][findColumn(paths, name + "|length")], 1e-3) << name;
            for (const auto& arc : frame["arcs"][p]) {
                EXPECT_LE(arc[0].get<int>(), arc[1].get<int>());
                EXPECT_LT(arc[1].get<std::size_t>(), points.size() / 3);
                ++numArcs;
            }
        }
    }
    EXPECT_GT(numArcs, 0);
    for (const auto& curve : data["curves"]) {
        const auto values = decode<std::uint16_t>(curve["values"]);
        ASSERT_EQ(values.size(), paths.rows.size());
        if (curve["quantity"] != "length [m]") continue;
        const std::string name = data["paths"][curve["path"].get<std::size_t>()];
        const std::size_t column = findColumn(paths, "/forceset/" + name + "|length");
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(curve["least"].get<double>() + values[i] * curve["step"].get<double>(), paths.rows[i][column],
                        1e-6);
    }
    EXPECT_EQ(data["rows"].size(), data["paths"].size());
    const std::string events = readAll(m_folder / "events.csv");
    EXPECT_EQ(static_cast<long>(data["events"].size()), std::count(events.begin(), events.end(), '\n') - 1);
}

TEST_F(Report, NamesCannotBreakThePage) {
    std::string model = readAll(kElbow);
    const std::size_t at = model.find("<Model name=\"") + 13;
    model.replace(at, model.find('"', at) - at, "&lt;/script>&lt;b>@DATA@ \\ &quot;");
    const std::string page = makePage("run " + writeInput("odd_name.osim", model).string() + " --duration 0.02");
    EXPECT_EQ(readData(page)["title"], "</script><b>@DATA@ \\ \"");
    EXPECT_NE(page.find("<title>&lt;/script>&lt;b>@DATA@"), std::string::npos);
}

/** Pose of a body in a frame of the page. */
Pose getPose(const nlohmann::json& data, const std::vector<std::int16_t>& bodies, std::size_t body) {
    const std::int16_t* b = &bodies[7 * body];
    const double unit = data["unit"];
    return {Eigen::Quaterniond(b[3], b[4], b[5], b[6]).normalized().toRotationMatrix(),
            unit * Vector3(b[0], b[1], b[2])};
}

std::vector<Vector3> toPoints(const std::vector<std::int16_t>& numbers, double unit) {
    std::vector<Vector3> points;
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        points.push_back(unit * Vector3(numbers[k], numbers[k + 1], numbers[k + 2]));
    return points;
}

/** Laws of every page: the ends of a path stay where they are on some body, and arcs lie on surfaces that are marked as
touched. */
void checkScene(const nlohmann::json& data) {
    const auto& frames = data["frames"];
    const double unit = data["unit"];
    std::vector<std::vector<std::int16_t>> bodies;
    for (const auto& frame : frames) bodies.push_back(Report::decode<std::int16_t>(frame["bodies"]));
    for (std::size_t p = 0; p < data["paths"].size(); ++p)
        for (const bool isLast : {false, true}) {
            double best = kInfinity;
            for (std::size_t body = 0; body < bodies[0].size() / 7; ++body) {
                Eigen::AlignedBox3d box;
                for (std::size_t i = 0; i < frames.size(); ++i) {
                    const auto points = toPoints(Report::decode<std::int16_t>(frames[i]["paths"][p]), unit);
                    box.extend(getPose(data, bodies[i], body).shiftBack(isLast ? points.back() : points.front()));
                }
                best = std::min(best, box.diagonal().norm());
            }
            EXPECT_LT(best, 5e-4) << data["paths"][p] << (isLast ? " insertion" : " origin");
        }
    for (std::size_t i = 0; i < frames.size(); i += 10) {
        std::vector<Vector3> corners_G;
        for (const std::size_t s : frames[i]["touched"]) {
            const auto& surface = data["surfaces"][s];
            Eigen::Matrix4d X;
            for (int k = 0; k < 16; ++k) X(k % 4, k / 4) = surface["pose"][static_cast<std::size_t>(k)];
            const Pose X_GB = getPose(data, bodies[i], surface["body"]);
            for (const Vector3& point : toPoints(Report::decode<std::int16_t>(surface["points"]), surface["unit"]))
                corners_G.push_back(X_GB * Vector3(X.topLeftCorner<3, 3>() * point + X.topRightCorner<3, 1>()));
        }
        for (std::size_t p = 0; p < data["paths"].size(); ++p) {
            const auto points = toPoints(Report::decode<std::int16_t>(frames[i]["paths"][p]), unit);
            for (const auto& arc : frames[i]["arcs"][p]) {
                double nearest = kInfinity;
                for (const Vector3& corner : corners_G)
                    nearest = std::min(nearest, (corner - points[arc[0].get<std::size_t>()]).norm());
                EXPECT_LT(nearest, 0.01) << data["paths"][p] << " in frame " << i;  // facets are a few mm wide
            }
        }
    }
}

TEST_F(Report, PathsEndOnBodiesAndArcsLieOnTouchedSurfaces) {
    checkScene(readData(makePage("run " + kElbow + " --duration 0.5")));
}

const std::string kMotion =
    "motion\nversion=1\nnRows=4\nnColumns=2\ninDegrees=yes\nendheader\ntime\telbow_flexion\n"
    "0\t0\n1\t40\n2\t80\n3\t120\n";

TEST_F(Report, OfAMotionHoldsWhatTheFilesOfTheSolveSay) {
    const std::string motion = writeInput("flexion.mot", kMotion).string();
    const nlohmann::json data = readData(makePage("solve " + kElbow + " --motion " + motion));
    checkScene(data);
    ASSERT_EQ(data["frames"].size(), 4u);
    EXPECT_EQ(data["times"], nlohmann::json({0, 1, 2, 3}));
    EXPECT_EQ(data["rows"].size(), 6u);
    const StorageTable arms = readStorage(m_folder / "moment_arms.sto");
    int numArms = 0;
    bool hasWitness = false;
    for (const auto& curve : data["curves"]) {
        hasWitness |= curve["quantity"] == "witness of contacts [1]";
        if (curve["quantity"] != "moment arm [m/rad or 1]" || curve["of"] != "elbow_flexion") continue;
        const std::string path = "/forceset/" + data["paths"][curve["path"].get<std::size_t>()].get<std::string>();
        const std::size_t column = findColumn(arms, path + "|moment_arm.elbow_flexion");
        const auto values = decode<std::uint16_t>(curve["values"]);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(curve["least"].get<double>() + values[i] * curve["step"].get<double>(), arms.rows[i][column],
                        1e-6);
        ++numArms;
    }
    EXPECT_EQ(numArms, 6);
    EXPECT_TRUE(hasWitness);
    for (const auto& event : data["events"]) EXPECT_GT(event["t"].get<double>(), 0);
    EXPECT_GT(data["events"].size(), 0u);
}

TEST_F(Report, OfOnePoseTurnsTheForearmByItsAngle) {
    const nlohmann::json data = readData(makePage("solve " + kElbow + " --pose elbow_flexion=90deg"));
    ASSERT_EQ(data["frames"].size(), 1u);
    const auto bodies = decode<std::int16_t>(data["frames"][0]["bodies"]);
    const Pose forearm = getPose(data, bodies, bodies.size() / 7 - 1), upper = getPose(data, bodies, 1);
    const Eigen::AngleAxisd turn(Matrix3(upper.R.transpose() * forearm.R));
    EXPECT_NEAR(turn.angle(), kPi / 2, 2e-4);
}

TEST_F(Report, ResumedRunsHaveCurvesFromTheBeginningAndFramesFromThere) {
    const std::filesystem::path folder = makeFolder("report_resumed");
    const std::string run = "run " + kElbow + " --out " + folder.string();
    ASSERT_EQ(runTautline(run + " --duration 0.1").exitCode, 0);
    const Outcome outcome = runTautline(run + " --duration 0.2 --resume --report " + (folder / "page.html").string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    const nlohmann::json data = readData(readAll(folder / "page.html"));
    EXPECT_EQ(data["times"].size(), 21u);
    EXPECT_EQ(data["frames"].size(), 11u);
    for (const auto& curve : data["curves"]) EXPECT_EQ(decode<std::uint16_t>(curve["values"]).size(), 21u);
}

TEST_F(Report, LongRunsKeepAllOfTheirCurvesAndEverySoManyFrames) {
    const nlohmann::json data = readData(makePage("run " + kElbow + " --duration 0.7 --interval 0.001"));
    EXPECT_EQ(data["times"].size(), 701u);
    EXPECT_EQ(data["frames"].size(), 351u);
}

TEST_F(Report, SaysWhichBonesAreMissing) {
    std::string model = readAll(kElbow);
    const std::size_t at = model.find("</Body>");
    model.insert(at,
                 "<attached_geometry><Mesh name=\"m\"><mesh_file>nowhere.vtp</mesh_file></Mesh></attached_geometry>");
    const std::string file = writeInput("boned.osim", model).string();
    const Outcome outcome = runTautline("solve " + file + " --out " + makeFolder("boned").string() + " --report " +
                                        (makeFolder("boned") / "page.html").string());
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_TRUE(
        outcome.has("note: 1 of 1 bone meshes are not found and not drawn (--geometry FOLDER says where they "
                    "are): nowhere.vtp"))
        << outcome.text;
}

/** Three hundred frames of the full body walking, with the bones that there are. */
class DataReport : public Report {};

TEST_F(DataReport, OfAWalkingFullBodyStaysBelowSixMegabytes) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const std::filesystem::path data = shared / "data/opensim";
    std::string motion = readAll(data / "motions/example3DWalking_coordinates.sto");
    std::istringstream lines(motion);
    std::string line, cut;
    bool isData = false;
    for (int rows = 0; std::getline(lines, line) && rows <= 300; rows += isData) {
        cut += (line.rfind("nRows", 0) == 0 ? "nRows=300" : line) + "\n";
        isData |= line.rfind("time", 0) == 0;
    }
    const std::string page = makePage("solve " + (data / "models/Rajagopal2016.osim").string() + " --motion " +
                                      writeInput("walking.sto", cut).string() + " --allow-degraded --geometry " +
                                      (data / "geometry").string());
    EXPECT_LT(page.size(), 6e6);
    const nlohmann::json json = readData(page);
    EXPECT_EQ(json["frames"].size(), 300u);
    EXPECT_GE(json["bones"].size(), 4u);
    checkScene(json);
}

/** What the page does in headless Chromium at a width: it runs with a script behind it that tries it out and writes
what it finds into the page. */
nlohmann::json tryInBrowser(std::string page, const std::filesystem::path& folder, int width) {
    page.insert(page.find("<script>"),
                "<script>window.errors = []; window.onerror = (m) => { errors.push(m); };"
                "console.error = console.warn = (...m) => { errors.push(m.join(' ')); };</script>");
    page.insert(page.rfind("</body>"), R"(<script>
        const at = () => Array.from(tautline.lines.geometry.attributes.instanceStart.data.array.slice(0, 600)).join();
        const results = {};
        const before = at(), slider = document.getElementById("slider");
        const cursorAt = () => document.getElementById("cursor").style.left;
        const cursorBefore = cursorAt();
        slider.value = 30;
        slider.dispatchEvent(new Event("input"));
        results.moved = before !== at() && document.getElementById("clock").value === "0.300 s";
        results.cursorMoved = cursorBefore !== cursorAt();
        const entry = document.querySelector("#legend button");
        entry.click();
        results.hidden = !tautline.getChart().isDatasetVisible(0) && tautline.getChart().isDatasetVisible(1);
        entry.click();
        results.shown = tautline.getChart().isDatasetVisible(0);
        const quantity = document.getElementById("quantity");
        quantity.value = "tension [N]";
        quantity.dispatchEvent(new Event("change"));
        results.switched = tautline.getChart().options.scales.y.title.text === "tension [N]";
        document.querySelector("#eventlist button").click();
        results.jumped = slider.value !== "30";
        results.triangles = tautline.renderer.info.render.triangles;
        results.rows = document.querySelectorAll("tbody tr").length;
        results.fits = document.documentElement.scrollWidth <= window.innerWidth;
        results.width = window.innerWidth;
        const gl = tautline.renderer.getContext(), colors = new Set();
        const pixels = new Uint32Array(gl.drawingBufferWidth * gl.drawingBufferHeight);
        tautline.renderer.render(tautline.scene, tautline.camera);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE,
                      new Uint8Array(pixels.buffer));
        pixels.forEach((pixel) => colors.add(pixel));
        results.colors = colors.size;
        results.errors = errors;
        parent.postMessage(JSON.stringify(results), "*");
    </script>)");
    std::ofstream(folder / "tried.html") << page;
    // In a frame of that width: windows have a least one.
    const std::filesystem::path file = folder / "frame.html";
    std::ofstream(file)
        << "<body><script>onmessage = (event) => { document.body.append('RESULTS' + event.data + 'END'); "
           "};</script><iframe src='tried.html' style='height: 900px; border: 0; width: "
        << width << "px'></iframe></body>";
    std::string output;
    runProgram("timeout 120 " TAUTLINE_BROWSER
               " --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader "
               "--enable-unsafe-swiftshader --user-data-dir=" +
                   (folder / "browser").string() + " --window-size=1400,1000 --dump-dom file://" + file.string(),
               output);
    const std::size_t first = output.rfind("RESULTS{");
    EXPECT_NE(first, std::string::npos) << output.substr(0, 2000);
    if (first == std::string::npos) return {};
    return nlohmann::json::parse(output.substr(first + 7, output.find("END", first) - first - 7));
}

TEST_F(Report, WorksInABrowserOnAScreenAndOnAPhone) {
    if (!*TAUTLINE_BROWSER) GTEST_SKIP() << "neither chromium nor chromium-headless-shell was there at build time";
    const std::string page = makePage("run " + kElbow + " --duration 0.5");
    for (const int width : {1280, 390}) {
        SCOPED_TRACE(width);
        const nlohmann::json results = tryInBrowser(page, m_folder, width);
        ASSERT_FALSE(results.empty());
        for (const char* works : {"moved", "cursorMoved", "hidden", "shown", "switched", "jumped", "fits"})
            EXPECT_TRUE(results[works]) << works << ": " << results;
        EXPECT_EQ(results["width"], width);
        EXPECT_GT(results["triangles"].get<int>(), 100) << results;
        EXPECT_GT(results["colors"].get<int>(), 50) << results;
        EXPECT_EQ(results["rows"], 6) << results;
        EXPECT_TRUE(results["errors"].empty()) << results;
    }
}

}  // namespace
