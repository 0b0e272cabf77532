// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <array>
#include <string>
#include <vector>

#include "tautline/types.h"

namespace tautline {

/** What the page of a run or a motion shows, as plain data: bodies, surfaces and paths in 3D frame by frame, curves,
events, and a table. SI units, ground's axes unless a suffix says otherwise. */
struct ReportPage {
    /** Triangles on a body. */
    struct Mesh {
        int body = 0;  ///< index into Frame::X_GB
        SimTK::Transform X_BM;
        std::vector<Vector3> points_M;
        std::vector<std::array<int, 3>> triangles;
        std::vector<double> values = {};  ///< of its points, shown as colors; none: it has one color
    };
    struct Path {
        std::vector<Vector3> points_G;                 ///< none: the path is not drawn in this frame
        std::vector<std::array<std::size_t, 2>> arcs;  ///< first and last point of each
    };
    struct Frame {
        double time = 0;
        std::vector<SimTK::Transform> X_GB;
        std::vector<Path> paths;
        std::vector<std::size_t> touched;  ///< indices of surfaces
    };
    struct Curve {
        std::size_t path = 0;
        std::string quantity;        ///< with its unit; curves of one quantity are shown together
        std::string of;              ///< an obstacle or a coordinate; may be empty
        std::vector<double> values;  ///< at curveTimes; NaN where there is none
    };
    struct Event {
        double time = 0;
        std::string path, obstacle, kind;
    };
    struct Row {
        std::vector<std::string> cells;  ///< under the headings
        bool isFault = false;
    };

    std::string title, summary;
    Vector3 up = Vector3::UnitY();
    std::vector<std::string> paths;  ///< their names
    std::vector<Mesh> surfaces, bones;
    std::string valueName;       ///< what the colors of bones show, with its unit
    double largestValue = kNaN;  ///< the end of the scale of colors, which begins at its negative
    std::vector<Frame> frames;
    std::vector<double> curveTimes;
    std::vector<Curve> curves;
    std::vector<Event> events;
    /** The first and the last one are left-aligned words. */
    std::vector<std::string> headings;
    std::vector<Row> rows;
};

/** @throws std::runtime_error if the page's libraries were missing when the program was built */
void requireReportAssets();

/** The page as HTML, which needs nothing but itself. Of more than kMostFrames frames it shows every second, third, ...;
curves are whole. Points are rounded to whole numbers of 16 bits, curves to a 65535th of their range. */
inline constexpr std::size_t kMostFrames = 600;
std::string writePage(const ReportPage& page);

}  // namespace tautline
