// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/surface_mesh.h"

#include <cmath>
#include <map>
#include <queue>
#include <set>

namespace tautline {
namespace {

using Index = std::array<int, 3>;  ///< of a cell or a node of the lattice

/** The neighbor a step along an axis away. */
Index shift(Index at, int axis, int steps) {
    at[axis] += steps;
    return at;
}

/** The cells of a cubic lattice that a surface passes through, one point of the surface in each. Grown from cell to
cell across the lattice's edges that the surface cuts, so that no bounds need be known; each such edge then gives a
facet with its corners in the four cells around it. Cell (i, j, k) has node (i, j, k) at its lowest corner. */
class SurfaceNet {
public:
    enum class Growth { Complete, OutOfBox, TooManyCells };

    /** @param center   a surface point: the middle of cell (0, 0, 0) @param step   width of the cells */
    SurfaceNet(const Surface& surface, const Vector3& center, double step)
        : m_surface(surface),
          m_center(center),
          m_step(step),
          m_hasEdge(std::isfinite(surface.calcDomainMargin({center}))) {}

    /** The cells farthest out first, which soon shows whether the surface has an end.
    @param box   cells beyond it are not entered @param stopsThere   nor is anything else after such a cell */
    Growth grow(const std::vector<Vector3>& seeds, const Eigen::AlignedBox3d& box, bool stopsThere) {
        constexpr std::size_t kMaxCells = 20000;
        for (const Vector3& seed : seeds) addAround(findCell(seed));
        Growth growth = Growth::Complete;
        while (!m_front.empty()) {
            const Index cell = m_front.top().second;
            m_front.pop();
            if (!reaches(box, cell)) {
                growth = Growth::OutOfBox;
                if (stopsThere) return growth;
                continue;
            }
            if (m_cells.size() >= kMaxCells) return Growth::TooManyCells;
            if (enter(cell)) forEachCutEdge(cell, [&](const Index& node, int axis) { addAround(node, axis); });
        }
        return growth;
    }

    void addFaces(SurfaceMesh& mesh) {
        pullBackToEdge();
        std::map<Index, int> indices;
        const auto getPoint = [&](const Index& cell) {
            const auto [found, isNew] = indices.emplace(cell, static_cast<int>(mesh.points.size()));
            if (isNew) mesh.points.push_back(m_cells.at(cell).point);
            return found->second;
        };
        forEachFace([&](const std::array<Index, 4>& corners) {
            std::array<Vector3, 4> p;
            for (int i = 0; i < 4; ++i) p[i] = m_cells.at(corners[i]).point;
            // A point that is on the domain's edge already leaves no width to what is pulled back to it.
            constexpr double kNoArea = 1e-6;  // of a facet's: below it a normal means nothing
            if ((p[2] - p[0]).cross(p[3] - p[1]).norm() < kNoArea * m_step * m_step) return;
            std::array<int, 4> face;
            for (int i = 0; i < 4; ++i) face[i] = getPoint(corners[i]);
            mesh.faces.push_back(face);
        });
    }

private:
    struct Cell {
        Vector3 point;
        bool isInDomain;
        Vector3 inside = Vector3::Constant(kNaN);  ///< beyond the domain's edge: the nearest point of a neighbor within
    };

    Index findCell(const Vector3& p) const {
        Index cell;
        for (int i = 0; i < 3; ++i) cell[i] = static_cast<int>(std::lround((p[i] - m_center[i]) / m_step));
        return cell;
    }

    /** Whether some of the cell's points are nearer than half a cell to the box: so the box ends within the facets. */
    bool reaches(const Eigen::AlignedBox3d& box, const Index& cell) const {
        const Vector3 middle = m_center + m_step * Vector3(cell[0], cell[1], cell[2]);
        constexpr double kRounding = 1e-9;
        return ((middle - box.max()).array() < (1 - kRounding) * m_step).all() &&
               ((box.min() - middle).array() < (1 - kRounding) * m_step).all();
    }

    Vector3 calcNode(const Index& node) const {
        return m_center + m_step * (Vector3(node[0], node[1], node[2]) - Vector3::Constant(0.5));
    }

    double getHeight(const Index& node) {
        const auto [found, isNew] = m_heights.emplace(node, 0);
        if (isNew) found->second = calcFootHeight(calcNode(node));
        return found->second;
    }

