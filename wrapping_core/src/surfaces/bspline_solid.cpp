// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/bspline_solid.h"

#include <algorithm>
#include <cmath>

#include "surfaces/cubic_bspline.h"
#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<BSplineSolid>;

namespace {

constexpr int kMostAlongAxis = 1 << 20;  ///< bricks or coarse control values: products of three fit 64 bits
constexpr double kShortest = 1e-30, kLongest = 1e30;  ///< of what a grid may have [m]
constexpr double kLeastSlope = 0.7;                   ///< see calcHeightAndNormal()

/** A number that goes from 0 to 1 with t, with its derivatives by t: twice continuously differentiable. */
struct Step {
    double value, slope, bend;

    explicit Step(double t) {
        const double s = t > 0 ? std::min(t, 1.0) : 0.0, w = 1 - s;
        value = s * s * s * ((6 * s - 15) * s + 10), slope = 30 * s * s * w * w, bend = 60 * s * w * (w - s);
    }
};

/** A coordinate brought into a range, which it does not leave: within but for a margin at the ends it stays as it is,
and goes over smoothly (to the third derivative) into the end. */
struct Clamped {
    double value, slope, bend;

    Clamped(double x, double low, double high, double margin) {
        value = x, slope = 1, bend = 0;
        const double middle = 0.5 * (low + high), side = x > middle ? 1 : -1;
        const double t = (std::abs(x - middle) - (0.5 * (high - low) - margin)) / (2 * margin);
        if (!(t > 0)) return;
        const double s = std::min(t, 1.0);
        const Step step(s);
        const double cut = s * s * s * s * ((s - 3) * s + 2.5) + (t - s);  // integral of the step
        value = x - side * 2 * margin * cut, slope = 1 - step.value, bend = -side * step.slope / (2 * margin);
    }
};

struct Splines {
    CubicBSplines x, y, z;
};

/** Value, and the derivatives up to kOrder, of the tricubic spline on one cell, by places in cells.
@param controls   of the cell's lowest corner, 4 x 4 x 4 of a lattice whose slower indices have these strides */
template <int kOrder>
void sumSplines(const float* controls, std::ptrdiff_t strideX, std::ptrdiff_t strideY, const Splines& splines,
                ImplicitValue& value) {
    using Row = Eigen::Array4d;        // along z
    Row sums[kOrder + 1][kOrder + 1];  // by how often they are differentiated along x and y
    for (int k = 0; k <= kOrder; ++k)
        for (int l = 0; k + l <= kOrder; ++l) sums[k][l].setZero();
    for (int j = 0; j < 4; ++j) {
        Row inX[kOrder + 1];
        for (int k = 0; k <= kOrder; ++k) inX[k].setZero();
        for (int i = 0; i < 4; ++i) {
            const Row row = Eigen::Map<const Eigen::Array4f>(controls + i * strideX + j * strideY).cast<double>();
            for (int k = 0; k <= kOrder; ++k) inX[k] += splines.x(k, i) * row;
        }
        for (int k = 0; k <= kOrder; ++k)
            for (int l = 0; k + l <= kOrder; ++l) sums[k][l] += splines.y(l, j) * inX[k];
    }
    const auto sum = [&](int k, int l, int m) { return (splines.z.row(m).transpose().array() * sums[k][l]).sum(); };
    value.f = sum(0, 0, 0);
    value.gradient = Vector3(sum(1, 0, 0), sum(0, 1, 0), sum(0, 0, 1));
    if constexpr (kOrder == 2) {
        Matrix3& H = value.hessian;
        H(0, 0) = sum(2, 0, 0), H(1, 1) = sum(0, 2, 0), H(2, 2) = sum(0, 0, 2);
        H(0, 1) = H(1, 0) = sum(1, 1, 0), H(0, 2) = H(2, 0) = sum(1, 0, 1), H(1, 2) = H(2, 1) = sum(0, 1, 1);
    }
}

/** From derivatives by places in cells to those by coordinates. */
template <int kOrder>
void scaleDerivatives(double inverseSpacing, ImplicitValue& value) {
    value.gradient *= inverseSpacing;
    if constexpr (kOrder == 2) value.hessian *= inverseSpacing * inverseSpacing;
}

void requireCounts(const std::array<int, 3>& counts, int least, std::size_t has, const char* what) {
    std::size_t product = 1;
    for (const int count : counts) {
        require(count >= least && count <= kMostAlongAxis, "B-spline solid: needs ", least, " to ", int(kMostAlongAxis),
                " ", what, " along an axis, got ", count);
        product *= static_cast<std::size_t>(count);
    }
    require(has == product, "B-spline solid: needs ", product, " ", what, ", got ", has);
}

void requireHeights(const std::vector<float>& controls, double least, const char* what) {
    for (std::size_t i = 0; i < controls.size(); ++i)
        require(std::abs(controls[i]) <= kLongest && controls[i] >= least, "B-spline solid: ", what, " ", i, " is ",
                controls[i]);
}

/** A length whose powers, as they stand in curvatures, are numbers. */
void requireUsable(double length, const char* what) {
    requireLength(length, what);
    require(length >= kShortest && length <= kLongest, what, " must lie between ", kShortest, " and ", kLongest,
            " m, but is ", length);
}

void requireGrid(const SolidGrid& grid) {
    requireUsable(grid.spacing, "B-spline solid: spacing");
    requireUsable(grid.farSpacing, "B-spline solid: coarse spacing");
    requireUsable(grid.size, "B-spline solid: size");
    requireUsable(grid.width, "B-spline solid: width");
    requireUsable(grid.blendBegin, "B-spline solid: height where blending begins");
    require(std::isfinite(grid.blendEnd) && grid.blendEnd > grid.blendBegin, "B-spline solid: blending from height ",
            grid.blendBegin, " must end above it, but ends at ", grid.blendEnd);
    requireUsable(grid.blendEnd - grid.blendBegin, "B-spline solid: range of heights over which it is blended");
    require(grid.origin.cwiseAbs().maxCoeff() <= kLongest && grid.farOrigin.cwiseAbs().maxCoeff() <= kLongest,
            "B-spline solid: origins must be finite, and no farther away than ", kLongest, " m");
    requireCounts(grid.numBricks, 1, grid.bricks.size(), "bricks");
    // Five cells: two margins and something between.
    requireCounts(grid.numFarControls, 8, grid.farControls.size(), "coarse control values");
    require(grid.controls.size() % SolidGrid::kBrickControls == 0, "B-spline solid: needs ",
            int(SolidGrid::kBrickControls), " control values for each brick, got ", grid.controls.size(), " in all");
    const auto numFilled = static_cast<std::int64_t>(grid.controls.size() / SolidGrid::kBrickControls);
    for (std::size_t i = 0; i < grid.bricks.size(); ++i)
        require(grid.bricks[i] >= SolidGrid::kInside && grid.bricks[i] < numFilled, "B-spline solid: brick ", i,
                " names control values ", grid.bricks[i], ", but there are ", numFilled);
    requireHeights(grid.controls, -kLongest, "control value");
    requireHeights(grid.farControls, 0, "coarse control value");
}

}  // namespace

