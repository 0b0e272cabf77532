// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <utility>

#include "tautline/surfaces/surface.h"

namespace tautline {
namespace detail {

template <class T>
const T& dereference(const T& object) {
    return object;
}
template <class T>
const T& dereference(const std::shared_ptr<const T>& pointer) {
    return *pointer;
}

}  // namespace detail

/** Base of a surface that is made of another one: seen in another form, scaled, under a layer. Forwards what is by
default the base's; what a decorator changes it overrides.
@tparam Form   what it derives from: Surface, an ImplicitShape or a ParametricShape
@tparam Base   the surface by value, where its class is known, or a std::shared_ptr<const Surface> */
template <class Form, class Base>
class SurfaceDecorator : public Form {
public:
    const auto& getBase() const { return detail::dereference(m_base); }

    std::string getDescription() const override { return getBase().getDescription(); }
    double getSize() const override { return getBase().getSize(); }
    bool isConvex() const override { return getBase().isConvex(); }
    std::optional<Hole> getHole() const override { return getBase().getHole(); }
    double calcDomainMargin(const SurfacePoint& point) const override { return getBase().calcDomainMargin(point); }

protected:
    explicit SurfaceDecorator(Base base) : m_base(std::move(base)) {}

private:
    Base m_base;
};

}  // namespace tautline
