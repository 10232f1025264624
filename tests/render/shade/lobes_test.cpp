#include "render/shade/lobes.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

namespace reprise::render {
namespace {

using Eigen::Vector3f;
using Lobe = LightSource::Lobe;

constexpr std::array<Lobe, 6> all_lobes{
    Lobe::street, Lobe::lantern, Lobe::lens, Lobe::signal, Lobe::window, Lobe::low_beam};

/// What hangs looks down, all else along x.
LightSource source(Lobe lobe) {
    const bool hangs = lobe == Lobe::street || lobe == Lobe::lantern;
    return {Vector3f::Zero(),
            hangs ? Vector3f(0, 0, -1) : Vector3f(1, 0, 0),
            lobe == Lobe::low_beam ? Vector3f(0, 1, 0) : Vector3f(0, 0, 0),
            Color::Ones(),
            40,
            0.1F,
            lobe};
}

/// Of four lobes, each along its own way.
std::array<float, 4> shares(const std::array<Lobe, 4>& lobes, const std::array<Vector3f, 4>& ways) {
    std::array<SourceRow, 4> rows;
    for (std::size_t i = 0; i < 4; ++i)
        rows[i] = SourceRow(source(lobes[i]));
    const Lanes3 way(_mm_setr_ps(ways[0].x(), ways[1].x(), ways[2].x(), ways[3].x()),
                     _mm_setr_ps(ways[0].y(), ways[1].y(), ways[2].y(), ways[3].y()),
                     _mm_setr_ps(ways[0].z(), ways[1].z(), ways[2].z(), ways[3].z()));
    alignas(16) std::array<float, 4> found;
    _mm_store_ps(found.data(), lobe_shares({rows[0], rows[1], rows[2], rows[3]}, way));
    return found;
}

float share(Lobe lobe, const Vector3f& way) {
    return shares({lobe, lobe, lobe, lobe}, {way, way, way, way})[0];
}

/// To the left of the axis and over it.
Vector3f turned(float left_deg, float up_deg) {
    constexpr float degree = 0.0174532925F;
    return {std::cos(left_deg * degree) * std::cos(up_deg * degree),
            std::sin(left_deg * degree) * std::cos(up_deg * degree),
            std::sin(up_deg * degree)};
}

TEST(Lobes, AreTheSameWhateverTheThreeBesideAre) {
    std::mt19937 draw(5);
    std::normal_distribution<float> number;
    for (int turn = 0; turn < 2000; ++turn) {
        std::array<Lobe, 4> lobes;
        std::array<Vector3f, 4> ways;
        for (std::size_t i = 0; i < 4; ++i) {
            lobes[i] = all_lobes[draw() % all_lobes.size()];
            ways[i] = Vector3f(number(draw), number(draw), number(draw)).normalized();
        }
        const std::array<float, 4> together = shares(lobes, ways);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(together[i], share(lobes[i], ways[i]));
            EXPECT_GE(together[i], 0);
            EXPECT_LE(together[i], 1.1F);
        }
    }
}

TEST(Lobes, OfWhatHangsGoDownAndOfLensesAhead) {
    EXPECT_EQ(share(Lobe::street, {0.8F, 0, 0.6F}), 0) << "over the horizon";
    EXPECT_GT(share(Lobe::street, {0.8F, 0, -0.6F}), share(Lobe::street, {0, 0, -1}))
        << "least straight down";
    EXPECT_GT(share(Lobe::lantern, {1, 0, 0}), 0.9F);
    EXPECT_EQ(share(Lobe::lantern, {0, 0, 1}), 0);
    for (const Lobe lobe : {Lobe::lens, Lobe::signal, Lobe::window}) {
        EXPECT_FLOAT_EQ(share(lobe, {1, 0, 0}), 1);
        EXPECT_EQ(share(lobe, {-1, 0, 0}), 0);
    }
    EXPECT_LT(share(Lobe::lens, turned(45, 0)), share(Lobe::window, turned(45, 0)));
    // EN 12368: no arcade beside the road is painted green.
    EXPECT_NEAR(share(Lobe::signal, turned(12, 0)), 0.5F, 0.05F);
    EXPECT_LT(share(Lobe::signal, turned(30, 0)), 0.011F);
}

/// ECE R112: dazzles nobody who comes, and shows the kerb's side farther.
TEST(Lobes, OfALowBeamEndsAtALineThatRisesOnTheKerbsSide) {
    const float brightest = share(Lobe::low_beam, turned(0, -1.2F));
    EXPECT_GT(brightest, 0.7F);
    EXPECT_LT(share(Lobe::low_beam, turned(0, 1)), 0.02F * brightest);
    EXPECT_LT(share(Lobe::low_beam, turned(3, 0.5F)), 0.02F * brightest) << "who comes";
    EXPECT_GT(share(Lobe::low_beam, turned(-3, 0)), 0.3F * brightest) << "the kerb";
    EXPECT_LT(share(Lobe::low_beam, turned(0, -12)), 0.2F * brightest) << "just before the car";
    EXPECT_EQ(share(Lobe::low_beam, turned(80, -1.2F)), 0);
    EXPECT_EQ(share(Lobe::low_beam, turned(180, -1.2F)), 0);
}

/// From where half of what is just below its line arrives to where an eighth does. [degrees]
float edge(float left_deg) {
    const auto highest = [&](float part) {
        const float most = share(Lobe::low_beam, turned(left_deg, -1));
        float up = 8;
        while (share(Lobe::low_beam, turned(left_deg, up)) < part * most)
            up -= 0.02F;
        return up;
    };
    return highest(0.125F) - highest(0.5F);
}

TEST(Lobes, OfALowBeamEndSoftlyOnFacadesAndSharplyBeforeWhoComes) {
    EXPECT_LT(edge(2), 0.6F);
    for (const float left : {40.0F, -40.0F})
        EXPECT_GT(edge(left), 0.9F) << left;
}

/// What a low beam 0.66 m above the road gives it, so far ahead and to the left. [lx a candela]
float on_road(float ahead, float left) {
    const Vector3f way(ahead, left, -0.66F);
    const float distance = way.norm();
    return share(Lobe::low_beam, way / distance) * 0.66F / (distance * distance * distance);
}

TEST(Lobes, OfALowBeamLieOnTheRoadAsACarpetWithoutAnEdge) {
    for (const float ahead : {4.0F, 6.0F, 10.0F, 15.0F, 25.0F}) {
        const float middle = on_road(ahead, 0);
        float last = middle;
        for (float left = 0.25F; left < 15; left += 0.25F) {
            const float here = on_road(ahead, left);
            EXPECT_LE(here, last * 1.001F) << ahead << ", " << left;
            EXPECT_LE(last - here, 0.16F * middle) << ahead << ", " << left;
            last = here;
        }
        // No two cones: what the other lamp's middle gets, 1.3 m aside, is about half, or more.
        EXPECT_GT(on_road(ahead, 1.3F), 0.48F * middle) << ahead;
    }
    // Ahead it falls steadily: no spot before the car, no dark gap.
    for (float ahead = 3.5F; ahead < 40; ahead += 0.5F) {
        const float ratio = on_road(ahead + 0.5F, 0) / on_road(ahead, 0);
        EXPECT_LT(ratio, 1.01F) << ahead;
        EXPECT_GT(ratio, 0.75F) << ahead;
    }
}

}  // namespace
}  // namespace reprise::render
