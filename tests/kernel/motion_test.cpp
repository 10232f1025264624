// What drivers are told about their speed and their place on the road is measured in whole runs, in
// the ticks alone.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::test {

namespace {

constexpr double step = 0.05;  // [s]
constexpr double kmh = 1 / 3.6;

/// An actor in a tick.
struct Seen {
    std::uint64_t tick = 0;
    Eigen::Vector3d position{0, 0, 0};
    double speed = 0;
    double offset = 0;  ///< [m] left of its lane's middle
    std::uint32_t lane = world::none;
};

/// A run, and what became of actor 1 (vehicle or car) in it.
struct Drive {
    explicit Drive(world::Recording its_recording, std::uint32_t actor = 1)
        : recording(std::move(its_recording)),
          ticks(run(recording)) {
        for (const KeptTick& tick : ticks)
            look(tick.recorded().view, actor);
    }

    void look(const world::TickView& view, std::uint32_t actor) {
        Seen now{view.index()};
        if (const auto* vehicle = world::find(view.vehicles(), actor)) {
            const auto* measured = world::find(view.measurements(), actor);
            now.position = world::to_eigen(vehicle->position());
            now.speed = measured->speed();
            now.lane = measured->lane();
            now.offset = measured->lane_t();
        } else if (const auto* car = world::find(view.cars(), actor)) {
            now.position = world::to_eigen(car->position());
            now.speed = static_cast<double>(car->speed());
            now.lane = car->lane();
            if (now.lane != world::none)
                now.offset = world::project(recording.town.lanes[now.lane], now.position).t;
        } else {
            return;
        }
        seen.push_back(now);
        if (view.tick->commands() != nullptr)
            for (const world::Command* command : *view.tick->commands())
                if (command->actor() == actor)
                    said_at[command->kind()] = view.index() - 1;
    }

    /// [s] since the last command of this kind.
    double since(world::CommandKind kind, const Seen& at) const {
        return (static_cast<double>(at.tick) - static_cast<double>(said_at.at(kind))) * step;
    }

    /// The largest, over all that is seen from so many seconds after such a command on.
    template <typename Measure>
    double most(world::CommandKind kind, double from, double to, Measure measure) const {
        double most = 0;
        for (const Seen& at : seen)
            if (since(kind, at) >= from - 1e-9 && since(kind, at) <= to + 1e-9)
                most = std::max(most, std::abs(measure(at)));
        return most;
    }

    std::size_t events(world::EventKind kind) const {
        std::size_t count = 0;
        for (const KeptTick& tick : ticks)
            if (const auto* all = tick.recorded().view.tick->events())
                count += static_cast<std::size_t>(
                    std::count_if(all->begin(), all->end(), [kind](const world::Event* event) {
                        return event->kind() == kind;
                    }));
        return count;
    }

    world::Recording recording;
    std::vector<KeptTick> ticks;
    std::vector<Seen> seen;
    std::map<world::CommandKind, std::uint64_t> said_at;  ///< tick that the script saw
};

std::string spawned(const std::string& lane, double speed, const std::string& more = "") {
    return fmt::format(
        "local ego = spawn{{ model = 'sedan', lane = '{}', s = 20, speed = {}{} }}\n",
        lane,
        speed,
        more);
}

constexpr const char* of_traffic = ", driver = 'traffic'";

double shape_share(const std::string& shape, double u) {
    u = std::clamp(u, 0.0, 1.0);
    if (shape == "linear")
        return u;
    return shape == "cubic" ? u * u * (3 - 2 * u) : (1 - std::cos(std::numbers::pi * u)) / 2;
}

}  // namespace

TEST(HoldSpeed, IsKeptWithin03KmhOnTheFlatInBendsAndOnSlopes) {
    const auto worst = [](const world::Recording& recording, double speed) {
        return Drive(recording).most(world::CommandKind::hold_speed, 0.5, 999, [&](const Seen& at) {
            return at.speed - speed;
        });
    };
    const auto body = [](const char* lane, double speed) {
        return spawned(lane, speed) + fmt::format("ego:hold_speed({}) wait(99)", speed);
    };
    EXPECT_LT(worst(in_town("straight", body("east_1", 130 * kmh), 10), 130 * kmh), 0.3 * kmh);
    EXPECT_LT(worst(in_town("straight", body("east_1", 5 * kmh), 10), 5 * kmh), 0.3 * kmh);
    EXPECT_LT(worst(in_town("curves", body("s3_0", 50 * kmh), 60), 50 * kmh), 0.3 * kmh);
    EXPECT_LT(worst(in_town1(body("t1_l1_1", 30 * kmh), 0, 60), 30 * kmh), 0.3 * kmh);
    for (const char* lane : {"hill_0", "hill_back_0"})
        EXPECT_LT(worst(on_straight_lanes(body(lane, 50 * kmh), 12), 50 * kmh), 0.3 * kmh) << lane;
}

