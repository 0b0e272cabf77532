// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/solid_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "surfaces/shape_checks.h"
#include "tautline/meshes/mesh_distance.h"

namespace tautline {
namespace {

constexpr int kBrick = SolidGrid::kBrick;
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kLeastWidth = 1 / 1.7, kMostWidth = 1.8;  ///< of the smoothing, in spacings
constexpr double kWidthOfSize = 0.2;                       ///< the most that is chosen: parts as thick as most stay
constexpr double kSpacingOfWidth = 1.5;                    ///< what is chosen: geodesics take steps of some cells
constexpr double kBlendBegin = 2, kBlendEnd = 4;           ///< heights, in spacings
constexpr double kFarSpacing = 4;                          ///< of the coarse lattice, in spacings of the fine one
constexpr double kMostFarCells = 64;                       ///< along the longest side of the mesh
constexpr std::size_t kMostControls = std::size_t(1) << 27;

using Index = std::array<int, 3>;

/** Calls a function with every index below the counts, the last one fastest. */
template <class Function>
void forEachIndex(const Index& counts, Function&& act) {
    for (int i = 0; i < counts[0]; ++i)
        for (int j = 0; j < counts[1]; ++j)
            for (int k = 0; k < counts[2]; ++k) act(Index{i, j, k});
}

Vector3 toVector(const Index& index) {
    return {double(index[0]), double(index[1]), double(index[2])};
}

/** Repeated smoothing with the weights (side, 1 - 2 side, side) along each axis: positive, of an exact variance. */
struct Kernel {
    int passes;
    double side;

    /** @param width   of the smoothing with what the B-splines themselves do (variance 1/3), in spacings */
    explicit Kernel(double width) {
        const double variance = std::max(0.0, width * width - 1.0 / 3);
        passes = static_cast<int>(std::ceil(2 * variance));
        side = passes > 0 ? variance / (2 * passes) : 0;
    }
};

/** Signed distances of a mesh at the points of the fine lattice, each computed when it is first asked for, kept in
bricks: (i, j, k) of a brick is its lowest point and those up to 7 steps on. */
class DistanceBricks {
public:
    DistanceBricks(const MeshDistance& distance, const Vector3& origin, double spacing)
        : m_distance(distance), m_origin(origin), m_spacing(spacing) {}

    /** Of a cube of lattice points. @param first   its lowest point, in steps from the origin @param side   in points
     */
    std::vector<double> getCube(const Index& first, int side) {
        std::vector<double> cube;
        const auto line = static_cast<std::size_t>(side);
        cube.reserve(line * line * line);
        forEachIndex({side, side, side}, [&](const Index& at) {
            const std::size_t back = at[2] > 0 ? 1 : at[1] > 0 ? line : line * line;
            const double neighbor = cube.size() >= back ? cube[cube.size() - back] : kInfinity;
            cube.push_back(getDistance({first[0] + at[0], first[1] + at[1], first[2] + at[2]}, neighbor));
        });
        return cube;
    }

private:
    /** @param at   a lattice point @param neighbor   what a point one step away has, infinite if that is not known */
    double getDistance(const Index& at, double neighbor) {
        Index brick;
        std::size_t within = 0;
        for (int axis = 0; axis < 3; ++axis) {
            brick[axis] = (at[axis] - (at[axis] < 0 ? kBrick - 1 : 0)) / kBrick;  // rounded down
            within = within * kBrick + static_cast<std::size_t>(at[axis] - brick[axis] * kBrick);
        }
        if (brick != m_last || m_values == nullptr) {
            m_values = &m_bricks.try_emplace(brick, kBrick * kBrick * kBrick, kNaN).first->second;
            m_last = brick;
        }
        double& value = (*m_values)[within];
        if (std::isnan(value)) value = calcDistance(m_origin + m_spacing * toVector(at), neighbor);
        return value;
    }

    /** @param neighbor   that of a point one step away, so no farther than a step off in distance, and on the same side
    if the mesh is farther from it than this point is */
    double calcDistance(const Vector3& p, double neighbor) const {
        constexpr double kRounding = 1 + 1e-9;
        const double within = kRounding * (std::abs(neighbor) + m_spacing);
        const double distance = m_distance.findNearest(p, within).distance;
        const bool isSameSide = std::isfinite(neighbor) && std::abs(neighbor) > kRounding * m_spacing;
        const bool isInside = isSameSide ? neighbor < 0 : m_distance.isInside(p);
        return isInside ? -distance : distance;
    }

