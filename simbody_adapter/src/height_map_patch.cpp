// SPDX-License-Identifier: Apache-2.0
#include "height_map_patch.h"

#include <algorithm>

namespace tautline {

template class ParametricShape<HeightMapPatch>;

namespace {

ParameterDomain calcDomain(const SimTK::BicubicSurface& surface) {
    const SimTK::Vec2 min = surface.getMinXY(), max = surface.getMaxXY();
    return {Vector2(min[0], min[1]), Vector2(max[0], max[1])};
}

/** The cell of a coordinate, and where in it. */
struct Place {
    Place(const std::vector<double>& sides, double coordinate) {
        const auto next = std::upper_bound(sides.begin() + 1, sides.end() - 1, coordinate);
        cell = static_cast<int>(next - sides.begin()) - 1;
        width = sides[cell + 1] - sides[cell];
        s = (coordinate - sides[cell]) / width;
    }

    /** Row k: the k-th derivatives of 1, s, s^2, s^3 by the coordinate. */
    Eigen::Matrix<double, 3, 4> calcPowers() const {
        Eigen::Matrix<double, 3, 4> powers;
        powers << 1, s, s * s, s * s * s, 0, 1 / width, 2 * s / width, 3 * s * s / width, 0, 0, 2 / (width * width),
            6 * s / (width * width);
        return powers;
    }

    int cell;
    double width, s;
};

}  // namespace

HeightMapPatch::HeightMapPatch(const SimTK::BicubicSurface& surface) : PatchShape(calcDomain(surface), true, 1) {
    int nx = 0, ny = 0;
    surface.getNumPatches(nx, ny);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const auto patch = surface.calcHermitePatch(i, j);
            const auto& A = patch.getAlgebraicCoefficients();  // a_ij is at (3 - i, 3 - j)
            Coefficients cell;
            for (int k = 0; k < 4; ++k)
                for (int l = 0; l < 4; ++l) cell(k, l) = A(3 - k, 3 - l)[2];
            m_cells.push_back(cell);
            const SimTK::Vec3 first = patch.evalP(0, 0), last = patch.evalP(1, 1);
            if (j == 0) m_x.insert(m_x.end(), {first[0], last[0]});
            if (i == 0) m_y.insert(m_y.end(), {first[1], last[1]});
        }
    // Neighbors share their sides, to rounding.
    for (std::vector<double>* sides : {&m_x, &m_y}) {
        std::vector<double> distinct{sides->front()};
        for (std::size_t k = 1; k < sides->size(); k += 2) distinct.push_back((*sides)[k]);
        *sides = distinct;
    }
    measure();
}

void HeightMapPatch::calcPartials(const Vector2& uv, PatchPartials& partials) const {
    const Place x(m_x, uv.x()), y(m_y, uv.y());
    const Coefficients& cell = m_cells[x.cell + y.cell * (m_x.size() - 1)];
    const Eigen::Matrix3d z = x.calcPowers() * cell * y.calcPowers().transpose();
    partials.setZero();
    partials.col(0).head<2>() = uv;
    partials(0, 3) = partials(1, 1) = 1;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) partials(2, 3 * i + j) = z(i, j);
}

ImplicitValue HeightMapPatch::calcImplicit(const Vector3& p_S) const {
    const ParametricValue s = calcParametric(p_S.head<2>(), 0);
    Matrix3 hessian = Matrix3::Zero();
    hessian(0, 0) = -s.xuu.z(), hessian(1, 1) = -s.xvv.z();
    hessian(0, 1) = hessian(1, 0) = -s.xuv.z();
    return {p_S.z() - s.x.z(), Vector3(-s.xu.z(), -s.xv.z(), 1), hessian};
}

}  // namespace tautline