TEST(HoldSpeed, ReactsToNobody) {
    const std::string van = "spawn{ model = 'van', driver = 'parked', lane = 'east_1', s = 120 }\n";
    const Drive hit(
        in_town("straight", spawned("east_1", 14) + van + "ego:hold_speed(14) wait(99)", 9));
    EXPECT_GT(hit.events(world::EventKind::collision), 0U);
    for (const Seen& at : hit.seen)
        if (at.position.x() < hit.seen.front().position.x() + 90) {
            EXPECT_NEAR(at.speed, 14, 0.3 * kmh) << "until it hits";
        }
    const Drive stopped(
        in_town("straight", spawned("east_1", 14) + van + "ego:set_speed(14) wait(99)", 20));
    EXPECT_EQ(stopped.events(world::EventKind::collision), 0U);
}

TEST(HoldSpeed, TheLaterWordWins) {
    const Drive drive(
        in_town("straight",
                spawned("east_1", 14) + "ego:hold_speed(14) wait(1) ego:set_speed(5) wait(99)",
                15));
    EXPECT_NEAR(drive.seen.back().speed, 5, 0.05);
    const Drive lifted(
        in_town("straight",
                spawned("east_1", 14) + "ego:hold_speed(14) wait(1) ego:hold_speed(false) wait(99)",
                15));
    EXPECT_GT(lifted.seen.back().speed, 20) << "its own choice again";
    const Drive stands(
        in_town("straight", spawned("east_1", 14) + "ego:hold_speed(0) wait(99)", 15));
    EXPECT_NEAR(stands.seen.back().speed, 0, 0.001);
}

TEST(Brake, DeceleratesAsToldAndStands) {
    const auto check = [](const world::Recording& recording, const char* where) {
        const Drive drive(recording);
        double last = 0;
        int looked_at = 0;
        for (const Seen& at : drive.seen) {
            const double since = drive.since(world::CommandKind::brake, at);
            if (since > 0.45 && at.speed > 0.5 && ++looked_at > 0) {
                EXPECT_NEAR((last - at.speed) / step, 6, 0.3)
                    << where << ", after " << since << " s";
            }
            last = at.speed;
        }
        EXPECT_GT(looked_at, 20);
        EXPECT_NEAR(drive.seen.back().speed, 0, 0.001) << where << ": it stays";
        const double first_still =
            std::find_if(drive.seen.begin(), drive.seen.end(), [](const Seen& at) {
                return at.speed < 0.001;
            })->position.x();
        EXPECT_NEAR(drive.seen.back().position.x(), first_still, 0.1) << where;
    };
    const std::string brakes = "ego:hold_speed(50 / 3.6) wait(1) ego:brake(6) wait(99)";
    check(in_town("straight", spawned("east_1", 50 * kmh) + brakes, 12), "flat");
    check(on_straight_lanes(spawned("hill_0", 50 * kmh) + brakes, 12), "uphill");
    check(on_straight_lanes(spawned("hill_back_0", 50 * kmh) + brakes, 12), "downhill");
    check(in_town("straight", spawned("east_1", 50 * kmh, of_traffic) + brakes, 12), "traffic");
}

TEST(Brake, EndsByAnotherWord) {
    for (const char* word :
         {"ego:brake(false)", "ego:set_speed(9)", "ego:hold_speed(9)", "ego:free_speed()"}) {
        const Drive drive(in_town(
            "straight", spawned("east_1", 14) + "ego:brake(6) wait(5)\n" + word + " wait(99)", 12));
        EXPECT_GT(drive.seen.back().speed, 5) << word;
    }
}

