#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernel/kernel.h"
#include "tests/kernel/whole_run.h"
#include "tests/support/towns.h"
#include "world/frames.h"
#include "world/models/prop_models.h"

// Cones, boxes and what else lies on the road.
namespace reprise::kernel {
namespace {

using test::KeptTick;

std::vector<KeptTick> play(const std::string& body, double seconds) {
    return test::run(test::on_straight_lanes(body, seconds));
}

const world::PropState& prop(const KeptTick& tick, std::uint32_t id) {
    return *world::find(tick.recorded().view.props(), id);
}

double upright(const world::PropState& state) {
    return (world::to_eigen(state.orientation()) * Eigen::Vector3d::UnitZ()).z();
}

/// One of each, 5 m apart, on lane 'main_1' from s = 20 on: actors 1, 2, ...
std::string one_of_each() {
    std::string body;
    for (std::size_t i = 0; i < world::prop_models().size(); ++i)
        body += "spawn{ model = '" + std::string(world::prop_models()[i].name) +
                "', lane = 'main_1', s = " + std::to_string(20 + 5 * i) + " } ";
    return body;
}

TEST(Props, StandWhereTheyArePutAndNeverCreep) {
    const auto ticks = play(one_of_each() + "wait(60)", 60);
    for (std::uint32_t id = 1; id <= world::prop_models().size(); ++id) {
        const world::PropState& early = prop(ticks[60], id);
        const world::PropState& late = prop(ticks.back(), id);
        const world::PropModel& model = world::prop_models()[late.model()];
        EXPECT_GT(upright(late), 0.999) << model.name;
        EXPECT_NEAR(late.position().z(), early.position().z(), 0) << model.name;
        EXPECT_NEAR(late.position().z(), 0, 0.03) << model.name;
        EXPECT_EQ(late, early) << model.name << " moved though nobody touched it";
    }
}

TEST(Props, StandStillWhileACarWaitsBesideThem) {
    const auto ticks =
        play(one_of_each() +
                 "spawn{ model = 'sedan', driver = 'manual', lane = 'main_2', s = 35 }"
                 " wait(60)",
             60);
    for (std::uint32_t id = 1; id <= world::prop_models().size(); ++id) {
        const auto before = world::to_eigen(prop(ticks[60], id).position());
        const auto after = world::to_eigen(prop(ticks.back(), id).position());
        EXPECT_LT((after - before).norm(), 1e-3)
            << world::prop_models()[prop(ticks[0], id).model()].name;
    }
}

TEST(Props, FlyWhenACarHitsThemAndComeToRest) {
    const auto ticks = play(
        "local cone = spawn{ model = 'cone', lane = 'main_1', s = 60 } "
        "local car = spawn{ name = 'car', model = 'sedan', driver = 'manual', lane = 'main_1', "
        "s = 20, speed = 14 } "
        "start(function() while true do car:control{ throttle = 0.3 } wait_ticks(1) end end) "
        "check.eventually('hit', function() return car:collided(cone) and car:collided 'prop' end) "
        "check.never('no car', function() return car:collided 'vehicle' end) "
        "wait(12)",
        12);
    const world::PropState& before = prop(ticks[20], 1);
    const world::PropState& after = prop(ticks.back(), 1);
    const double flown =
        (world::to_eigen(after.position()) - world::to_eigen(before.position())).norm();
    EXPECT_GT(flown, 3);
    EXPECT_LT(world::to_eigen(after.velocity()).norm(), 0.05) << "at rest";
    EXPECT_GT(after.position().z(), -0.05) << "on the ground";
    EXPECT_LT(after.position().z(), 0.6);
    // A cone is no obstacle to 1.4 ton.
    const auto measured = ticks.back().recorded().view.measurements();
    ASSERT_EQ(measured.size(), 1U);
    EXPECT_GT(measured[0].speed(), 10);
    EXPECT_GT(measured[0].impulse_static(), 20);
    EXPECT_EQ(measured[0].impulse_vehicles(), 0);
}

/// A car that drives straight into a sign of Town 1, and how fast it is before and behind it.
/// `from`: [m] from its rear axle to the sign at the start.
struct SignHit {
    double before = 0;
    double after = 0;
    std::optional<world::PropState> sign;  ///< at the end
};

SignHit drive_into_a_sign(double speed, double from) {
    const world::TownT& town = test::own_town("town1").town;
    const auto sign = std::find_if(town.props.begin(), town.props.end(), [](const auto& prop) {
        return prop.kind() == world::PropKind::speed_limit_sign;
    });
    const double yaw = sign->yaw();
    const auto start = fmt::format(
        "local car = spawn{{ name = 'car', model = 'sedan', driver = 'manual', x = {:.3f}, y = "
        "{:.3f}, heading_deg = {:.3f}, speed = {} }} car:control{{}} wait(4)",
        sign->position().x() - from * std::cos(yaw),
        sign->position().y() - from * std::sin(yaw),
        yaw * 180 / std::numbers::pi,
        speed);
    SignHit hit;
    for (const KeptTick& tick : test::run(test::in_town1(start, 0, 4))) {
        const world::TickView view = tick.recorded().view;
        const double now = world::to_eigen(view.vehicles()[0].velocity()).norm();
        if (view.props().empty())
            hit.before = now;
        else if (!hit.sign)
            hit.after = now;
        hit.sign = view.props().empty() ? std::nullopt : std::optional(view.props()[0]);
    }
    if (hit.sign) {
        EXPECT_EQ(hit.sign->id(),
                  world::first_broken_id + static_cast<std::uint32_t>(sign - town.props.begin()));
    }
    return hit;
}

TEST(Props, ASignBreaksOffWhereACarHitsItHardAndStandsWhereItIsTouched) {
    const SignHit hard = drive_into_a_sign(14, 8);
    ASSERT_TRUE(hard.sign.has_value());
    EXPECT_LT(hard.after, hard.before - 0.3) << "600 N s of 1.4 ton";
    EXPECT_GT(hard.after, hard.before - 2);
    const Eigen::Vector3d up = world::to_eigen(hard.sign->orientation()) * Eigen::Vector3d::UnitZ();
    EXPECT_LT(up.z(), 0.5) << "it lies";
    EXPECT_FALSE(drive_into_a_sign(0.35, 4).sign.has_value()) << "less than 500 N s";
}

TEST(Props, AConcreteBarrierStopsACar) {
    const auto ticks = play(
        "spawn{ model = 'barrier', lane = 'main_1', s = 50 } "
        "local car = spawn{ name = 'car', model = 'sedan', driver = 'manual', lane = 'main_1', "
        "s = 20, speed = 10 } "
        "start(function() while true do car:control{} wait_ticks(1) end end) wait(8)",
        8);
    const auto measured = ticks.back().recorded().view.measurements();
    EXPECT_LT(measured[0].speed(), 5) << "it pushed a ton of concrete";
    // Momentum of both together is no more than the car brought.
    EXPECT_GT(measured[0].impulse_static(), 3000);
    EXPECT_LT(measured[0].impulse_static(), 1.5 * 1400 * 10);
}

TEST(Props, StopAnAutopilotWhereTheyAreTallEnough) {
    const std::string before =
        "local car = spawn{ name = 'car', model = 'sedan', lane = 'main_1', s = 20, speed = 10, "
        "lane_changes = false } ";
    const auto stopped =
        play(before + "spawn{ model = 'box', lane = 'main_1', s = 80 } wait(15)", 15);
    const auto drove =
        play(before + "spawn{ model = 'plank', lane = 'main_1', s = 80 } wait(15)", 15);
    EXPECT_LT(stopped.back().recorded().view.measurements()[0].speed(), 0.1);
    EXPECT_EQ(stopped.back().recorded().view.measurements()[0].impulse_static(), 0);
    EXPECT_GT(drove.back().recorded().view.measurements()[0].lane_s(), 100);
}

TEST(Props, AreTakenAwayAgain) {
    const auto ticks = play(
        "local box = spawn{ model = 'box', lane = 'main_1', s = 50 } wait(1) print(box:exists(), "
        "box:speed(), box:lane()) box:despawn() wait_ticks(2) print(box:exists())",
        3);
    EXPECT_EQ(ticks[10].recorded().view.props().size(), 1U);
    EXPECT_TRUE(ticks.back().recorded().view.props().empty());
}

}  // namespace
}  // namespace reprise::kernel
