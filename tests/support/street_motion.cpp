#include "tests/support/street_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"

namespace reprise::test {

namespace {

constexpr double grid = 0.002;      // [m] two of the record's steps
constexpr double yaw_grid = 0.001;  // [rad] likewise

struct Box2 {
    Eigen::Vector2d middle;
    Eigen::Vector2d ahead;
    double half_length;
    double half_width;
    double z;
};

Box2 box_of(const world::CarState& car) {
    const world::Extent extent = world::extent_of(world::vehicle_models()[car.model()]);
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(car.yaw()));
    return {world::in_plan(car.position()) + ahead * extent.middle(),
            ahead,
            (extent.front - extent.rear) / 2,
            extent.half_width,
            car.position().z()};
}

/// How deep two boxes lie in each other; negative: a gap that some axis shows. [m]
double depth_of(const Box2& one, const Box2& other) {
    double least = 1e9;
    for (const Eigen::Vector2d& axis :
         {one.ahead, world::turned_left(one.ahead), other.ahead, world::turned_left(other.ahead)}) {
        const auto reach = [&axis](const Box2& box) {
            return box.half_length * std::abs(box.ahead.dot(axis)) +
                   box.half_width * std::abs(world::cross(box.ahead, axis));
        };
        const double apart = std::abs((other.middle - one.middle).dot(axis));
        least = std::min(least, reach(one) + reach(other) - apart);
    }
    return least;
}

std::array<Eigen::Vector2d, 4> corners_of(const world::CarState& car) {
    const Box2 box = box_of(car);
    const Eigen::Vector2d along = box.ahead * box.half_length;
    const Eigen::Vector2d left = world::turned_left(box.ahead) * box.half_width;
    return {box.middle + along + left,
            box.middle + along - left,
            box.middle - along + left,
            box.middle - along - left};
}

double speed_of(const world::CarState& car) {
    return static_cast<double>(car.speed());
}

}  // namespace

StreetMotion::StreetMotion(const world::TownT& town, double step) : town_(&town), step_(step) {}

void StreetMotion::add(Count& count, std::uint32_t car, double value) const {
    const Place place{tick_, car, value};
    if (count.times++ == 0 || value > count.worst.value)
        count.worst = place;
    if (count.first.size() < 20)
        count.first.push_back(place);
}

void StreetMotion::see(const world::TickView& tick) {
    tick_ = tick.index();
    std::vector<world::CarState> cars;
    for (const world::CarState& car : tick.cars())
        if (car.id() >= world::first_background_id)
            cars.push_back(car);
    for (const world::CarState& is : cars)
        if (const world::CarState* was = world::find(last_, is.id()))
            compare(*was, is);
    find_overlaps(cars);
    last_ = std::move(cars);
}

void StreetMotion::compare(const world::CarState& was, const world::CarState& is) {
    ++car_ticks;
    const double speed = std::max(speed_of(was), speed_of(is));
    const Eigen::Vector2d moved = world::in_plan(is.position()) - world::in_plan(was.position());
    const double turned = world::wrap_angle(static_cast<double>(is.yaw() - was.yaw()));
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(was.yaw()) + turned / 2);
    const double way = speed * step_;
    driven += moved.norm();

    if (speed < 0.1) {
        const auto before = corners_of(was);
        const auto now = corners_of(is);
        double farthest = 0;
        for (std::size_t i = 0; i < 4; ++i)
            farthest = std::max(farthest, (now[i] - before[i]).norm() - way);
        if (farthest > 2 * grid) {  // a corner is as far away as a bus is long
            add(slides, is.id(), farthest);
            slid += farthest;
            double& by_car = slid_by_[is.id()];
            by_car += farthest;
            if (by_car > 0.1)
                sliders.insert(is.id());
        }
    }
    const double sideways = std::abs(world::cross(ahead, moved));
    if (sideways > 0.6 * way + grid)
        add(sidesteps, is.id(), sideways);
    if (std::abs(turned) > 0.45 * way + yaw_grid)
        add(spins, is.id(), std::abs(turned));
    if (std::abs(turned) > 10 * std::numbers::pi / 180)
        add(heading_steps, is.id(), std::abs(turned) * 180 / std::numbers::pi);
    if (moved.norm() > way + 0.3)
        add(jumps, is.id(), moved.norm() - way);
    if (moved.dot(ahead) < -0.02)
        add(backward, is.id(), -moved.dot(ahead));
    const double sideways_acceleration = speed * std::abs(turned) / step_;
    if (sideways_acceleration > 4)
        add(hard_bends, is.id(), sideways_acceleration);
    const double acceleration = (speed_of(is) - speed_of(was)) / step_;
    const bool brake_lamp = (is.lamps() & world::lamp_brake) != 0;
    if (acceleration < -1 && !brake_lamp)
        add(dark_brakes, is.id(), -acceleration);
    if (acceleration > 0.3 && brake_lamp)
        add(false_brakes, is.id(), acceleration);
    follow_turn(is);
}

