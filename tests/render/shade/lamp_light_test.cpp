#include "render/shade/lamp_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/look/night_sky.h"
#include "tests/render/frames.h"
#include "world/weather/weather_text.h"

namespace reprise::render {
namespace {

using Eigen::Vector3f;

/// A head lamp ahead of the place, which shines towards it.
LightSource lamp(float ahead, float candela) {
    return {{ahead, 0, 0.66F},
            -Vector3f::UnitX(),
            -Vector3f::UnitY(),
            Color::Constant(candela * lux / pi),
            75,
            0.08F,
            LightSource::Lobe::low_beam};
}

/// A place on level ground, an overcast night.
class Place {
  public:
    LampLight light(const std::vector<LightSource>& lamps, float roughness) const {
        const SourceGrid grid(lamps, {0, 0, 2});
        NearSources near(grid);
        Look look;
        look.normal = Vector3f::UnitZ();
        look.roughness = roughness;
        return LampSum(input_, near, look, Vector3f::Zero(), Vector3f(1, 0, -0.7F).normalized())
            .light();
    }

  private:
    TownScene town_{test::straight_road(400), false};
    Scene scene_{town_};
    Sky sky_{world::read_weather("snowfall_night").weather};
    ShadingInput input_{scene_, sky_, 0};
};

/// Neighbours' answers about the rest count by what it gives: where a lamp that hardly gives
/// anything began to, they were half of all light, and an outline ran through shadows.
TEST(LampSum, ALampThatBeginsToShineChangesSharesEvenly) {
    const Place place;
    float last = 1;
    for (float weak = 0; weak < 15000; weak += 75) {
        const LampLight light = place.light({lamp(12, 15000), lamp(14, weak)}, 0.8F);
        ASSERT_NEAR(light.strongest, last, 0.02F) << weak;
        last = light.strongest;
    }
    EXPECT_LT(last, 0.8F);
}

TEST(LampSum, HighlightsEndEvenlyAsGroundGetsDull) {
    const Place place;
    float last = place.light({lamp(12, 15000)}, 0.15F).shine.x();
    float most = last;
    float widest = 0;
    for (float roughness = 0.15F; roughness < 0.7F; roughness += 0.0025F) {
        const float shine = place.light({lamp(12, 15000)}, roughness).shine.x();
        most = std::max(most, shine);
        widest = std::max(widest, std::abs(shine - last));
        last = shine;
    }
    EXPECT_GT(most, 0);
    EXPECT_EQ(last, 0);
    EXPECT_LT(widest, 0.05F * most);
}

}  // namespace
}  // namespace reprise::render
