// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "tautline/surfaces/solid_fit.h"

namespace tautline {

/** `tautline fit`: a smooth surface from a mesh, its file and the element for a model, and how far it is off. */
struct FitCommand {
    std::filesystem::path meshFile, outFile;
    std::filesystem::path report;  ///< a page to look at the fit of a bone; empty: none
    bool isBone = false;
    double width = 0, spacing = 0;  ///< [m]; 0: chosen
    double gap = 0;                 ///< [m]: those narrower are closed first; 0: none
    std::string patch;              ///< kind: an order, or numbers of control points such as 8x6; empty: a bone
    std::vector<double> toward;     ///< direction that the patch faces; empty: found
    std::vector<double> box;        ///< that holds the patch: least and greatest x, y, z [m]; empty: all of the mesh
    double unit = 1;                ///< of the mesh's file [m]

    /** Declares the options in a subcommand. */
    void declare(CLI::App& app);

    /** @return exit code 0. Throws std::exception for a mesh that cannot be read or fitted, or a file that cannot be
    written. */
    int run(std::ostream& out) const;

private:
    void fitBone(const TriangleMesh& mesh, std::ostream& out) const;
    void writeFitPage(const SolidFit& fit, std::ostream& out) const;
    void fitPatch(const TriangleMesh& mesh, std::ostream& out) const;
};

}  // namespace tautline