    /** Beside the domain that above the surface that goes on there: what lies below the domain would have walls. */
    double calcFootHeight(const Vector3& p) const {
        if (!m_hasEdge) return m_surface.calcHeight(p);
        const SurfacePoint foot = m_surface.findSurfacePoint(p);
        return m_surface.calcFrame(foot, Vector3::UnitX()).N.dot(p - foot.p);
    }

    bool isCut(const Index& node, int axis) { return (getHeight(node) < 0) != (getHeight(shift(node, axis, 1)) < 0); }

    void add(const Index& cell) {
        if (!m_seen.insert(cell).second) return;
        m_front.push({std::max({std::abs(cell[0]), std::abs(cell[1]), std::abs(cell[2])}), cell});
    }
    /** The cell and all that touch it: the surface may enter the cell of a seed between its nodes. */
    void addAround(const Index& cell) {
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k) add({cell[0] + i, cell[1] + j, cell[2] + k});
    }
    void addAround(const Index& node, int axis) {
        for (const Index& cell : getCellsAround(node, axis)) add(cell);
    }

    /** Counterclockwise about the edge from a node along an axis. */
    static std::array<Index, 4> getCellsAround(const Index& node, int axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        return {shift(shift(node, b, -1), c, -1), shift(node, c, -1), node, shift(node, b, -1)};
    }

    /** Calls a function with node and axis of each of a cell's twelve edges that the surface cuts. */
    template <class Function>
    void forEachCutEdge(const Index& cell, Function&& act) {
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 4; ++side) {
                const Index node = shift(shift(cell, (axis + 1) % 3, side & 1), (axis + 2) % 3, side >> 1);
                if (isCut(node, axis)) act(node, axis);
            }
    }

    /** @return whether the surface passes through the cell and goes on from there */
    bool enter(const Index& cell) {
        Vector3 sum = Vector3::Zero();
        int count = 0;
        forEachCutEdge(cell, [&](const Index& node, int axis) {
            const double from = getHeight(node), to = getHeight(shift(node, axis, 1));
            sum += calcNode(node) + m_step * from / (from - to) * Vector3::Unit(axis);
            ++count;
        });
        if (count == 0) return false;
        const SurfacePoint point = m_surface.findSurfacePoint(sum / count);
        const bool isInDomain = m_surface.isInDomain(point);
        m_cells.emplace(cell, Cell{point.p, isInDomain});
        return isInDomain;
    }

    /** Calls a function with the four cells around each cut edge, in the order in which they face outward. */
    template <class Function>
    void forEachFace(Function&& act) {
        for (const auto& entry : m_cells)
            for (int axis = 0; axis < 3; ++axis) {
                const Index& node = entry.first;
                if (!isCut(node, axis)) continue;
                std::array<Index, 4> corners = getCellsAround(node, axis);
                if (getHeight(node) >= 0) std::swap(corners[1], corners[3]);
                bool isComplete = true, isInDomain = false;
                for (const Index& corner : corners) {
                    const auto found = m_cells.find(corner);
                    isComplete = isComplete && found != m_cells.end();
                    isInDomain = isInDomain || (isComplete && found->second.isInDomain);
                }
                if (isComplete && isInDomain) act(corners);
            }
    }

    /** Moves the points beyond the domain's edge that are corners of facets to the edge. */
    void pullBackToEdge() {
        forEachFace([&](const std::array<Index, 4>& corners) {
            for (const Index& outer : corners)
                for (const Index& inner : corners) {
                    Cell& cell = m_cells.at(outer);
                    const Cell& other = m_cells.at(inner);
                    if (cell.isInDomain || !other.isInDomain) continue;
                    if (!((cell.inside - cell.point).norm() <= (other.point - cell.point).norm()))
                        cell.inside = other.point;
                }
        });
        for (auto& entry : m_cells)
            if (entry.second.inside.allFinite()) entry.second.point = findEdge(entry.second);
    }

    /** The last point of the domain on the way out, by halving. */
    Vector3 findEdge(const Cell& cell) const {
        constexpr int kHalvings = 40;
        double inside = 0, outside = 1;
        Vector3 result = cell.inside;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (inside + outside);
            const SurfacePoint point = m_surface.findSurfacePoint(cell.inside + middle * (cell.point - cell.inside));
            if (m_surface.isInDomain(point))
                inside = middle, result = point.p;
            else
                outside = middle;
        }
        return result;
    }

    const Surface& m_surface;
    Vector3 m_center;
    double m_step;
    bool m_hasEdge;  ///< of its domain
    std::map<Index, double> m_heights;
    std::map<Index, Cell> m_cells;
    std::set<Index> m_seen;
    std::priority_queue<std::pair<int, Index>> m_front;  ///< by distance from the center, in cells
};

