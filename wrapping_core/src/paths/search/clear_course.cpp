// SPDX-License-Identifier: Apache-2.0
#include "paths/search/clear_course.h"

#include <algorithm>
#include <array>
#include <map>
#include <queue>

namespace tautline {
namespace {

constexpr double kLeastStep = 0.05;       ///< along an edge, in sizes
constexpr double kCells[] = {0.7, 0.35};  ///< of the lattices that are tried, in sizes
constexpr int kMaxPlaces = 40000;         ///< of one lattice that are reached: a bone's fill a few thousand
constexpr int kMaxLooks = 3;              ///< at the lowest place between two steps
constexpr double kOverestimate = 2;       ///< of distances by heights: Surface::calcHeightAndNormal()
constexpr double kGrazing = -1e-3;  ///< height in sizes from which on an edge is clear: ends may lie on the surface

using Index = std::array<int, 3>;

bool hasClearEdge(const Surface& surface, const Vector3& A_S, const Vector3& B_S, long& numHeights) {
    const double enough = kGrazing * surface.getSize();
    return calcLowestAlong(surface, A_S, B_S, enough, numHeights) >= enough;
}

/** A point of an edge. */
struct Sample {
    double s, height, slope;  ///< slope: of the height along the edge
};

/** Between a place where the edge goes down and one where it comes up: the tangents of the height meet no higher than
it goes, whether it bends over a surface or breaks in the middle of a wall. */
double findTangentsCrossing(const Sample& down, const Sample& up) {
    const double x = (up.height - down.height - up.slope * (up.s - down.s)) / (down.slope - up.slope);
    return std::clamp(down.s + x, down.s, up.s);
}

/** A* over the points A + cell * (i, j, k), each joined to the 26 around it where the edge is clear. */
class LatticeSearch {
public:
    LatticeSearch(const Surface& surface, const Vector3& A_S, const Vector3& B_S, double cell)
        : m_surface(surface), m_A(A_S), m_B(B_S), m_cell(cell) {}

    /** @return the places from A to B, both included; empty if none was found */
    std::vector<Vector3> run() {
        m_heightOfB = calcHeight(m_B);
        reach({0, 0, 0}, 0, {0, 0, 0});
        while (!m_open.empty() && m_places.size() < kMaxPlaces) {
            const Candidate best = m_open.top();
            m_open.pop();
            if (best.isEnd) return traceBack(best.at);
            Place& place = m_places.at(best.at);
            if (place.isDone) continue;
            place.isDone = true;
            leave(best.at, place);
        }
        return {};
    }

    long numHeights = 0;

private:
    struct Place {
        double height = kNaN, cost = kInfinity;  ///< [m], and from A
        Index from{};
        bool isDone = false;
    };
    struct Candidate {
        double estimate;  ///< of the length from A over it to B [m]
        Index at;
        bool isEnd;  ///< B, from there
        bool operator<(const Candidate& other) const { return estimate > other.estimate; }
    };

    Vector3 getPoint(const Index& at) const { return m_A + m_cell * Vector3(at[0], at[1], at[2]); }

    double calcHeight(const Vector3& p) {
        ++numHeights;
        return m_surface.calcHeight(p);
    }

    bool isClear(const Vector3& a, double heightA, const Vector3& b, double heightB) {
        if (heightA + heightB > kOverestimate * (b - a).norm()) return true;
        return hasClearEdge(m_surface, a, b, numHeights);
    }

    void reach(const Index& at, double cost, const Index& from) {
        Place& place = m_places[at];
        if (std::isnan(place.height)) place.height = calcHeight(getPoint(at));
        if (!(cost < place.cost)) return;
        place.cost = cost, place.from = from;
        m_open.push({cost + (m_B - getPoint(at)).norm(), at, false});
    }

    void leave(const Index& at, const Place& place) {
        const Vector3 p = getPoint(at);
        const double toB = (m_B - p).norm();
        if (toB < 2 * m_cell && isClear(p, place.height, m_B, m_heightOfB)) m_open.push({place.cost + toB, at, true});
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k) step(at, place, {at[0] + i, at[1] + j, at[2] + k});
    }

    void step(const Index& at, const Place& place, const Index& next) {
        const Vector3 p = getPoint(at), q = getPoint(next);
        const double cost = place.cost + (q - p).norm();
        Place& other = m_places[next];
        if (std::isnan(other.height)) other.height = calcHeight(q);
        if (other.isDone || !(other.height > 0) || !(cost < other.cost)) return;
        if (isClear(p, place.height, q, other.height)) reach(next, cost, at);
    }

    std::vector<Vector3> traceBack(Index at) const {
        std::vector<Vector3> course{m_B};
        for (; at != Index{0, 0, 0}; at = m_places.at(at).from) course.push_back(getPoint(at));
        course.push_back(m_A);
        std::reverse(course.begin(), course.end());
        return course;
    }

    const Surface& m_surface;
    const Vector3 m_A, m_B;
    const double m_cell;
    double m_heightOfB = kNaN;
    std::map<Index, Place> m_places;
    std::priority_queue<Candidate> m_open;
};

/** From corner to the farthest corner in sight. */
void leaveOutCorners(const Surface& surface, const std::vector<Vector3>& course, std::vector<Vector3>& corners,
                     long& numHeights) {
    std::size_t at = 0;
    const std::size_t last = course.size() - 1;
    while (true) {
        std::size_t next = last;
        while (next > at + 1 && !hasClearEdge(surface, course[at], course[next], numHeights)) --next;
        if (next == last) return;
        corners.push_back(course[next]);
        at = next;
    }
}

}  // namespace

double calcLowestAlong(const Surface& surface, const Vector3& A_S, const Vector3& B_S, double enough,
                       long& numHeights) {
    const double length = (B_S - A_S).norm(), least = kLeastStep * surface.getSize();
    const Vector3 e_S = length > 0 ? Vector3((B_S - A_S) / length) : Vector3(Vector3::Zero());
    const auto calc = [&](double s) {
        Vector3 N_S;
        const double height = surface.calcHeightAndNormal(A_S + s * e_S, N_S);
        ++numHeights;
        return Sample{s, height, N_S.dot(e_S)};
    };
    Sample last = calc(0);
    double lowest = last.height;
    while (last.s < length && !(lowest < enough)) {
        const Sample next = calc(std::min(length, last.s + std::max(least, last.height / kOverestimate)));
        lowest = std::min(lowest, next.height);
        Sample down = last, up = next;
        for (int i = 0; i < kMaxLooks && !(lowest < enough) && down.slope < 0 && up.slope > 0; ++i) {
            const double s = findTangentsCrossing(down, up);
            if (!(down.height + down.slope * (s - down.s) < enough)) break;
            const Sample between = calc(s);
            lowest = std::min(lowest, between.height);
            (between.slope < 0 ? down : up) = between;
        }
        last = next;
    }
    return lowest;
}

bool findClearCourse(const Surface& surface, const Vector3& A_S, const Vector3& B_S, std::vector<Vector3>& corners_S,
                     long& numHeights) {
    corners_S.clear();
    for (const double cell : kCells) {
        LatticeSearch search(surface, A_S, B_S, cell * surface.getSize());
        const std::vector<Vector3> course = search.run();
        numHeights += search.numHeights;
        if (course.empty()) continue;
        leaveOutCorners(surface, course, corners_S, numHeights);
        return true;
    }
    return false;
}

}  // namespace tautline
