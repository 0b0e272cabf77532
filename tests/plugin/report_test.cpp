// SPDX-License-Identifier: Apache-2.0
/** The page of a run: what is in it, and that it works in a browser where one is installed. */
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "html_report.h"
#include "program_support.h"
#include "report_assets.h"

namespace {

using namespace tautline;
using namespace tautline::testing;

/** A page of a run, or nothing where its libraries were missing at build time. */
class Report : public ::testing::Test {
protected:
    void SetUp() override {
        if (!*report::kThree || !*report::kChart) GTEST_SKIP() << "built without libjs-three or libjs-chart.js";
    }

    std::string makePage(const std::string& model, const std::string& options) {
        m_folder = makeFolder("report");
        const std::string file = m_folder.string() + "/page.html";
        const Outcome outcome =
            runTautline("run " + model + " --out " + m_folder.string() + " --report " + file + " " + options);
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
    const std::string page = makePage(kElbow, "--duration 0.5");
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
            const std::string name = "/forceset/" + data["paths"][p]["name"].get<std::string>();
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
        const std::string name = data["paths"][curve["path"].get<std::size_t>()]["name"];
        const std::size_t column = findColumn(paths, "/forceset/" + name + "|length");
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(curve["least"].get<double>() + values[i] * curve["step"].get<double>(), paths.rows[i][column],
                        1e-6);
    }
    EXPECT_EQ(data["table"].size(), data["paths"].size());
    const std::string events = readAll(m_folder / "events.csv");
    EXPECT_EQ(static_cast<long>(data["events"].size()), std::count(events.begin(), events.end(), '\n') - 1);
}

TEST_F(Report, NamesCannotBreakThePage) {
    std::string model = readAll(kElbow);
    const std::size_t at = model.find("<Model name=\"") + 13;
    model.replace(at, model.find('"', at) - at, "&lt;/script>&lt;b>@DATA@ \\ &quot;");
    const std::string page = makePage(writeInput("odd_name.osim", model).string(), "--duration 0.02");
    EXPECT_EQ(readData(page)["title"], "</script><b>@DATA@ \\ \"");
    EXPECT_NE(page.find("<title>&lt;/script>&lt;b>@DATA@"), std::string::npos);
}

/** The page with a script behind it that tries it out and writes what it finds into the page. */
TEST_F(Report, WorksInABrowser) {
    std::string output;
    if (runProgram("command -v chromium", output) != 0) GTEST_SKIP() << "chromium is not installed";
    std::string page = makePage(kElbow, "--duration 0.5");
    page.insert(page.find("<script>"),
                "<script>window.errors = []; window.onerror = (m) => { errors.push(m); };"
                "console.error = (m) => { errors.push(String(m)); };</script>");
    page.insert(page.rfind("</body>"), R"(<script>
        const at = () => Array.from(tautline.lines[0].geometry.attributes.position.array.slice(0, 12)).join();
        const results = {};
        const before = at(), slider = document.getElementById("slider");
        slider.value = 30;
        slider.dispatchEvent(new Event("input"));
        results.moved = before !== at() && document.getElementById("clock").value === "0.300 s";
        const chart = tautline.getChart();
        chart.hide(0);
        results.hidden = !chart.isDatasetVisible(0) && chart.isDatasetVisible(1);
        const quantity = document.getElementById("quantity");
        quantity.value = "tension [N]";
        quantity.dispatchEvent(new Event("change"));
        results.switched = tautline.getChart().options.scales.y.title.text === "tension [N]";
        results.triangles = tautline.renderer.info.render.triangles;
        results.rows = document.querySelectorAll("tbody tr").length;
        results.errors = errors;
        const told = document.createElement("pre");
        told.textContent = "RESULTS" + JSON.stringify(results) + "END";
        document.body.appendChild(told);
    </script>)");
    const std::filesystem::path file = m_folder / "tried.html";
    std::ofstream(file) << page;
    output.clear();
    runProgram(
        "timeout 120 chromium --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle "
        "--use-angle=swiftshader --enable-unsafe-swiftshader --user-data-dir=" +
            (m_folder / "browser").string() + " --window-size=1280,900 --dump-dom file://" + file.string(),
        output);
    const std::size_t first = output.rfind("RESULTS{");
    ASSERT_NE(first, std::string::npos) << output.substr(0, 2000);
    const nlohmann::json results =
        nlohmann::json::parse(output.substr(first + 7, output.find("END", first) - first - 7));
    EXPECT_TRUE(results["moved"]) << results;
    EXPECT_TRUE(results["hidden"]) << results;
    EXPECT_TRUE(results["switched"]) << results;
    EXPECT_GT(results["triangles"].get<int>(), 100) << results;
    EXPECT_EQ(results["rows"], 6) << results;
    EXPECT_TRUE(results["errors"].empty()) << results;
}

}  // namespace
