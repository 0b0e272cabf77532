// SPDX-License-Identifier: Apache-2.0
#include "tautline/meshes/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tautline {
namespace {

constexpr int kLeafTriangles = 4;
constexpr int kDeepest = 128;  ///< entries of a stack: halves of at most 2^31 triangles, two at each level
/** A part whose center is farther than this many of its radii is one dipole (Barill et al. 2018, Sec. 4: 2.3). */
constexpr double kFarRadii = 2.3;

Vector3 findNearestOfSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 ab = b - a;
    const double square = ab.squaredNorm();
    const double t = square > 0 ? std::clamp(ab.dot(p - a) / square, 0.0, 1.0) : 0.0;
    return a + t * ab;
}

/** The foot on the plane if it lies between the edges, else the nearest point of the three. */
Vector3 findNearestOfTriangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 n = (b - a).cross(c - a);
    const double square = n.squaredNorm();
    const auto isWithin = [&](const Vector3& from, const Vector3& to) {
        return n.dot((to - from).cross(p - from)) >= 0;
    };
    if (square > 0 && isWithin(a, b) && isWithin(b, c) && isWithin(c, a)) return p - n.dot(p - a) / square * n;
    Vector3 nearest = findNearestOfSegment(p, a, b);
    for (const Vector3& candidate : {findNearestOfSegment(p, b, c), findNearestOfSegment(p, c, a)})
        if ((candidate - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = candidate;
    return nearest;
}

/** Solid angle of a triangle seen from the origin [sr], positive from behind (van Oosterom and Strackee 1983). */
double calcSolidAngle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh) : m_mesh(std::move(mesh)) {
    requireMesh(m_mesh);
    m_order.resize(m_mesh.triangles.size());
    std::iota(m_order.begin(), m_order.end(), 0);
    m_nodes.reserve(m_order.size());
    m_nodes.push_back({{}, 0, m_mesh.countTriangles()});
    build(0);
}

/** Halves by the middle triangle along the longest side of the centers' box, so that the tree is never deep. */
void MeshDistance::build(int at) {
    const auto calcCenter = [this](int triangle) -> Vector3 {
        return (m_mesh.getCorner(triangle, 0) + m_mesh.getCorner(triangle, 1) + m_mesh.getCorner(triangle, 2)) / 3;
    };
    Node& node = m_nodes[static_cast<std::size_t>(at)];
    Eigen::AlignedBox3d centers;
    for (int i = node.first; i < node.first + node.count; ++i) {
        const int triangle = m_order[static_cast<std::size_t>(i)];
        centers.extend(calcCenter(triangle));
        for (int corner = 0; corner < 3; ++corner) node.box.extend(m_mesh.getCorner(triangle, corner));
    }
    setDipole(node);
    if (node.count <= kLeafTriangles) return;
    int axis;
    centers.sizes().maxCoeff(&axis);
    const int first = node.first, half = node.count / 2, rest = node.count - half;
    const auto begin = m_order.begin() + first;
    std::nth_element(begin, begin + half, begin + half + rest,
                     [&](int left, int right) { return calcCenter(left)[axis] < calcCenter(right)[axis]; });
    const int children = static_cast<int>(m_nodes.size());
    node.children = children;
    m_nodes.push_back({{}, first, half});  // from here on `node` may be elsewhere
    m_nodes.push_back({{}, first + half, rest});
    build(children);
    build(children + 1);
}

void MeshDistance::setDipole(Node& node) const {
    double weight = 0;
    for (int i = node.first; i < node.first + node.count; ++i) {
        const int triangle = m_order[static_cast<std::size_t>(i)];
        const Vector3 area = 0.5 * calcDoubleArea(m_mesh, triangle);
        for (int corner = 0; corner < 3; ++corner) node.center += area.norm() / 3 * m_mesh.getCorner(triangle, corner);
        weight += area.norm();
        node.area += area;
    }
    node.center = weight > 0 ? Vector3(node.center / weight) : node.box.center();
    const Vector3 reach = (node.box.max() - node.center).cwiseMax(node.center - node.box.min());
    node.radius = reach.norm();
}

/** The nearer half first: the other one is then mostly too far. */
MeshDistance::Nearest MeshDistance::findNearest(const Vector3& p, double within) const {
    struct Entry {
        int node;
        double square;
    };
    Nearest nearest;
    double best = within * within;
    std::array<Entry, kDeepest> stack;
    std::size_t size = 0;
    stack[size++] = {0, m_nodes[0].box.squaredExteriorDistance(p)};
    while (size > 0) {
        const Entry entry = stack[--size];
        if (!(entry.square < best)) continue;
        const Node& node = m_nodes[static_cast<std::size_t>(entry.node)];
        if (node.children >= 0) {
            Entry left{node.children, 0}, right{node.children + 1, 0};
            for (Entry* child : {&left, &right})
                child->square = m_nodes[static_cast<std::size_t>(child->node)].box.squaredExteriorDistance(p);
            if (left.square < right.square) std::swap(left, right);
            stack[size++] = left;
            stack[size++] = right;
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const int triangle = m_order[static_cast<std::size_t>(i)];
            const Vector3 point = findNearestOfTriangle(p, m_mesh.getCorner(triangle, 0), m_mesh.getCorner(triangle, 1),
                                                        m_mesh.getCorner(triangle, 2));
            const double square = (point - p).squaredNorm();
            if (square < best) best = square, nearest = {point, triangle, std::sqrt(square)};
        }
    }
    return nearest;
}

double MeshDistance::calcWindingNumber(const Vector3& p) const {
    double angle = 0;
    std::array<int, kDeepest> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = m_nodes[static_cast<std::size_t>(stack[--size])];
        const Vector3 toCenter = node.center - p;
        const double distance = toCenter.norm();
        if (distance > kFarRadii * node.radius && distance > 0) {
            angle += node.area.dot(toCenter) / (distance * distance * distance);
        } else if (node.children >= 0) {
            stack[size++] = node.children;
            stack[size++] = node.children + 1;
        } else {
            for (int i = node.first; i < node.first + node.count; ++i) {
                const int triangle = m_order[static_cast<std::size_t>(i)];
                angle += calcSolidAngle(m_mesh.getCorner(triangle, 0) - p, m_mesh.getCorner(triangle, 1) - p,
                                        m_mesh.getCorner(triangle, 2) - p);
            }
        }
    }
    return angle / (4 * kPi);
}

}  // namespace tautline
