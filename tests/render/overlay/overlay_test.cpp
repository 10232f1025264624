#include "render/overlay/overlay.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "render/overlay/tags.h"
#include "render/sensors.h"
#include "tests/render/frames.h"
#include "world/models/catalogue.h"

namespace reprise {

namespace {

using render::Area;
using render::OverlayText;
using render::Tag;
using render::Tone;

const world::VehicleModel& first_model() {
    return world::vehicle_models()[0];
}

/// What a camera on a pole sees of a tick, and the tags of it.
class Seen {
  public:
    Seen(const world::SealedTick& tick, const render::ActorNames& names) {
        spec_ = test::camera(world::SensorKind::depth, {100, -1.75, 1.4});
        render::Sensors sensors(test::straight_road(400));
        const auto frames = sensors.observe(tick.view(), {spec_}, test::noon());
        tags = render::tags_of(
            tick.view(), names, render::Camera(spec_, Eigen::Isometry3d::Identity()), frames[0], 0);
    }

    const Tag* of(std::uint32_t actor) const {
        const auto tag = std::find_if(
            tags.begin(), tags.end(), [&](const Tag& one) { return one.actor == actor; });
        return tag == tags.end() ? nullptr : &*tag;
    }

    std::vector<Tag> tags;

  private:
    world::SensorSpec spec_;
};

/// A picture without two equal neighbours.
world::SensorFrame noise(int width, int height) {
    world::SensorFrame frame;
    frame.width = width;
    frame.height = height;
    frame.channels = 3;
    std::uint32_t state = 1;
    for (int i = 0; i < 3 * width * height; ++i) {
        state = state * 1664525U + 1013904223U;
        frame.data.push_back(static_cast<std::uint8_t>(64 + (state >> 25U)));
    }
    return frame;
}

bool is_in(const Area& area, int x, int y) {
    return x >= area.left && x < area.right && y >= area.top && y < area.bottom;
}

OverlayText some_text() {
    return {
        {{"12.35 s  tick 247"}, {"ego 43 km/h  main_1"}},
        {{"collision: ego with van, 12246 N s", Tone::bad}, {"check passed: braked", Tone::good}},
        render::OverlayLine{"failed: collision", Tone::bad}};
}

Tag tag_at(double x, double y, const std::string& text = "ego 43 km/h") {
    return {1, text, x, y, 20, true, false};
}

}  // namespace

TEST(Tags, StandWhereTheTraceHasTheActor) {
    const render::ActorNames names{{1, "ego"}};
    for (const double side : {-6.0, 0.0, 3.0}) {
        const Seen seen(test::tick_with({test::vehicle_at(1, 125, -1.75 + side, 0, 12)}), names);
        ASSERT_NE(seen.of(1), nullptr) << side;
        const Tag& tag = *seen.of(1);
        // By hand: 80 px are as wide as far (90 degrees); the roof's far edge is the highest in a
        // picture from below it, its near one from above. 0.25 m of air.
        const world::VehicleModel& model = first_model();
        const double middle = 25 - model.rear_overhang + model.length / 2;
        const double up = model.height + 0.25 - 1.4;
        const double edge =
            up < 0 ? 25 - model.rear_overhang + model.length : 25 - model.rear_overhang;
        EXPECT_NEAR(tag.x, 80 - 80 * side / middle, 0.01) << side;
        EXPECT_NEAR(tag.y, 60 - 80 * up / edge, 0.01) << side;
        EXPECT_NEAR(tag.depth, middle, 0.01);
        EXPECT_EQ(tag.text, "ego 43 km/h");
        EXPECT_TRUE(tag.named);
        EXPECT_FALSE(tag.hidden);
    }
}

TEST(Tags, OfTheScenarioAreFaintBehindSomethingAndOfTheDemandThenNone) {
    const auto lorry = *world::find_vehicle_model("lorry");
    world::CarState wall = test::car_at(10, 112, -1.75);
    wall.mutate_model(lorry);
    const std::vector<world::CarState> cars{
        wall, test::car_at(1'000'001, 135, -1.75), test::car_at(1'000'002, 130, 6)};
    const Seen seen(test::tick_with({test::vehicle_at(1, 128, -1.75)}, cars), {{1, "ego"}});
    ASSERT_NE(seen.of(1), nullptr);
    EXPECT_TRUE(seen.of(1)->hidden);
    EXPECT_EQ(seen.of(1'000'001), nullptr) << "behind the lorry as well";
    ASSERT_NE(seen.of(1'000'002), nullptr) << "beside it";
    EXPECT_EQ(seen.of(1'000'002)->text, "0 km/h");
    EXPECT_FALSE(seen.of(1'000'002)->named);
}

TEST(Tags, NobodyBehindTheCameraOrBesideThePictureHasOne) {
    const std::vector<world::CarState> cars{test::car_at(2, 90, -1.75), test::car_at(3, 110, 40)};
    EXPECT_TRUE(Seen(test::tick_with({}, cars), {{2, "behind"}, {3, "beside"}}).tags.empty());
}

TEST(Overlay, ChangesNothingOutsideOfWhatItSays) {
    for (const auto& [width, height] :
         {std::pair(64, 48), std::pair(160, 120), std::pair(801, 601), std::pair(1600, 300)}) {
        const world::SensorFrame before = noise(width, height);
        world::SensorFrame picture = before;
        const std::vector<Tag> tags{tag_at(width * 0.5, height * 0.6),
                                    tag_at(width * 0.52, height * 0.6, "van 0 km/h"),
                                    tag_at(-20, height * 0.7),
                                    tag_at(width * 0.9, -5)};
        const render::Written written = render::write_overlay(picture, tags, some_text());
        std::vector<Area> areas = written.tags;
        areas.insert(areas.end(), written.stems.begin(), written.stems.end());
        areas.insert(areas.end(), written.text.begin(), written.text.end());
        areas.push_back(render::write_scale(picture, 0.1, 1.5));
        int changed = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto at = static_cast<std::size_t>(3 * (y * width + x));
                const bool same = std::equal(picture.data.begin() + static_cast<long>(at),
                                             picture.data.begin() + static_cast<long>(at + 3),
                                             before.data.begin() + static_cast<long>(at));
                const bool inside = std::any_of(areas.begin(), areas.end(), [&](const Area& area) {
                    return is_in(area, x, y);
                });
                ASSERT_TRUE(same || inside) << x << ' ' << y << " of " << width;
                changed += same ? 0 : 1;
            }
        EXPECT_GT(changed, width * height / 50);
    }
}

