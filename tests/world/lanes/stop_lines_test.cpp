#include "world/lanes/stop_lines.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/support/worlds.h"

namespace reprise::world {

namespace {

constexpr double bumper = 3.7;  // [m] of a sedan
constexpr auto red = SignalColor::red;
constexpr auto green = SignalColor::green;

/// An approach of two lanes that end at x = 50. From the right one (y = -1.75) the ways go straight
/// on (signal 0) and to the right (signal 1), from the left one (y = 1.75) straight on (signal 2).
TownT approach() {
    using enum LaneKind;
    const auto point = [](double x, double y) { return Vec3(x, y, 0); };
    std::vector<Vec3> bend;
    for (int i = 0; i <= 9; ++i) {
        const double angle = i * std::numbers::pi / 18;
        bend.push_back(point(50 + 8 * std::sin(angle), -1.75 - 8 * (1 - std::cos(angle))));
    }
    TownT town;
    town.lanes = {test::lane("in_0", driving, {point(0, -1.75), point(50, -1.75)}),
                  test::lane("in_1", driving, {point(0, 1.75), point(50, 1.75)}),
                  test::lane("via_right", internal, bend),
                  test::lane("via_straight", internal, {point(50, -1.75), point(70, -1.75)}),
                  test::lane("out_0", driving, {point(70, -1.75), point(120, -1.75)}),
                  test::lane("south_0", driving, {point(58, -9.75), point(58, -60)}),
                  test::lane("via_left_lane", internal, {point(50, 1.75), point(70, 1.75)}),
                  test::lane("out_1", driving, {point(70, 1.75), point(120, 1.75)})};
    const auto link = [](std::uint32_t to, std::uint32_t via, std::uint32_t signal, Turn turn) {
        return Link(to, via, signal, turn, false, 0);
    };
    town.lanes[0].links = {link(4, 3, 0, Turn::straight), link(5, 2, 1, Turn::right)};
    town.lanes[1].links = {link(7, 6, 2, Turn::straight)};
    for (const std::uint32_t via : {2U, 3U, 6U})
        town.lanes[via].links = {link(via == 2 ? 5 : via == 3 ? 4 : 7, none, none, Turn::straight)};
    return town;
}

/// A car that is shown to the watch, tick by tick.
class Car {
  public:
    explicit Car(std::vector<SignalColor> lights) : colors(std::move(lights)) {}

    /// The rear axle's way from here to there, in steps of half a metre.
    void drive(Eigen::Vector2d from, Eigen::Vector2d to, double yaw) {
        const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / 0.5)));
        for (int i = 0; i <= steps; ++i)
            stand(from + (to - from) * i / steps, yaw);
    }

    void stand(Eigen::Vector2d at, double yaw) {
        const SealedTick tick = test::tick_with({}, {}, colors);
        watch.observe(town, lines, tick.view(), {at.x(), at.y(), 0}, yaw, bumper, 3);
    }

    /// Along the right turn's quarter of a circle.
    void turn_right() {
        for (int i = 0; i <= 30; ++i) {
            const double angle = i * std::numbers::pi / 60;
            stand({50 + 8 * std::sin(angle), -1.75 - 8 * (1 - std::cos(angle))}, -angle);
        }
    }

    bool ran_red() const { return watch.ran_red(); }

    std::vector<SignalColor> colors;
    TownT town = approach();
    StopLines lines{town};
    RedLightWatch watch;
};

}  // namespace

TEST(RedLightWatch, SeesWhoCrossesTheLineAtRed) {
    for (const auto& [color, is] : {std::pair(red, true),
                                    {SignalColor::red_yellow, true},
                                    {SignalColor::yellow, false},
                                    {green, false},
                                    {SignalColor::green_minor, false},
                                    {SignalColor::off, false}}) {
        Car car({color, color, color});
        car.drive({30, -1.75}, {50 - bumper - 0.1, -1.75}, 0);
        EXPECT_FALSE(car.ran_red()) << "it is still before the line";
        car.drive({50 - bumper, -1.75}, {50 - bumper + 1, -1.75}, 0);
        EXPECT_EQ(car.ran_red(), is) << static_cast<int>(color);
    }
}

TEST(RedLightWatch, KnowsTheLightsOfEachLane) {
    Car right({red, red, green});
    right.drive({30, -1.75}, {60, -1.75}, 0);
    EXPECT_TRUE(right.ran_red());
    Car left({red, red, green});
    left.drive({30, 1.75}, {60, 1.75}, 0);
    EXPECT_FALSE(left.ran_red());
}