/** From beyond the domain's edge, where the surface goes on, along the surface up the margin's slope. Coordinates have
a margin that is linear in them, so that few steps are needed.
@return false if the domain was not reached */
bool moveIntoDomain(const Surface& surface, SurfacePoint& point) {
    constexpr int kMaxSteps = 100;
    const double size = surface.getSize(), difference = 1e-4 * size, longest = 10 * size;
    for (int i = 0; i < kMaxSteps && !surface.isInDomain(point); ++i) {
        const double margin = surface.calcDomainMargin(point);
        if (!std::isfinite(margin)) return false;
        const DarbouxFrame frame = surface.calcFrame(point, Vector3(1, 0.3, 0.2));
        const auto calcSlope = [&](const Vector3& axis) {
            return (surface.calcDomainMargin(surface.calcDisplacedPoint(point, difference * axis)) - margin) /
                   difference;
        };
        const Vector3 slope = calcSlope(frame.t) * frame.t + calcSlope(frame.B) * frame.B;
        const double needed = 1.1 * std::abs(margin) / slope.norm();
        if (!std::isfinite(needed)) return false;
        point = surface.calcDisplacedPoint(point, std::min(needed, longest) * slope.normalized());
    }
    return surface.isInDomain(point);
}

/** Points of the surface within its domain, that nearest to the origin of S first where it can be found. */
std::vector<Vector3> findSeeds(const Surface& surface, const std::vector<Vector3>& near_S) {
    const double size = surface.getSize();
    std::vector<Vector3> starts{Vector3::Zero()};
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {size, -size}) starts.push_back(side * Vector3::Unit(axis));
    starts.insert(starts.end(), near_S.begin(), near_S.end());
    std::vector<Vector3> seeds;
    for (const Vector3& start : starts) {
        SurfacePoint point = surface.findSurfacePoint(start);
        // A search that did not arrive goes on from where it ended.
        if (!point.p.allFinite() || !((surface.findSurfacePoint(point.p).p - point.p).norm() < 1e-6 * size)) continue;
        if (moveIntoDomain(surface, point)) seeds.push_back(point.p);
    }
    return seeds;
}

Eigen::AlignedBox3d calcBox(const std::vector<Vector3>& points, double margin) {
    Eigen::AlignedBox3d box;
    for (const Vector3& p : points) box.extend(p);
    return {box.min() - Vector3::Constant(margin), box.max() + Vector3::Constant(margin)};
}

/** @param cuts   whether the surface is drawn as far as the box, or not at all if it goes on beyond
@return Complete, and facets in the mesh, or why there are none */
SurfaceNet::Growth cover(const Surface& surface, const std::vector<Vector3>& seeds, double step,
                         const Eigen::AlignedBox3d& box, bool cuts, SurfaceMesh& mesh) {
    using Growth = SurfaceNet::Growth;
    SurfaceNet net(surface, seeds.front(), step);
    const Growth growth = net.grow(seeds, box, !cuts);
    if (growth == Growth::TooManyCells || (growth == Growth::OutOfBox && !cuts)) return growth;
    net.addFaces(mesh);
    mesh.isCut = growth == Growth::OutOfBox;
    mesh.box = mesh.isCut ? box : calcBox(mesh.points, step);
    return Growth::Complete;
}

}  // namespace

SurfaceMesh calcSurfaceMesh(const Surface& surface, double extent, const std::vector<Vector3>& near_S) {
    constexpr double kFacetsPerSize = 6, kCoarsening = 1.5;
    constexpr double kFar = 1000;  // in sizes: what goes on beyond has no end
    using Growth = SurfaceNet::Growth;
    SurfaceMesh mesh;
    const std::vector<Vector3> seeds = findSeeds(surface, near_S);
    if (seeds.empty()) return mesh;
    const Eigen::AlignedBox3d far = calcBox({seeds.front()}, kFar * surface.getSize()), near = calcBox(seeds, extent);
    Growth growth = Growth::TooManyCells;
    for (double step = std::min(surface.getSize(), extent) / kFacetsPerSize; growth != Growth::Complete;
         step *= kCoarsening) {
        growth = cover(surface, seeds, step, far, false, mesh);
        if (growth == Growth::OutOfBox) growth = cover(surface, seeds, step, near, true, mesh);
    }
    for (const Vector3& p : near_S) mesh.box.extend(p);
    return mesh;
}

}  // namespace tautline
