// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/blend.h"

#include <algorithm>
#include <cmath>

#include "surfaces/nearest_point.h"
#include "surfaces/shape_checks.h"

namespace tautline {

template class ImplicitShape<Blend>;

namespace {

/** Signed distance of a part in the blend's frame. */
ImplicitValue calcPartDistance(const BlendPart& part, const Vector3& p_S) {
    const Pose& X = part.X_SP;
    const ImplicitValue own = calcSignedDistance(*part.surface, X.shiftBack(p_S));
    return {own.f, X.rotate(own.gradient), X.R * own.hessian * X.R.transpose()};
}

/** m(a, b) of the header: with x = a - b, m = (a + b)/2 - |x|/2 - k/6 (1 - |x|/k)^3 inside the band |x| < k. */
ImplicitValue blend(const ImplicitValue& a, const ImplicitValue& b, double k) {
    const double x = a.f - b.f;
    if (std::abs(x) >= k) return x < 0 ? a : b;
    const double sign = x < 0 ? -1 : 1, rest = 1 - std::abs(x) / k;
    const double m_x = -0.5 * sign * (1 - rest * rest), m_xx = -rest / k;  // by x, at constant a + b
    const Vector3 gradient_x = a.gradient - b.gradient;
    return {std::min(a.f, b.f) - k / 6 * rest * rest * rest, 0.5 * (a.gradient + b.gradient) + m_x * gradient_x,
            0.5 * (a.hessian + b.hessian) + m_x * (a.hessian - b.hessian) + m_xx * gradient_x * gradient_x.transpose()};
}

void checkPart(const BlendPart& part, std::size_t index) {
    require(part.surface != nullptr, "blend: part ", index, " has no surface");
    const SurfacePoint anywhere = part.surface->findSurfacePoint(Vector3::Constant(part.surface->getSize()));
    require(part.surface->calcDomainMargin(anywhere) == kInfinity, "blend: part ", index, ", ",
            part.surface->getDescription(), ", has an edge, but parts must be closed or endless");
    require(part.X_SP.p.allFinite() && part.X_SP.R.allFinite(), "blend: the pose of part ", index, " is not finite");
    constexpr double kRounding = 1e-9;
    require((part.X_SP.R.transpose() * part.X_SP.R - Matrix3::Identity()).norm() < kRounding &&
                part.X_SP.R.determinant() > 0,
            "blend: the rotation of part ", index, " is none: its columns must be orthonormal and right-handed");
}

}  // namespace

Blend::Blend(std::vector<BlendPart> parts, double radius) : m_parts(std::move(parts)), m_radius(radius) {
    requireLength(radius, "blend: radius");
    require(!m_parts.empty(), "blend: needs at least one part");
    m_size = kInfinity;
    for (std::size_t i = 0; i < m_parts.size(); ++i) {
        checkPart(m_parts[i], i);
        m_size = std::min(m_size, m_parts[i].surface->getSize());
    }
}

std::string Blend::getDescription() const {
    std::string text = describeShape("blend(radius=", m_radius);
    for (const BlendPart& part : m_parts) text += ", " + part.surface->getDescription();
    return text + ")";
}

ImplicitValue Blend::calcImplicit(const Vector3& p_S) const {
    const double k = 2 * std::sqrt(2) * m_radius;
    ImplicitValue value = calcPartDistance(m_parts.front(), p_S);
    for (std::size_t i = 1; i < m_parts.size(); ++i) value = blend(value, calcPartDistance(m_parts[i], p_S), k);
    return value;
}

std::shared_ptr<const Blend> makeBlend(const std::vector<std::shared_ptr<const Surface>>& surfaces, double radius) {
    std::vector<BlendPart> parts;
    for (const auto& surface : surfaces) parts.push_back({surface, Pose()});
    return std::make_shared<Blend>(std::move(parts), radius);
}

}  // namespace tautline
