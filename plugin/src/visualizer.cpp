// SPDX-License-Identifier: Apache-2.0
#include "visualizer.h"

#include <dlfcn.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tautline/simbody/conversions.h"

namespace tautline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameVariable = "SIMBODY_VISUALIZER_NAME";

std::string getProgram() {
    const char* name = std::getenv(kNameVariable);
    return name ? name : "simbody-visualizer";
}

/** Where Simbody's library is; empty where it cannot be told. */
fs::path findLibraryFolder() {
    Dl_info info{};
    const auto symbol = reinterpret_cast<void*>(&SimTK_version_simbody);
    return dladdr(symbol, &info) && info.dli_fname ? fs::path(info.dli_fname).parent_path() : fs::path();
}

std::vector<fs::path> listFolders() {
    std::vector<fs::path> folders{SimTK::Pathname::getThisExecutableDirectory()};
    if (const char* home = std::getenv("SIMBODY_HOME"))
        folders.insert(folders.end(), {fs::path(home) / "libexec/simbody", fs::path(home) / "bin"});
    const fs::path library = findLibraryFolder();
    if (!library.empty())
        folders.insert(folders.end(), {library / "simbody/libexec", library / "../libexec/simbody",
                                       library / "../../libexec/simbody"});
    return folders;
}

SimTK::DecorativeMesh makeDecoration(const ReportPage::Mesh& mesh) {
    SimTK::PolygonalMesh polygons;
    for (const Vector3& point : mesh.points_M) polygons.addVertex(toSimTK(point));
    for (const auto& triangle : mesh.triangles) polygons.addFace(SimTK::Array_<int>{triangle.begin(), triangle.end()});
    return SimTK::DecorativeMesh(polygons);
}

}  // namespace

fs::path findVisualizer() {
    // Simbody itself waits forever for a visualizer that is not there, and dies with one that finds no display.
    const std::string program = getProgram();
    std::string searched;
    std::error_code ignored;
    for (const fs::path& folder : listFolders()) {
        searched += (searched.empty() ? "" : ", ") + folder.lexically_normal().string();
        if (!fs::is_regular_file(folder / program, ignored)) continue;
        if (!std::getenv("DISPLAY"))
            throw std::runtime_error("--visualize: there is no display to show a window on (DISPLAY is not set)");
        return folder;
    }
    throw std::runtime_error("--visualize: there is no " + program + " in " + searched +
                             "; Debian has it in libsimbody-dev, SIMBODY_HOME says where else Simbody is");
}

RunVisualizer::RunVisualizer(const models::ModelSystem& model, const fs::path& folder,
                             const std::vector<ReportPage::Mesh>& bones) {
    std::signal(SIGPIPE, SIG_IGN);  // the user may close the window at any time
    // Where Simbody's library has its asserts, as Debian's, it would look for simbody-visualizer_d, which nobody
    // installs.
    ::setenv(kNameVariable, getProgram().c_str(), 0);
    m_visualizer =
        std::make_unique<SimTK::Visualizer>(model.getSystem(), SimTK::Array_<SimTK::String>{folder.string()});
    for (const ReportPage::Mesh& bone : bones)
        m_visualizer->addDecoration(SimTK::MobilizedBodyIndex(bone.body), bone.X_BM, makeDecoration(bone));
}

RunVisualizer::~RunVisualizer() = default;

void RunVisualizer::show(const SimTK::State& state) {
    if (!m_visualizer) return;
    try {
        m_visualizer->report(state);
    } catch (const std::exception&) {
        // The window is closed. What served it would write to it once more at its end, and stays.
        static_cast<void>(m_visualizer.release());
    }
}

}  // namespace tautline
