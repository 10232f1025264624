#include "render/shade/source_grid.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "render/look/night_sky.h"

namespace reprise::render {
namespace {

using Eigen::Vector3f;

constexpr float candela = lux / pi;

/// A head lamp, which looks along a yaw. [rad]
LightSource beam(float x, float y, float yaw) {
    const Vector3f ahead(std::cos(yaw), std::sin(yaw), 0);
    return {{x, y, 0.66F},
            ahead,
            Vector3f::UnitZ().cross(ahead),
            Color::Constant(15000 * candela),
            75,
            0.08F,
            LightSource::Lobe::low_beam};
}

LightSource window(float x) {
    return {{x, 12, 1.6F},
            -Vector3f::UnitY(),
            Vector3f::Zero(),
            Color::Constant(240 * candela),
            13,
            0.8F,
            LightSource::Lobe::window};
}

/// A car's tail is lit by the one that follows it as far behind, whose lamps are far weaker there
/// than those of the car itself, which shine ahead. Where a square forgot them, an edge went
/// through the picture of the tail.
TEST(SourceGrid, WhoFollowsACarLightsItWhereverItsSquaresEnd) {
    std::vector<LightSource> sources{beam(-1, 0.6F, 0), beam(-1, -0.6F, 0)};
    for (const float x : {-4.0F, -1.0F, 2.0F})
        sources.push_back(window(x));
    for (const float y : {-22.0F, -19.0F, 24.0F, 27.0F})  // who drives across behind it
        for (const float side : {0.6F, -0.6F})
            sources.push_back(beam(-14 + side, y, y < 0 ? 1.5F : -1.5F));
    const auto follower = static_cast<std::uint16_t>(sources.size());
    sources.push_back(beam(-53, 0.6F, 0));
    const SourceGrid grid(sources, {-6, 0, 2});
    for (float y = -0.9F; y <= 0.9F; y += 0.3F) {
        const auto near = grid.near(grid.cell({-5.6F, y, 0.8F}));
        EXPECT_NE(std::find(near.begin(), near.end(), follower), near.end()) << y;
    }
}

/// Lanes of what stands in a four.
std::array<float, 4> places(const FourSources& four) {
    alignas(16) std::array<float, 4> found;
    _mm_store_ps(found.data(), four.position.x);
    return found;
}

TEST(NearSources, AreThoseOfTheSquareOfThePlaceThatWasAskedForLast) {
    std::vector<LightSource> sources;
    for (int i = 0; i < 40; ++i) {
        sources.push_back(window(static_cast<float>(3 * i - 60)));
        sources.push_back(beam(static_cast<float>(3 * i - 60), 3, 0.1F * static_cast<float>(i)));
    }
    const SourceGrid grid(sources, {0, 0, 2});
    NearSources near(grid);
    for (const float x : {-40.0F, -38.0F, 5.0F, 4000.0F, 30.0F, 31.0F, 5.0F, -40.0F}) {
        const Vector3f place(x, 4, 0);
        near.gather(place);
        const auto all = grid.near(grid.cell(place));
        ASSERT_EQ(near.size(), all.size());
        EXPECT_EQ(all.empty(), x > 1000);
        for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_EQ(near.source(i).position, sources[all[i]].position);
            EXPECT_EQ(places(near.four(i - i % 4))[i % 4], sources[all[i]].position.x());
            EXPECT_TRUE(near.four(i - i % 4).any(sources[all[i]].lobe));
        }
    }
}

}  // namespace
}  // namespace reprise::render
