/** Every surface of the project obeys the laws of surface_laws.h, and a wrong one is found out. */
#include "tautline/surface_laws.h"

#include <gtest/gtest.h>

#include "support/surface_cases.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr unsigned kSeed = 20240607;

std::string join(const std::vector<std::string>& sentences) {
    std::string text;
    for (std::size_t i = 0; i < sentences.size() && i < 12; ++i) text += sentences[i] + "\n";
    return text + "(" + std::to_string(sentences.size()) + " in all, seed " + std::to_string(kSeed) + ")";
}

class SurfaceLaws : public ::testing::TestWithParam<testing::SurfaceCase> {};

TEST_P(SurfaceLaws, HoldAtRandomAndSpecialPoints) {
    const testing::SurfaceCase& c = GetParam();
    const auto samples = testing::makeSamples(*c.surface, c.extent, c.centre, c.length, c.specialPoints, 40, kSeed);
    SurfaceLawOptions options;
    options.differenceTolerance = c.differenceTolerance;
    const std::vector<std::string> broken = checkSurfaceLaws(*c.surface, samples, options);
    EXPECT_TRUE(broken.empty()) << join(broken);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceLaws, ::testing::ValuesIn(testing::makeSurfaceCases()),
                         [](const auto& instance) { return instance.param.name; });

/** A saddle as a user would write it, from the virtual base. */
class UserSaddle final : public ParametricSurface {
public:
    double getSize() const override { return 0.5; }
    std::string getDescription() const override { return "user's saddle"; }
    ParameterDomain getDomain() const override { return {Vec2(-1, -1), Vec2(1, 1)}; }
    ParametricValue calcParametric(const Vec2& uv, int) const override {
        const double u = uv[0], v = uv[1];
        return {{u, v, u * u - v * v}, {1, 0, 2 * u}, {0, 1, -2 * v}, {0, 0, 2}, Vec3::Zero(), {0, 0, -2}};
    }
};

TEST(UserSurfaces, WrittenFromTheVirtualBaseObeyTheLaws) {
    const UserSaddle saddle;
    const auto samples = testing::makeSamples(saddle, 0.6, Vec3::Zero(), 0.4, {Vec3::Zero()}, 20, kSeed);
    const std::vector<std::string> broken = checkSurfaceLaws(saddle, samples);
    EXPECT_TRUE(broken.empty()) << join(broken);
    EXPECT_TRUE(saddle.isInDomain(saddle.findSurfacePoint(Vec3(0.1, 0.2, 0))));
    EXPECT_FALSE(saddle.isInDomain(saddle.findSurfacePoint(Vec3(2, 0, 4))));
}

/** An ellipsoid whose user took one entry of the Hessian wrong. */
class WrongHessian final : public ImplicitShape<WrongHessian> {
public:
    double getSize() const override { return 0.03; }
    std::string getDescription() const override { return "wrong"; }
    ImplicitValue calcImplicit(const Vec3& p) const {
        ImplicitValue value = m_right.calcImplicit(p);
        value.hessian(0, 0) *= 1.01;
        return value;
    }

private:
    Ellipsoid m_right{Vec3(0.05, 0.03, 0.08)};
};

/** A sphere whose user took the inside for the outside. */
class InsideOut final : public ImplicitShape<InsideOut> {
public:
    double getSize() const override { return 0.4; }
    std::string getDescription() const override { return "inside out"; }
    ImplicitValue calcImplicit(const Vec3& p) const {
        ImplicitValue value = m_right.calcImplicit(p);
        return {value.f, -value.gradient, value.hessian};
    }

private:
    Sphere m_right{0.4};
};

bool names(const std::vector<std::string>& broken, const std::string& law) {
    for (const std::string& sentence : broken)
        if (sentence.find(law) != std::string::npos) return true;
    return false;
}

TEST(SurfaceLawsReport, FindsAWrongHessian) {
    const WrongHessian wrong;
    const auto samples = testing::makeSamples(wrong, 0.1, Vec3::Zero(), 0.1, {}, 10, kSeed);
    const std::vector<std::string> broken = checkSurfaceLaws(wrong, samples);
    EXPECT_TRUE(names(broken, "law 5 (kappaN")) << join(broken);
    EXPECT_TRUE(names(broken, "law 10")) << join(broken);
    EXPECT_FALSE(names(broken, "law 1 ")) << join(broken);
    EXPECT_FALSE(names(broken, "law 3 ")) << join(broken);
}

TEST(SurfaceLawsReport, FindsAFlippedGradient) {
    const InsideOut wrong;
    const std::vector<std::string> broken = checkSurfaceLaws(wrong, {{Vec3(0.4, 0, 0), Vec3(0.1, 1, 0), 0.3}});
    EXPECT_TRUE(names(broken, "law 3")) << join(broken);
}

TEST(SurfaceLawsReport, RefusesASampleWithoutLength) {
    EXPECT_THROW(checkSurfaceLaws(Sphere(1), {{Vec3(1, 0, 0), Vec3(0, 1, 0), 0}}), InvalidInput);
}

}  // namespace
}  // namespace tautline
