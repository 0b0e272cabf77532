// SPDX-License-Identifier: Apache-2.0
#include "tautline/meshes/close_gaps.h"

#include <cmath>
#include <map>

#include "tautline/error.h"
#include "tautline/meshes/mesh_distance.h"

namespace tautline {
namespace {

constexpr double kSpacingOfGap = 0.1, kCoarsest = 0.25;  ///< of the gap
constexpr double kCells = 80;                            ///< along the longest side, if the spacing is not given
constexpr std::size_t kMostPoints = std::size_t(1) << 26;
constexpr int kMargin = 3;  ///< cells around all that is sought

/** A cubic lattice with a number at each of its points, x the slowest index. */
struct Lattice {
    Vector3 origin;
    double spacing;
    std::array<int, 3> counts{};
    std::vector<double> values;

    std::size_t getIndex(int i, int j, int k) const {
        return (static_cast<std::size_t>(i) * static_cast<std::size_t>(counts[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(counts[2]) +
               static_cast<std::size_t>(k);
    }
    template <class Function>
    void forEachPoint(Function&& act) const {
        std::size_t index = 0;
        for (int i = 0; i < counts[0]; ++i)
            for (int j = 0; j < counts[1]; ++j)
                for (int k = 0; k < counts[2]; ++k) act(index++, Vector3(origin + spacing * Vector3(i, j, k)));
    }
};

Lattice makeLattice(const TriangleMesh& mesh, double radius, double spacing) {
    const Eigen::AlignedBox3d box = calcBox(mesh);
    Lattice lattice;
    lattice.spacing = spacing;
    const double pad = radius + kMargin * spacing;
    lattice.origin = box.min() - Vector3::Constant(pad);
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = std::ceil((box.sizes()[axis] + 2 * pad) / spacing);
        product *= cells + 1;
        require(product <= static_cast<double>(kMostPoints), "gaps to close: a lattice of ", spacing,
                " m has more than ", kMostPoints, " points over the mesh: choose a wider spacing");
        lattice.counts[axis] = static_cast<int>(cells) + 1;
    }
    lattice.values.resize(static_cast<std::size_t>(product));
    return lattice;
}

/** The facets of the level 0 of a lattice's values, interpolated along the edges of six tetrahedra that each cell is
cut into, all about one diagonal. They face towards what is positive. */
class LevelMesh {
public:
    explicit LevelMesh(const Lattice& lattice) : m_lattice(lattice) {
        // From the lowest corner along the axes in each order to the highest one.
        constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (int i = 0; i + 1 < lattice.counts[0]; ++i)
            for (int j = 0; j + 1 < lattice.counts[1]; ++j)
                for (int k = 0; k + 1 < lattice.counts[2]; ++k)
                    for (const auto& order : kOrders) {
                        std::array<int, 3> at{i, j, k};
                        Corners corners;
                        for (int step = 0; step < 4; ++step) {
                            corners[step] = {at, lattice.getIndex(at[0], at[1], at[2])};
                            if (step < 3) ++at[order[step]];
                        }
                        addTetrahedron(corners);
                    }
    }

    TriangleMesh take() { return std::move(m_mesh); }

private:
    struct Corner {
        std::array<int, 3> at{};
        std::size_t index = 0;
    };
    using Corners = std::array<Corner, 4>;

    bool isOutside(const Corner& corner) const { return m_lattice.values[corner.index] > 0; }
    Vector3 getPoint(const Corner& corner) const {
        return m_lattice.origin + m_lattice.spacing * Vector3(corner.at[0], corner.at[1], corner.at[2]);
    }

    int addPoint(const Corner& a, const Corner& b) {
        const auto [found, isNew] = m_points.try_emplace(std::minmax(a.index, b.index), 0);
        if (isNew) {
            const double atA = m_lattice.values[a.index], atB = m_lattice.values[b.index];
            found->second = static_cast<int>(m_mesh.points.size());
            m_mesh.points.push_back(getPoint(a) + atA / (atA - atB) * (getPoint(b) - getPoint(a)));
        }
        return found->second;
    }

    void addTriangle(int a, int b, int c, const Vector3& outward) {
        const auto get = [&](int point) { return m_mesh.points[static_cast<std::size_t>(point)]; };
        const bool facesOut = (get(b) - get(a)).cross(get(c) - get(a)).dot(outward) >= 0;
        m_mesh.triangles.push_back({a, facesOut ? b : c, facesOut ? c : b});
    }

    void addTetrahedron(const Corners& corners) {
        std::vector<Corner>&out = m_out, &in = m_in;
        out.clear(), in.clear();
        Vector3 outward = Vector3::Zero();
        for (const Corner& corner : corners) (isOutside(corner) ? out : in).push_back(corner);
        if (out.empty() || in.empty()) return;
        for (const Corner& a : out)
            for (const Corner& b : in) outward += getPoint(a) - getPoint(b);
        if (out.size() == 2) {
            const int a = addPoint(out[0], in[0]), b = addPoint(out[0], in[1]), c = addPoint(out[1], in[1]),
                      d = addPoint(out[1], in[0]);
            addTriangle(a, b, c, outward);
            addTriangle(a, c, d, outward);
            return;
        }
        const Corner& alone = out.size() == 1 ? out[0] : in[0];
        const std::vector<Corner>& others = out.size() == 1 ? in : out;
        addTriangle(addPoint(alone, others[0]), addPoint(alone, others[1]), addPoint(alone, others[2]), outward);
    }

    const Lattice& m_lattice;
    TriangleMesh m_mesh;
    std::map<std::pair<std::size_t, std::size_t>, int> m_points;
    std::vector<Corner> m_out, m_in;
};

/** The lattice points that are reached from its lowest corner, from neighbor to neighbor, over values above 0. */
std::vector<char> floodFromOutside(const Lattice& lattice) {
    std::vector<char> isReached(lattice.values.size(), 0);
    std::vector<std::array<int, 3>> open{{0, 0, 0}};
    isReached[0] = 1;
    while (!open.empty()) {
        const std::array<int, 3> at = open.back();
        open.pop_back();
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                std::array<int, 3> next = at;
                next[axis] += step;
                if (next[axis] < 0 || next[axis] >= lattice.counts[axis]) continue;
                const std::size_t index = lattice.getIndex(next[0], next[1], next[2]);
                if (isReached[index] || !(lattice.values[index] > 0)) continue;
                isReached[index] = 1;
                open.push_back(next);
            }
    }
    return isReached;
}

}  // namespace

/** The centers of balls that touch nothing are those farther than the radius from the mesh. Of the places that they
reach from outside, the closing keeps clear by the radius again. */
TriangleMesh closeGaps(const TriangleMesh& mesh, double gap, double spacing) {
    requireMesh(mesh);
    require(std::isfinite(gap) && gap > 0, "gaps to close must be of positive and finite width, but that is ", gap);
    const double longest = calcBox(mesh).sizes().maxCoeff(), radius = gap / 2;
    if (spacing == 0) spacing = std::min(kSpacingOfGap * gap, longest / kCells);
    require(spacing > 0 && spacing <= kCoarsest * gap, "gaps to close: gaps of ", gap,
            " m need a lattice no coarser than ", kCoarsest * gap, " m, but it is of ", spacing, " m");
    Lattice lattice = makeLattice(mesh, radius, spacing);
    const double within = radius + 2 * spacing;
    const MeshDistance distance(mesh);
    lattice.forEachPoint([&](std::size_t index, const Vector3& p) {
        lattice.values[index] = std::min(within, distance.findNearest(p, within).distance) - radius;
    });
    const std::vector<char> isReached = floodFromOutside(lattice);
    for (std::size_t i = 0; i < isReached.size(); ++i)
        if (!isReached[i]) lattice.values[i] = std::min(lattice.values[i], -spacing * 1e-3);
    const MeshDistance centers(LevelMesh(lattice).take());
    lattice.forEachPoint([&](std::size_t index, const Vector3& p) {
        const double toCenters = isReached[index] ? 0 : std::min(within, centers.findNearest(p, within).distance);
        lattice.values[index] = radius - toCenters;
    });
    return LevelMesh(lattice).take();
}

}  // namespace tautline
