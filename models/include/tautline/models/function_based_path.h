// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tautline/models/model_builder.h"

namespace tautline::models {

/** A path whose length is given as a function of coordinates, so that it can be compared with one that is laid out. It
cannot be pulled at. A light handle; the BuiltModel's matter subsystem must outlive it. */
class FunctionBasedPath {
public:
    FunctionBasedPath(PathFunctions functions, const BuiltModel& model);

    const std::vector<std::string>& getCoordinateNames() const { return m_functions.coordinates; }
    /** [m]. Stage: Model. */
    double calcLength(const SimTK::State& state) const;
    /** -dl/dq for each of getCoordinateNames(), couplers not followed: by the functions of the file if it has any, else
    from the length. Stage: Model. */
    std::vector<double> calcMomentArms(const SimTK::State& state) const;
    /** [m/s]. Stage: Model. */
    double calcLengthRate(const SimTK::State& state) const;

private:
    std::vector<double> getValues(const SimTK::State& state) const;
    std::vector<double> getSpeeds(const SimTK::State& state) const;

    PathFunctions m_functions;
    BuiltModel m_model;
};

/** The functions of a path of a model, by the path's owner. */
struct OwnedPathFunctions {
    /** As the file names it, such as /forceset/soleus_r. */
    std::string owner;
    PathFunctions functions;
};

/** Reads a file of FunctionBasedPaths that were fitted to the paths of a model.
@throws ModelError as readOsimFile() does */
std::vector<OwnedPathFunctions> readFunctionBasedPaths(const std::filesystem::path& file,
                                                       const ModelDescription& model);

}  // namespace tautline::models
