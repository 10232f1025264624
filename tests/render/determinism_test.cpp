#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <gmock/gmock.h>

#include "tests/render/street.h"
#include "world/check.h"

namespace reprise {

namespace {

using world::SensorFrame;

void expect_equal(const std::vector<SensorFrame>& expected,
                  const std::vector<SensorFrame>& found,
                  const std::string& what) {
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_TRUE(expected[i].data == found[i].data) << what << ": frame " << i;
}

/// Keeps what was seen from a car that stands farther on at each look.
class KeptLook : public render::Observation {
  public:
    KeptLook(int number, render::Sensors& alone, std::vector<int>& done)
        : number_(number),
          alone_(alone),
          done_(done) {
        sealed_.emplace(test::tick_with({test::vehicle_at(1, 40 + 5.0 * number, -1.75)},
                                        {test::car_at(10, 75, 1.75)}));
    }

    world::TickView tick() const override { return sealed_->view(); }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    void seen(std::vector<SensorFrame> frames) override { frames_ = std::move(frames); }

    void done() override {
        done_.push_back(number_);
        expect_equal(alone_.observe(tick(), rig_, weather_), frames_, std::to_string(number_));
    }

  private:
    int number_;
    render::Sensors& alone_;
    std::vector<int>& done_;
    std::optional<world::SealedTick> sealed_;
    world::SensorRig rig_ = test::street_rig(120, 90);
    world::Weather weather_ = test::weathers()[static_cast<std::size_t>(number_) % 3].weather;
    std::vector<SensorFrame> frames_;
};

}  // namespace

TEST(Sensors, LooksSeveralAtATimeAreThoseOneByOneAndAreDoneInTheirOrder) {
    render::Sensors alone(test::street());
    for (const int threads : {1, 3}) {
        render::Sensors sensors(test::street(), {.threads = threads});
        std::vector<int> done;
        int asked = 0;
        sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
            if (asked == 7)
                return nullptr;
            return std::make_unique<KeptLook>(asked++, alone, done);
        });
        EXPECT_THAT(done, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6));
    }
}

TEST(Sensors, ALookThatFailsEndsTheOthersWithItsReason) {
    render::Sensors sensors(test::street(), {.threads = 2});
    std::vector<int> done;

    class Failing : public KeptLook {
        using KeptLook::KeptLook;

        void seen(std::vector<SensorFrame>) override { throw world::Error("the disk is full"); }
    };

    EXPECT_THROW(sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
        return std::make_unique<Failing>(0, sensors, done);
    }),
                 world::Error);
    EXPECT_THAT(done, testing::IsEmpty());
}

TEST(Sensors, EveryNumberOfThreadsAndEveryRepeatGiveTheSameBytes) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    const world::SensorRig rig = test::street_rig(240, 180);
    for (const bool portable : {false, true}) {
        std::map<std::string, std::vector<SensorFrame>> expected;  // by weather
        for (const int threads : {1, 2, 4}) {
            render::Sensors sensors(town, {.threads = threads, .portable = portable});
            for (int repeat = 0; repeat < threads; ++repeat) {
                for (const auto& [name, weather] : test::weathers()) {
                    const auto found = sensors.observe(tick.view(), rig, weather);
                    const auto first = expected.try_emplace(name, found).first;
                    expect_equal(first->second,
                                 found,
                                 std::string(name) + ", portable " + std::to_string(portable) +
                                     ", threads " + std::to_string(threads));
                    EXPECT_GT(test::mean(found[0], 1, 0, 0, 239, 179), 20) << "there is light";
                }
            }
        }
    }
}

TEST(Sensors, HistoryDoesNotMatter) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    const world::SensorRig rig = test::street_rig();
    for (const bool portable : {false, true}) {
        render::Sensors fresh(town, {.portable = portable});
        const auto expected = fresh.observe(tick.view(), rig, test::rain());
        render::Sensors used(town, {.portable = portable});
        used.observe(test::tick_with({}, {test::car_at(5, 44, 0)}).view(),
                     {test::camera(world::SensorKind::rgb)},
                     test::noon());
        expect_equal(expected, used.observe(tick.view(), rig, test::rain()), "after another tick");
    }
}

/// Two ways to the same picture: Embree's arithmetic and ours. They may part at edges only.
TEST(Sensors, PortablePicturesShowWhatOthersShow) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    const world::SensorRig rig = test::street_rig(320, 240);
    const std::size_t pixels = 320 * 240;
    for (const auto& [name, weather] : test::weathers()) {
        const auto normal = render::Sensors(town).observe(tick.view(), rig, weather);
        const auto portable =
            render::Sensors(town, {.portable = true}).observe(tick.view(), rig, weather);
        std::size_t other_color = 0;
        std::size_t other_depth = 0;
        std::size_t other_class = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t channel = 3 * i; channel < 3 * i + 3; ++channel)
                if (std::abs(normal[0].data[channel] - portable[0].data[channel]) > 2) {
                    ++other_color;
                    break;
                }
            const auto x = static_cast<int>(i % 320);
            const auto y = static_cast<int>(i / 320);
            const auto here = static_cast<double>(test::depth_at(normal[1], x, y));
            const auto there = static_cast<double>(test::depth_at(portable[1], x, y));
            other_depth +=
                static_cast<std::size_t>(!(here == there || std::abs(here - there) <= 1e-6 * here));
            other_class += static_cast<std::size_t>(normal[2].data[i] != portable[2].data[i]);
        }
        EXPECT_LE(other_color, pixels / 1000) << name;
        EXPECT_LE(other_depth, pixels / 5000) << name;
        EXPECT_LE(other_class, pixels / 5000) << name;
    }
}

TEST(Sensors, PortablePicturesHideTheCarThatCarriesTheCamera) {
    render::Sensors sensors(test::straight_road(400), {.portable = true});
    const world::SealedTick tick = test::street_tick();
    world::SensorSpec inside = test::camera(world::SensorKind::semantic, {1, 0, 0.9});
    inside.actor = 1;
    const auto behind = test::camera(world::SensorKind::semantic, {32, -1.75, 1.4});
    const auto frames = sensors.observe(tick.view(), {inside, behind}, test::noon());
    EXPECT_EQ(test::class_at(frames[0], 80, 118), world::SemanticClass::road);
    EXPECT_EQ(test::class_at(frames[1], 80, 70), world::SemanticClass::car);
}

}  // namespace reprise