/// By what the map says of the link, as on around a roundabout.
bool StreetMotion::goes_straight_on(std::uint32_t from, std::uint32_t to) const {
    if (from == world::none)
        return false;
    for (const world::Link& link : town_->lanes[from].links)
        if (link.to() == to)
            return link.turn() == world::Turn::straight;
    return false;
}

void StreetMotion::follow_turn(const world::CarState& is) {
    Turn& turn = turns_[is.id()];
    const bool inside =
        is.lane() != world::none && town_->lanes[is.lane()].kind == world::LaneKind::internal;
    const bool left = (is.lamps() & world::lamp_left) != 0;
    const bool right = (is.lamps() & world::lamp_right) != 0;
    constexpr int early = 10;  // [ticks]
    Lit& lit = lit_[is.id()];
    const Lit before = lit;
    lit.left = left ? lit.left + 1 : 0;
    lit.right = right ? lit.right + 1 : 0;
    lit.ticks = lit.lane == is.lane() ? lit.ticks + 1 : 0;
    lit.lane = is.lane();
    if (!inside) {
        // The front is out; the body follows, and whether it turned shows along the lane.
        if (turn.junction != world::none && is.lane() != world::none) {
            const world::LaneT& lane = town_->lanes[is.lane()];
            const double turned = world::wrap_angle(world::point_at(lane, 0).yaw - turn.yaw);
            if (std::abs(turned) > 0.7 && std::abs(turned) < 2.6 &&
                !goes_straight_on(turn.from, is.lane())) {
                ++turns;
                if (turned > 0 ? !turn.early_left : !turn.early_right)
                    add(late_lamps, is.id(), std::abs(turned));
                if (turned > 0 ? !turn.left : !turn.right)
                    add(dark_turns, is.id(), std::abs(turned));
            }
        }
        turn = Turn{};
        turn.from = is.lane();
        return;
    }
    const std::uint32_t junction = town_->lanes[is.lane()].junction;
    if (turn.junction == world::none) {
        turn.junction = junction;
        turn.yaw = world::point_at(town_->lanes[is.lane()], 0).yaw;
        const int long_enough = std::min(early, before.ticks);
        turn.early_left = before.left >= long_enough;
        turn.early_right = before.right >= long_enough;
    }
    turn.left = turn.left || left;
    turn.right = turn.right || right;
}

void StreetMotion::find_overlaps(std::span<const world::CarState> cars) {
    constexpr double touch = 0.01;  // [m] of rounding
    constexpr double level = 2.5;   // [m] one above the other
    std::vector<Box2> boxes;
    boxes.reserve(cars.size());
    for (const world::CarState& car : cars)
        boxes.push_back(box_of(car));
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const double reach = boxes[i].half_length + boxes[j].half_length + 3;
            if ((boxes[i].middle - boxes[j].middle).squaredNorm() > reach * reach ||
                std::abs(boxes[i].z - boxes[j].z) > level)
                continue;
            const double depth = depth_of(boxes[i], boxes[j]);
            if (depth > touch)
                add(overlaps, cars[i].id(), depth);
        }
}

std::string StreetMotion::text() const {
    std::string text =
        fmt::format("{:<16}{:>9}{:>12}{:>10}  worst\n", "car-ticks", car_ticks, "a 1,000", "");
    const auto row = [&](const char* name, const Count& count, const char* unit) {
        text += fmt::format("{:<16}{:>9}{:>12.4f}{:>10}",
                            name,
                            count.times,
                            1000.0 * static_cast<double>(count.times) /
                                static_cast<double>(std::max<std::uint64_t>(car_ticks, 1)),
                            "");
        if (count.times > 0)
            text += fmt::format("  {:.3f} {} by {} in tick {}",
                                count.worst.value,
                                unit,
                                count.worst.car,
                                count.worst.tick);
        text += '\n';
    };
    row("slides", slides, "m");
    row("sidesteps", sidesteps, "m");
    row("spins", spins, "rad");
    row("heading steps", heading_steps, "deg");
    row("jumps", jumps, "m");
    row("backward", backward, "m");
    row("overlaps", overlaps, "m");
    row("hard bends", hard_bends, "m/s^2");
    row("dark brakes", dark_brakes, "m/s^2");
    row("false brakes", false_brakes, "m/s^2");
    row("dark turns", dark_turns, "rad");
    row("late lamps", late_lamps, "rad");
    text += fmt::format("{} cars slid {:.1f} m; {} turns; mean speed {:.2f} m/s\n",
                        sliders.size(),
                        slid,
                        turns,
                        driven / std::max(static_cast<double>(car_ticks) * step_, 1e-9));
    return text;
}

}  // namespace reprise::test