TEST(SetSpeed, IsReachedInTimeByItsShape) {
    for (const char* shape : {"linear", "cubic", "sinusoidal"})
        for (const double to : {20.0, 4.0}) {
            const Drive drive(
                in_town("straight",
                        spawned("east_1", 10) +
                            fmt::format("ego:hold_speed(10) wait(1)\n"
                                        "ego:set_speed({}, {{ over = 5, shape = '{}' }}) wait(99)",
                                        to,
                                        shape),
                        9));
            EXPECT_LT(drive.most(world::CommandKind::set_speed,
                                 0,
                                 6,
                                 [&](const Seen& at) {
                                     const double u =
                                         drive.since(world::CommandKind::set_speed, at) / 5;
                                     return at.speed - (10 + (to - 10) * shape_share(shape, u));
                                 }),
                      0.3 * kmh)
                << shape << " to " << to;
        }
}

TEST(SetOffset, IsKeptWithinATenthOfAMetre) {
    const auto body = [](const char* more) {
        return spawned("s3_0", 50 * kmh, more) +
               "ego:hold_speed_kmh(50) wait(1) ego:set_offset(-0.8, { over = 2 }) wait(99)";
    };
    const Drive drive(in_town("curves", body(""), 40));
    EXPECT_LT(drive.most(world::CommandKind::set_offset,
                         2.5,
                         99,
                         [](const Seen& at) { return at.offset + 0.8; }),
              0.1);
    const Drive traffic(
        in_town("straight",
                spawned("east_1", 50 * kmh, of_traffic) +
                    "ego:hold_speed_kmh(50) wait(1) ego:set_offset(-0.8, { over = 2 }) wait(99)",
                20));
    EXPECT_LT(
        traffic.most(
            world::CommandKind::set_offset, 3, 99, [](const Seen& at) { return at.offset + 0.8; }),
        0.1);
}

/// The centre line of t3_r1_1 has corners of 13 degrees.
TEST(SetOffset, TrafficDrivesEvenlyAroundTheCornersOfItsLane) {
    for (const double offset : {-1.4, 1.4}) {
        const Drive drive(in_town1(
            spawned("t3_r1_1", 10, of_traffic) + fmt::format("ego:set_offset({}) wait(99)", offset),
            0,
            18));
        for (std::size_t i = 40; i < drive.seen.size(); ++i) {
            const Seen& now = drive.seen[i];
            const double moved = (now.position - drive.seen[i - 1].position).norm();
            EXPECT_NEAR(moved, now.speed * step, 0.25 * now.speed * step + 0.01)
                << offset << " m aside, tick " << now.tick;
        }
    }
}

/// A van stands in a bend with corners, and who waits behind it joins the lane beside.
TEST(PullingOut, BeginsWhereTheCarStands) {
    for (const int s : {96, 102}) {
        const std::string van = fmt::format(
            "spawn{{ model = 'van', driver = 'parked', lane = 'l1_b1_2', s = {} }} wait(99)", s);
        std::map<std::uint32_t, Eigen::Vector3d> before;
        for (const KeptTick& tick : run(in_town1(van, 100, 36))) {
            const world::TickView view = tick.recorded().view;
            std::map<std::uint32_t, Eigen::Vector3d> now;
            for (const world::CarState& car : view.cars()) {
                now[car.id()] = world::to_eigen(car.position());
                if (const auto was = before.find(car.id()); was != before.end()) {
                    EXPECT_LT((now[car.id()] - was->second).norm(),
                              1.3 * static_cast<double>(car.speed()) * step + 0.1)
                        << "van at " << s << ", car " << car.id() << ", tick " << view.index();
                }
            }
            before = std::move(now);
        }
    }
}

TEST(SetOffset, OutlivesJunctionsAndChangesOfLanesAndGoesBack) {
    const Drive lanes(in_town("straight",
                              spawned("east_1", 14) +
                                  "ego:hold_speed(14) ego:set_offset(0.5) wait(3)\n"
                                  "ego:change_lane('left', { over = 3 }) wait(5)\n"
                                  "ego:change_lane 'right' wait(99)",
                              25));
    EXPECT_NEAR(lanes.seen.back().offset, 0.5, 0.05);
    const Drive back(in_town("straight",
                             spawned("east_1", 14) + "ego:set_offset(0.5) wait(3)\n"
                                                     "ego:set_offset(0, { over = 2 }) wait(99)",
                             9));
    EXPECT_NEAR(back.seen.back().offset, 0, 0.02);
    const Drive town(in_town1(spawned("b1_b2_1", 8) + "ego:set_offset(0.5) wait(99)", 0, 30));
    std::set<std::uint32_t> lanes_passed;
    for (const Seen& at : town.seen)
        lanes_passed.insert(at.lane);
    EXPECT_GT(lanes_passed.size(), 3U);
    EXPECT_NEAR(town.seen.back().offset, 0.5, 0.2);
}