BSplineSolid::BSplineSolid(SolidGrid grid) : m_grid(std::move(grid)) {
    requireGrid(m_grid);
    m_inverseSpacing = 1 / m_grid.spacing;
    m_inverseFarSpacing = 1 / m_grid.farSpacing;
}

std::string BSplineSolid::getDescription() const {
    return describeShape("B-spline solid(size=", m_grid.size, ", width=", m_grid.width, ", grid=", m_grid.spacing, ", ",
                         m_grid.controls.size() / SolidGrid::kBrickControls, " bricks)");
}

Eigen::AlignedBox3d BSplineSolid::calcBox() const {
    const double brick = SolidGrid::kBrick * m_grid.spacing;
    const Vector3 sides(m_grid.numBricks[0], m_grid.numBricks[1], m_grid.numBricks[2]);
    return {m_grid.origin, m_grid.origin + brick * sides};
}

std::int32_t BSplineSolid::findBrick(const Vector3& place, Vector3& inBrick) const {
    std::size_t index = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double inBricks = place[axis] / SolidGrid::kBrick;
        if (!(inBricks >= 0 && inBricks < m_grid.numBricks[axis])) return SolidGrid::kOutside;  // NaN, too
        const int brick = static_cast<int>(inBricks);
        inBrick[axis] = place[axis] - brick * SolidGrid::kBrick;
        index = index * static_cast<std::size_t>(m_grid.numBricks[axis]) + static_cast<std::size_t>(brick);
    }
    return m_grid.bricks[index];
}

template <int kOrder>
void BSplineSolid::calcNear(const float* controls, const Vector3& inBrick, ImplicitValue& value) const {
    constexpr int kControls = SolidGrid::kControls;
    std::array<int, 3> cell;
    for (int axis = 0; axis < 3; ++axis) cell[axis] = std::min(static_cast<int>(inBrick[axis]), SolidGrid::kBrick - 1);
    const Splines splines{calcCubicBSplines(inBrick.x() - cell[0]), calcCubicBSplines(inBrick.y() - cell[1]),
                          calcCubicBSplines(inBrick.z() - cell[2])};
    sumSplines<kOrder>(controls + (cell[0] * kControls + cell[1]) * kControls + cell[2], kControls * kControls,
                       kControls, splines, value);
    scaleDerivatives<kOrder>(m_inverseSpacing, value);
}