TEST(Overlay, TagsStandOverTheirPointsAndNotOnEachOther) {
    world::SensorFrame picture = noise(800, 600);
    const std::vector<Tag> tags{tag_at(400, 300), tag_at(405, 302, "van 0 km/h"), tag_at(100, 350)};
    const render::Written written = render::write_overlay(picture, tags, {});
    ASSERT_EQ(written.tags.size(), 3U);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const Area& area = written.tags[i];
        EXPECT_NEAR((area.left + area.right) / 2.0, tags[i].x, 1);
        EXPECT_LE(area.bottom, std::lround(tags[i].y));
        EXPECT_GE(area.bottom - area.top, 600 / 42) << "letters as large as the picture asks for";
    }
    EXPECT_EQ(written.tags[2].bottom, 350);
    EXPECT_EQ(written.tags[1].bottom, 302) << "the nearest, which is the last, chooses first";
    EXPECT_EQ(written.tags[0].bottom, written.tags[1].top);
    EXPECT_EQ(written.stems.size(), 1U) << "down to the point of the one that had to rise";
}

TEST(Overlay, InAJamWhoHasNoNameGivesWay) {
    world::SensorFrame picture = noise(800, 600);
    std::vector<Tag> tags;
    for (int i = 0; i < 20; ++i)
        tags.push_back({1'000'001U + static_cast<unsigned>(i), "8 km/h", 400.0 + i, 300, 40.0 - i});
    tags.push_back(tag_at(380, 300));
    const render::Written written = render::write_overlay(picture, tags, {});
    const auto shown = std::count_if(
        written.tags.begin(), written.tags.end(), [](const Area& area) { return area.bottom > 0; });
    EXPECT_EQ(shown, 1);
    EXPECT_EQ(written.tags.back().bottom, 300) << "who has one stays in its place";
}

TEST(Overlay, LettersStandOutOnAnyPicture) {
    for (const std::uint8_t ground : {std::uint8_t{0}, std::uint8_t{128}, std::uint8_t{255}}) {
        world::SensorFrame picture = noise(320, 240);
        std::fill(picture.data.begin(), picture.data.end(), ground);
        const render::Written written =
            render::write_overlay(picture, {}, {{{"12.35 s"}}, {}, std::nullopt});
        ASSERT_EQ(written.text.size(), 1U);
        int light = 0;
        int dark = 0;
        const Area& area = written.text[0];
        for (int y = area.top; y < area.bottom; ++y)
            for (int x = area.left; x < area.right; ++x) {
                const int grey = picture.data[static_cast<std::size_t>(3 * (y * 320 + x))];
                light += grey > 190 ? 1 : 0;
                dark += grey < 60 ? 1 : 0;
            }
        EXPECT_GT(light, 40) << "strokes on " << int{ground};
        EXPECT_GT(dark, 40) << "their outline on " << int{ground};
    }
}

TEST(Overlay, TheScalesBarIsAsLongAsItSays) {
    // 800 pixels of 0.08 m: a quarter is 16 m, so it says 10 m: 125 pixels.
    world::SensorFrame picture = noise(800, 600);
    std::fill(picture.data.begin(), picture.data.end(), std::uint8_t{90});
    const Area area = render::write_scale(picture, 0.08, 0);
    int longest = 0;
    for (int y = area.top; y < area.bottom; ++y) {
        int run = 0;
        for (int x = area.left; x < area.right; ++x) {
            run = picture.data[static_cast<std::size_t>(3 * (y * 800 + x))] > 200 ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    }
    EXPECT_NEAR(longest, 125, 4);
}

}  // namespace reprise