TEST(ChangeLane, FollowsItsShapeAndIsDoneInTime) {
    constexpr double width = 3.75;
    for (const char* shape : {"sinusoidal", "cubic", "linear"})
        for (const char* side : {"left", "right"}) {
            const Drive drive(in_town(
                "straight",
                spawned("east_1", 14) +
                    fmt::format("ego:hold_speed(14) wait(1)\n"
                                "ego:change_lane('{}', {{ over = 3, shape = '{}' }}) wait(99)",
                                side,
                                shape),
                8));
            const double y = drive.seen.front().position.y();
            const double sign = std::string(side) == "left" ? 1 : -1;
            const auto error = [&](const Seen& at) {
                const double u = drive.since(world::CommandKind::change_lane, at) / 3;
                return sign * (at.position.y() - y) - width * shape_share(shape, u);
            };
            const bool has_corners = std::string(shape) == "linear";
            EXPECT_LT(drive.most(world::CommandKind::change_lane, 0, 5, error),
                      has_corners ? 0.5 : 0.15)
                << shape << " " << side;
            EXPECT_LT(drive.most(world::CommandKind::change_lane, 3, 3.1, error), 0.15);
            EXPECT_LT(drive.most(world::CommandKind::change_lane, 4, 9, error), 0.02);
        }
}

TEST(ChangeLane, WithinATimeItBeginsAtOnceWhoeverIsThere) {
    const std::string beside =
        "local other = spawn{ model = 'sedan', lane = 'east_2', s = 14, speed = 14 }\n"
        "other:hold_speed(14) ego:hold_speed(14) wait(1)\n";
    const auto least = [&](const char* change) {
        const Drive drive(
            in_town("straight", spawned("east_1", 14) + beside + change + " wait(99)", 5));
        return drive.seen.back().position.y() - drive.seen.front().position.y();
    };
    EXPECT_GT(least("ego:change_lane('left', { over = 3 })"), 1);
    EXPECT_LT(least("ego:change_lane 'left'"), 0.5) << "it waits for room";
}

TEST(IgnoreLights, RunsRedOnes) {
    const auto passed_after = [](const std::string& more, const char* word) {
        const Drive drive(in_town("junctions",
                                  spawned("t_lit_x_lit_1", 10, more) +
                                      "ego:route_to{ lane = 'x_lit_x_right_first_1' } " + word +
                                      " wait(99)",
                                  30));
        const std::uint32_t first = drive.seen.front().lane;
        double slowest = 99;
        for (const Seen& at : drive.seen)
            if (at.lane == first)
                slowest = std::min(slowest, at.speed);
        return slowest;
    };
    for (const char* driver : {"", of_traffic}) {
        EXPECT_LT(passed_after(driver, ""), 1) << "red" << driver;
        EXPECT_GT(passed_after(driver, "ego:ignore_lights()"), 8) << driver;
        EXPECT_LT(passed_after(driver, "ego:ignore_lights() wait(1) ego:ignore_lights(false)"), 1);
    }
}

namespace {

/// [s] when an actor's origin passes nearest to a place.
double time_of_passing(const Drive& drive, const Eigen::Vector2d& p_world) {
    const auto way = [&](const Seen& at) { return (at.position.head<2>() - p_world).norm(); };
    std::size_t best = 1;
    for (std::size_t i = 1; i + 1 < drive.seen.size(); ++i)
        if (way(drive.seen[i]) < way(drive.seen[best]))
            best = i;
    // Along the line between the neighbours.
    const Eigen::Vector2d from = drive.seen[best - 1].position.head<2>();
    const Eigen::Vector2d all = drive.seen[best + 1].position.head<2>() - from;
    const double share = (p_world - from).dot(all) / all.squaredNorm();
    return (static_cast<double>(drive.seen[best].tick) - 1 + 2 * share) * step;
}

}  // namespace