/** The spline at the place brought into the box of coarse cells, plus sqrt(margin^2 + |p - that place|^2) - margin. */
template <int kOrder>
void BSplineSolid::calcFar(const Vector3& p, ImplicitValue& value) const {
    const double margin = m_grid.farSpacing;
    const std::array<int, 3>& counts = m_grid.numFarControls;
    Vector3 beyond, slope, bend;
    std::array<int, 3> cell;
    Splines splines;
    CubicBSplines* const along[] = {&splines.x, &splines.y, &splines.z};
    for (int axis = 0; axis < 3; ++axis) {
        const int numCells = counts[axis] - 3;
        const double low = m_grid.farOrigin[axis];
        const Clamped clamped(p[axis], low, low + numCells * m_grid.farSpacing, margin);
        beyond[axis] = p[axis] - clamped.value, slope[axis] = clamped.slope, bend[axis] = clamped.bend;
        const double place = (clamped.value - low) * m_inverseFarSpacing;
        cell[axis] = place > 0 ? static_cast<int>(std::min(place, numCells - 1.0)) : 0;  // NaN: 0
        *along[axis] = calcCubicBSplines(place - cell[axis]);
    }
    const std::ptrdiff_t strideY = counts[2], strideX = counts[1] * strideY;
    sumSplines<kOrder>(m_grid.farControls.data() + cell[0] * strideX + cell[1] * strideY + cell[2], strideX, strideY,
                       splines, value);
    scaleDerivatives<kOrder>(m_inverseFarSpacing, value);
    const double distance = std::sqrt(margin * margin + beyond.squaredNorm());
    value.f += distance - margin;
    // By the chain rule, along each axis: the place has `slope` and `bend`, what is beyond it 1 - slope and -bend.
    const Vector3 away = beyond / distance, rate = (Vector3::Ones() - slope).cwiseProduct(away);
    if constexpr (kOrder == 2) {
        value.hessian = value.hessian.cwiseProduct(slope * slope.transpose());
        const Vector3 curved = bend.cwiseProduct(value.gradient - away);
        value.hessian.diagonal() += curved + (Vector3::Ones() - slope).cwiseAbs2() / distance;
        value.hessian -= rate * rate.transpose() / distance;
    }
    value.gradient = slope.cwiseProduct(value.gradient) + rate;
}

template <int kOrder>
void BSplineSolid::calcFunction(const Vector3& p, ImplicitValue& value) const {
    Vector3 inBrick;
    const std::int32_t brick = findBrick((p - m_grid.origin) * m_inverseSpacing, inBrick);
    if (brick >= 0) {
        calcNear<kOrder>(m_grid.controls.data() + std::ptrdiff_t(brick) * SolidGrid::kBrickControls, inBrick, value);
        if (std::abs(value.f) <= m_grid.blendBegin) return;
    }
    ImplicitValue far;
    calcFar<kOrder>(p, far);
    const bool isInside = brick >= 0 ? value.f < 0 : brick == SolidGrid::kInside;
    const double side = isInside ? -1 : 1;
    far.f *= side, far.gradient *= side;
    if constexpr (kOrder == 2) far.hessian *= side;
    if (brick < 0) {
        value.f = far.f, value.gradient = far.gradient;
        if constexpr (kOrder == 2) value.hessian = far.hessian;
        return;
    }
    const double range = m_grid.blendEnd - m_grid.blendBegin;
    const Step step((std::abs(value.f) - m_grid.blendBegin) / range);
    const double slope = side * step.slope / range, apart = far.f - value.f;
    const Vector3 gradient = value.gradient, apartGradient = far.gradient - gradient;
    if constexpr (kOrder == 2) {
        const Matrix3 cross = gradient * apartGradient.transpose();
        value.hessian = (1 - step.value + slope * apart) * value.hessian + step.value * far.hessian +
                        slope * (cross + cross.transpose()) +
                        apart * step.bend / (range * range) * (gradient * gradient.transpose());
    }
    value.gradient += step.value * apartGradient + slope * apart * gradient;
    value.f += step.value * apart;
}

ImplicitValue BSplineSolid::calcImplicit(const Vector3& p) const {
    ImplicitValue value;
    calcFunction<2>(p, value);
    return value;
}

/** f over the length of its gradient, which is 1 but where smoothing has rounded a ridge of the distance off: there f
itself is nearer to the distance. */
double BSplineSolid::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    ImplicitValue value;
    calcFunction<1>(p_S, value);
    const double slope = value.gradient.norm();
    N_S = slope > 0 ? Vector3(value.gradient / slope) : Vector3(Vector3::UnitX());
    return value.f / std::max(slope, kLeastSlope);
}

}  // namespace tautline