TEST(RedLightWatch, AsksForTheLightOfTheTurningThatIsTaken) {
    for (const bool right_is_red : {true, false}) {
        const std::vector<SignalColor> lights{
            right_is_red ? green : red, right_is_red ? red : green, green};
        Car straight(lights);
        straight.drive({30, -1.75}, {49, -1.75}, 0);
        EXPECT_FALSE(straight.ran_red()) << "nobody can know yet";
        EXPECT_TRUE(straight.watch.is_undecided());
        straight.drive({49, -1.75}, {80, -1.75}, 0);
        EXPECT_EQ(straight.ran_red(), !right_is_red);
        EXPECT_FALSE(straight.watch.is_undecided());
        Car right(lights);
        right.drive({30, -1.75}, {50, -1.75}, 0);
        right.turn_right();
        EXPECT_EQ(right.ran_red(), right_is_red);
        EXPECT_FALSE(right.watch.is_undecided());
    }
}

/// As maps draw bends: its first piece leads aside at once. Who turns is still straight at the
/// line, or swings out; straight on it was red.
TEST(RedLightWatch, WaitsUntilWhoTurnsHasTurned) {
    for (const double swing : {0.0, 0.1}) {
        Car right({red, green, green});
        right.town.lanes[2].centre = {
            Vec3(50, -1.75, 0), Vec3(55.66, -4.09, 0), Vec3(58, -9.75, 0)};
        right.drive({30, -1.75}, {50, -1.75}, swing);
        right.turn_right();
        EXPECT_FALSE(right.ran_red()) << swing;
        EXPECT_FALSE(right.watch.is_undecided());
    }
}

TEST(RedLightWatch, TheTickOfTheCrossingCounts) {
    Car late({green, green, green});
    late.drive({30, -1.75}, {49, -1.75}, 0);
    late.colors = {red, red, red};
    late.drive({49, -1.75}, {80, -1.75}, 0);
    EXPECT_FALSE(late.ran_red());
    Car early({red, red, red});
    early.drive({30, -1.75}, {45, -1.75}, 0);
    early.colors = {green, green, green};
    early.drive({45, -1.75}, {80, -1.75}, 0);
    EXPECT_FALSE(early.ran_red()) << "it waited";
}

TEST(RedLightWatch, LetsWhoDrivesBackwardsBe) {
    Car car({red, red, red});
    car.drive({55, -1.75}, {30, -1.75}, 0);
    EXPECT_FALSE(car.ran_red()) << "back over the line, out of the junction";
    car.drive({30, -1.75}, {60, -1.75}, 0);
    EXPECT_TRUE(car.ran_red()) << "and forwards again";
}

TEST(RedLightWatch, LetsWhoWasSpawnedBeyondTheLineBe) {
    Car car({red, red, red});
    car.drive({50 - bumper + 0.4, -1.75}, {80, -1.75}, 0);
    EXPECT_FALSE(car.ran_red());
}

TEST(RedLightWatch, LetsWhoStandsAHandsBreadthTooFarBe) {
    Car car({red, red, red});
    car.drive({30, -1.75}, {50 - bumper + 0.25, -1.75}, 0);
    EXPECT_FALSE(car.ran_red());
    car.colors = {green, green, green};
    car.drive({50 - bumper + 0.25, -1.75}, {70, -1.75}, 0);
    EXPECT_FALSE(car.ran_red());
}

TEST(RedLightWatch, LetsWhoIsPutElsewhereBe) {
    Car car({red, red, red});
    car.stand({40, -1.75}, 0);
    car.stand({60, -1.75}, 0);
    EXPECT_FALSE(car.ran_red());
}

TEST(RedLightWatch, LetsWhoIsPutAFewStepsOnBe) {
    Car car({red, red, red});
    car.stand({46, -1.75}, 0);
    car.watch.lose_sight();
    car.stand({47, -1.75}, 0);
    EXPECT_FALSE(car.ran_red());
    Car undecided({red, green, green});
    undecided.drive({30, -1.75}, {49, -1.75}, 0);
    EXPECT_TRUE(undecided.watch.is_undecided());
    undecided.watch.lose_sight();
    undecided.drive({55, -1.75}, {80, -1.75}, 0);
    EXPECT_FALSE(undecided.ran_red()) << "it was put onto the way straight on";
}

TEST(RedLightWatch, LetsWhoPassesBesideTheLinesBe) {
    Car car({red, red, red});
    car.drive({30, 6}, {70, 6}, 0);
    car.drive({70, 6}, {30, 6}, std::numbers::pi);
    EXPECT_FALSE(car.ran_red());
}

}  // namespace reprise::world