TEST(ArriveTogether, WithinATenthOfASecond) {
    for (const char* more : {"", of_traffic})
        for (const double s : {10.0, 60.0})
            for (const char* options : {"", ", { speed = 9 }"}) {
                const std::string body = fmt::format(
                    "local a = spawn{{ model = 'sedan', lane = 'x_stop_x_lit_1', s = {}, speed = "
                    "8{} }}\n"
                    "local b = spawn{{ model = 'sedan', lane = 't_lit_x_lit_1', s = 20, speed = 10 "
                    "}}\n"
                    "b:hold_speed(10) a:route_to{{ lane = 'x_lit_x_yield_1' }}\n"
                    "b:route_to{{ lane = 'x_lit_x_right_first_1' }}\n"
                    "local met, apart = arrive_together(a, b,\n"
                    "    {{ a = {{ lane = 'x_lit_x_yield_1', s = 10 }}, b = {{ 362.86, 165.25 }} "
                    "}}{})\n"
                    "print(met, apart < 0.1) wait(1)",
                    s,
                    more,
                    options);
                const world::Recording recording = in_town("junctions", body, 30);
                const Drive a(recording);
                const Drive b(recording, 2);
                const std::uint32_t lane = *world::find_lane(recording.town, "x_lit_x_yield_1");
                const Eigen::Vector2d p_a =
                    world::point_at(recording.town.lanes[lane], 10).position.head<2>();
                EXPECT_NEAR(time_of_passing(a, p_a), time_of_passing(b, {362.86, 165.25}), 0.1)
                    << s << more << options;
            }
}

TEST(ArriveTogether, DoesNotMeetWhoHasLeftTheWayToItsPoint) {
    // The other one turns off before it comes to its point straight on.
    const world::Recording recording =
        in_town("junctions",
                "local a = spawn{ model = 'sedan', lane = 'x_stop_x_lit_1', s = 10, speed = 8 }\n"
                "local b = spawn{ model = 'sedan', lane = 't_lit_x_lit_1', s = 20, speed = 10 }\n"
                "b:hold_speed(8) b:route_to{ lane = 'x_lit_x_stop_1' }\n"
                "local s = lane_length 'x_lit_x_right_first_1' - 10\n"
                "print(arrive_together(a, b, { a = { lane = 'x_stop_x_lit_1', s = 120 },\n"
                "    b = { lane = 'x_lit_x_right_first_1', s = s } }))",
                60);
    std::vector<std::string> lines;
    for (const KeptTick& tick : run(recording))
        for (const world::Event* event : *tick.recorded().view.tick->events())
            if (event->kind() == world::EventKind::printed)
                lines.push_back(event->text()->str());
    EXPECT_EQ(lines, std::vector<std::string>{"false inf"});
}

TEST(Motion, VerifiesToTheByte) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_motion_" + std::to_string(getpid()) + ".mcap");
    const std::string body = R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 14 }
        local car = spawn{ model = 'suv', driver = 'traffic', lane = 'east_0', s = 60, speed = 14 }
        ego:hold_speed(14) car:hold_speed(12) car:set_offset(0.4, { over = 2 })
        wait(1) ego:set_offset(0.3) ego:ignore_lights() car:ignore_lights()
        wait(1) ego:change_lane('left', { over = 3, shape = 'cubic' })
        wait(1) ego:set_speed(18, { over = 4, shape = 'sinusoidal' }) car:brake(4)
        wait(2) car:hold_speed(10, { over = 3, shape = 'cubic' })
        wait(1) arrive_together(ego, car, { a = { lane = 'east_2', s = 300 }, b = { lane = 'east_0', s = 200 } })
        ego:brake(5) wait(1))";
    const world::Recording recording = in_town("straight", body, 30);
    {
        replay::TraceWriter trace(path, recording);
        kernel::Kernel kernel(recording);
        while (!kernel.finished())
            trace.append(kernel.step());
        trace.close(kernel.outcome());
    }
    replay::TraceReader trace(path);
    EXPECT_EQ(kernel::verify(trace), std::nullopt);
    std::filesystem::remove(path);
}

}  // namespace reprise::test