    const MeshDistance& m_distance;
    Vector3 m_origin;
    double m_spacing;
    std::map<Index, std::vector<double>> m_bricks;
    Index m_last{};  ///< the brick that was asked last
    std::vector<double>* m_values = nullptr;
};

/** One pass of the kernel along one axis of a cube; the points at its ends stay. */
void smoothAlong(std::vector<double>& cube, int side, std::ptrdiff_t stride, double weight) {
    const std::vector<double> before = cube;
    const auto sideLength = static_cast<std::ptrdiff_t>(side);
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(cube.size()); ++i) {
        const std::ptrdiff_t along = i / stride % sideLength;
        if (along == 0 || along == sideLength - 1) continue;
        const auto at = [&](std::ptrdiff_t steps) { return before[static_cast<std::size_t>(i + steps * stride)]; };
        cube[static_cast<std::size_t>(i)] = at(0) + weight * (at(1) - 2 * at(0) + at(-1));
    }
}

/** Appends the control values of a brick: smoothed distances of its points and one more around, two at the end. */
void addControls(DistanceBricks& distances, const Index& brick, const Kernel& kernel, std::vector<float>& controls) {
    const int reach = kernel.passes, side = SolidGrid::kControls + 2 * reach;
    Index first;
    for (int axis = 0; axis < 3; ++axis) first[axis] = kBrick * brick[axis] - 1 - reach;
    std::vector<double> cube = distances.getCube(first, side);
    for (const std::ptrdiff_t stride : {std::ptrdiff_t(side) * side, std::ptrdiff_t(side), std::ptrdiff_t(1)})
        for (int pass = 0; pass < kernel.passes; ++pass) smoothAlong(cube, side, stride, kernel.side);
    forEachIndex({SolidGrid::kControls, SolidGrid::kControls, SolidGrid::kControls}, [&](const Index& at) {
        const int index = ((at[0] + reach) * side + at[1] + reach) * side + at[2] + reach;
        controls.push_back(static_cast<float>(cube[static_cast<std::size_t>(index)]));
    });
}

int countCells(double length, double cell) {
    return static_cast<int>(std::ceil(length / cell));
}

/** Refuses lattices that no memory holds before anything is computed. */
void requireCount(const Index& counts, const char* what) {
    const double count = toVector(counts).prod();
    require(count <= static_cast<double>(kMostControls), "solid fit: ", count, " ", what, " are more than ",
            kMostControls, ": choose a wider spacing");
}

/** How far beyond the mesh the fine function may be needed: smoothing moves heights by no more than its own reach. */
double calcBand(const SolidGrid& grid) {
    return grid.blendEnd + kSqrt3 * grid.width;
}

/** A brick no point of which is near is far outside or far inside; all others get control values. */
void fillBricks(const MeshDistance& distance, const Eigen::AlignedBox3d& box, SolidGrid& grid) {
    const double brickSide = kBrick * grid.spacing, pad = calcBand(grid) + grid.spacing;
    const double reach = calcBand(grid) + 0.5 * kSqrt3 * brickSide;
    for (int axis = 0; axis < 3; ++axis) grid.numBricks[axis] = countCells(box.sizes()[axis] + 2 * pad, brickSide);
    requireCount(grid.numBricks, "bricks");
    grid.origin = box.center() - 0.5 * brickSide * toVector(grid.numBricks);
    DistanceBricks distances(distance, grid.origin, grid.spacing);
    const Kernel kernel(grid.width / grid.spacing);
    std::int32_t numFilled = 0;
    forEachIndex(grid.numBricks, [&](const Index& brick) {
        const Vector3 center = grid.origin + brickSide * (toVector(brick) + Vector3::Constant(0.5));
        if (distance.findNearest(center, reach).triangle < 0) {
            grid.bricks.push_back(distance.isInside(center) ? SolidGrid::kInside : SolidGrid::kOutside);
            return;
        }
        require(grid.controls.size() < kMostControls, "solid fit: more than ", kMostControls,
                " control values: choose a wider spacing");
        grid.bricks.push_back(numFilled++);
        addControls(distances, brick, kernel, grid.controls);
    });
}

/** Around the box of bricks with room for the margin in which places are clamped. */
void fillFar(const MeshDistance& distance, const Eigen::AlignedBox3d& box, SolidGrid& grid) {
    grid.farSpacing = std::max(kFarSpacing * grid.spacing, box.sizes().maxCoeff() / kMostFarCells);
    const double pad = calcBand(grid) + kBrick * grid.spacing + 3 * grid.farSpacing;
    Index numCells;
    for (int axis = 0; axis < 3; ++axis) {
        numCells[axis] = countCells(box.sizes()[axis] + 2 * pad, grid.farSpacing);
        grid.numFarControls[axis] = numCells[axis] + 3;
    }
    grid.farOrigin = box.center() - 0.5 * grid.farSpacing * toVector(numCells);
    forEachIndex(grid.numFarControls, [&](const Index& at) {
        const Vector3 point = grid.farOrigin + grid.farSpacing * (toVector(at) - Vector3::Ones());
        grid.farControls.push_back(static_cast<float>(distance.findNearest(point).distance));
    });
}

/** By area, so that many small triangles of some detail do not decide. */
double calcMeanEdge(const TriangleMesh& mesh) {
    double sum = 0, area = 0;
    for (int i = 0; i < mesh.countTriangles(); ++i) {
        const double weight = calcDoubleArea(mesh, i).norm();
        for (int k = 0; k < 3; ++k) sum += weight * (mesh.getCorner(i, (k + 1) % 3) - mesh.getCorner(i, k)).norm() / 3;
        area += weight;
    }
    return sum / area;
}

SolidGrid makeGrid(const MeshDistance& distance, const SolidFitOptions& options) {
    const TriangleMesh& mesh = distance.getMesh();
    SolidGrid grid;
    // Of a ball its radius; of what is long or flat, one and a half of its radius or thickness.
    grid.size = 3 * std::abs(calcVolume(mesh)) / calcArea(mesh);
    grid.width = options.width == 0 ? std::min(0.5 * calcMeanEdge(mesh), kWidthOfSize * grid.size) : options.width;
    requireLength(grid.width, "solid fit: width");
    grid.spacing = options.spacing == 0 ? kSpacingOfWidth * grid.width : options.spacing;
    requireLength(grid.spacing, "solid fit: spacing");
    require(grid.width >= kLeastWidth * grid.spacing && grid.width <= kMostWidth * grid.spacing,
            "solid fit: a spacing must lie between width / ", kMostWidth, " and ", 1 / kLeastWidth,
            " width, but it is ", grid.spacing, " and the width is ", grid.width);
    grid.blendBegin = kBlendBegin * grid.spacing, grid.blendEnd = kBlendEnd * grid.spacing;
    grid.size = std::max(grid.size, 2 * grid.width);
    const Eigen::AlignedBox3d box = calcBox(mesh);
    fillBricks(distance, box, grid);
    fillFar(distance, box, grid);
    return grid;
}

/** A place that has the inside before it, too, where parts overlap, is not on the surface of the solid. */
void takeResiduals(const MeshDistance& distance, int numTriangles, SolidFit& fit) {
    constexpr double kFromCorner = 0.01;  // of the way to the middle
    constexpr double kAside = 1e-3;       // of the width
    const TriangleMesh& mesh = distance.getMesh();
    for (int i = 0; i < numTriangles; ++i) {
        const Vector3 N = calcDoubleArea(mesh, i).normalized();
        const Vector3 aside = kAside * fit.solid.getGrid().width * N;
        const Vector3 middle = (mesh.getCorner(i, 0) + mesh.getCorner(i, 1) + mesh.getCorner(i, 2)) / 3;
        const auto take = [&](const Vector3& point) {
            if (distance.isInside(point + aside)) return;
            fit.points.push_back(point);
            fit.report.residuals.push_back((fit.solid.findSurfacePoint(point).p - point).norm());
        };
        take(middle);
        for (int k = 0; k < 3; ++k) take(mesh.getCorner(i, k) + kFromCorner * (middle - mesh.getCorner(i, k)));
    }
    fit.report.numUnknowns = static_cast<int>(fit.solid.getGrid().controls.size());
    fit.report.sumUp();
}

}  // namespace

SolidFit fitSolid(const TriangleMesh& mesh, const SolidFitOptions& options) {
    RepairedMesh repaired = repairMesh(mesh);
    const MeshDistance distance(repaired.mesh);
    SolidFit fit{BSplineSolid(makeGrid(distance, options)), std::move(repaired), {}, {}};
    takeResiduals(distance, fit.repaired.mesh.countTriangles() - fit.repaired.addedTriangles, fit);
    return fit;
}

}  // namespace tautline
