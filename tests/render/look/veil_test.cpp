#include "render/look/veil.h"

#include <cmath>

#include <gtest/gtest.h>

#include "render/shade/light.h"
#include "world/weather/air.h"
#include "world/weather/weather_text.h"

namespace reprise::render {
namespace {

world::Weather weather(const std::string& text) {
    return world::read_weather(text).weather;
}

TEST(Veil, LeavesFivePercentOfContrastAtTheRange) {
    for (const char* range : {"10", "50", "200", "2000"}) {
        const Veil veil(weather(std::string("fog=") + range));
        EXPECT_NEAR(veil.passes(2, 0, std::stof(range)), 0.05F, 0.0003F) << range << " m (WMO)";
    }
}

/// Koschmieder: of two cards that stand equally far, the difference falls as e^(-extinction d).
TEST(Veil, CardsLoseContrastByKoschmieder) {
    for (const float range : {10.0F, 50.0F, 200.0F}) {
        const Sky sky(weather("overcast_noon,fog=" + std::to_string(range)));
        const Eigen::Vector3f from(0, 0, 1.4F);
        for (const float distance : {10.0F, 50.0F, 200.0F}) {
            const auto seen = [&](float card) {
                return through_atmosphere(
                    sky, Color::Constant(card), from, Eigen::Vector3f::UnitX(), distance);
            };
            const Color contrast = (seen(0.9F) - seen(0.1F)) / 0.8F;
            EXPECT_NEAR(contrast.y(), std::exp(-3 * distance / range), 1e-5F)
                << distance << " m away in fog of " << range << " m";
            // Far away is the colour of the air, and as bright as the sky there.
            const Color far =
                through_atmosphere(sky, Color::Zero(), from, Eigen::Vector3f::UnitX(), 1e5F);
            EXPECT_NEAR(far.y(), sky.haze(Eigen::Vector3f::UnitX()).y(), 1e-5F);
        }
    }
}

TEST(Veil, OfFogThatThinsUpwardsIsTheIntegralOverTheWay) {
    const world::Weather said = weather("clear_noon,fog=80,fog_base=4,fog_falloff=0.15");
    Veil veil(said);
    veil.stand_on(-7);  // the scene's origin lies 7 m above the lowest ground
    for (const float from : {-7.0F, -4.0F, 0.0F, 20.0F})
        for (const float rise : {-0.1F, -0.01F, 0.0F, 0.001F, 0.2F, 0.9F}) {
            const float distance = 60;
            const double low = static_cast<double>(from) + 7;
            const double end = low + static_cast<double>(rise) * 60;
            const double depth =
                60 * (world::mean_fog_extinction(said, low, end) + world::even_extinction(said));
            EXPECT_NEAR(veil.passes(from, rise, distance), std::exp(-depth), 2e-4)
                << "from " << from << " rising " << rise;
        }
}

TEST(Veil, AFalloffOfAlmostNothingIsNone) {
    const Veil none(weather("fog=80"));
    const Veil little(weather("fog=80,fog_falloff=0.000001"));
    for (const float rise : {-0.5F, 0.0F, 0.5F})
        EXPECT_NEAR(none.passes(1, rise, 50), little.passes(1, rise, 50), 1e-4F);
}

}  // namespace
}  // namespace reprise::render
