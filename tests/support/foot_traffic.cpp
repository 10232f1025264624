#include "tests/support/foot_traffic.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ground/obstacles.h"
#include "world/frames.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"

namespace reprise::test {

namespace {

constexpr double brushed = 0.05;   // [m] deep: sleeves
constexpr double storey = 2;       // [m]
constexpr double foresight = 1.5;  // [s]

struct Box2 {
    Eigen::Vector2d middle;
    Eigen::Vector2d ahead;
    double half_length = 0;
    double half_width = 0;
};

/// How far a disc reaches into a box; negative: how far it is away. [m]
double depth_in(const Box2& box, const Eigen::Vector2d& p, double radius) {
    const Eigen::Vector2d offset = p - box.middle;
    const double along = std::abs(offset.dot(box.ahead)) - box.half_length;
    const double across = std::abs(world::cross(box.ahead, offset)) - box.half_width;
    const double outside = std::hypot(std::max(along, 0.0), std::max(across, 0.0));
    return radius - (outside > 0 ? outside : std::max(along, across));
}

Box2 box_of(const world::Extent& extent,
            const Eigen::Vector2d& rear_axle,
            const Eigen::Vector2d& ahead) {
    return {rear_axle + ahead * extent.middle(),
            ahead,
            (extent.front - extent.rear) / 2,
            extent.half_width};
}

Eigen::Vector2d level(const world::Quat& orientation) {
    const Eigen::Vector2d ahead =
        (world::to_eigen(orientation) * Eigen::Vector3d::UnitX()).head<2>();
    return ahead.norm() > 0.1 ? Eigen::Vector2d(ahead.normalized()) : Eigen::Vector2d(1, 0);
}

/// SUMO's cars and vehicles with mass.
struct Body {
    std::uint32_t id = 0;
    Box2 box;
    double z = 0;
    double speed = 0;  ///< [m/s] ahead
};

std::vector<Body> bodies_in(const world::TickView& tick) {
    std::vector<Body> bodies;
    for (const world::CarState& car : tick.cars())
        bodies.push_back({car.id(),
                          box_of(world::extent_of(world::vehicle_models()[car.model()]),
                                 world::in_plan(car.position()),
                                 world::ahead_of(static_cast<double>(car.yaw()))),
                          car.position().z(),
                          static_cast<double>(car.speed())});
    for (const world::VehicleState& vehicle : tick.vehicles()) {
        const Eigen::Vector2d ahead = level(vehicle.orientation());
        bodies.push_back(
            {vehicle.id(),
             box_of(world::extent_of(world::vehicle_models()[vehicle.model()]),
                    world::in_plan(vehicle.position()),
                    ahead),
             vehicle.position().z(),
             ahead.dot(Eigen::Vector2d(vehicle.velocity().x(), vehicle.velocity().y()))});
    }
    return bodies;
}

double radius_of(const world::WalkerState& walker) {
    return world::walker_models()[walker.model()].shoulder_width / 2;
}

/// [m] of a place below the outline's nearest side; negative: outside.
double depth_in(const world::Obstacle& obstacle, const Eigen::Vector3d& p) {
    const double top = obstacle.position.z() + 2 * obstacle.half.z() - obstacle.depth;
    if (p.z() > top - 0.1 || p.z() < obstacle.position.z() - storey)
        return -1;
    const Eigen::Vector2d gap = (p - obstacle.position).head<2>();
    if (obstacle.shape == world::Obstacle::Shape::cylinder)
        return obstacle.half.x() - gap.norm();
    if (obstacle.shape == world::Obstacle::Shape::prism) {
        double least = 1e9;
        for (std::size_t i = 0; i < obstacle.corners.size(); ++i) {
            const Eigen::Vector2d from = obstacle.corners[i].head<2>();
            const Eigen::Vector2d side =
                obstacle.corners[(i + 1) % obstacle.corners.size()].head<2>() - from;
            if (side.norm() > 1e-6)
                least = std::min(least, world::cross(side.normalized(), gap - from));
        }
        return least;
    }
    const Eigen::Vector2d ahead = world::ahead_of(obstacle.yaw);
    return std::min(obstacle.half.x() - std::abs(gap.dot(ahead)),
                    obstacle.half.y() - std::abs(world::cross(ahead, gap)));
}

/// On the crossing, or a step off it.
bool is_beside_crossing(const world::LaneT& lane, const Eigen::Vector3d& p) {
    constexpr double step = 0.75;  // [m]
    if (lane.kind != world::LaneKind::crossing ||
        (p - world::to_eigen(lane.centre.front())).norm() > lane.length + lane.width)
        return false;
    return world::project(lane, p).distance < lane.width / 2 + step;
}

std::string line(const char* name, const FootTraffic::Count& count) {
    std::string text = fmt::format("{:<34}{:>9}", name, count.times);
    if (count.times > 0)
        text += fmt::format("   worst {:.3f}: walker {} and {} in tick {} at {:.1f}, {:.1f}",
                            count.worst.value,
                            count.worst.walker,
                            count.worst.other,
                            count.worst.tick,
                            count.worst.x,
                            count.worst.y);
    return text + "\n";
}

}  // namespace

FootTraffic::FootTraffic(const world::TownT& town, const world::LaneMap& lanes, double step)
    : town_(&town),
      lanes_(&lanes),
      step_(step),
      obstacles_(ground::obstacles_of(town)) {
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
        world::Box box;
        box.take(obstacles_[i].position.head<2>(), obstacles_[i].radius);
        entries.push_back({box, i});
    }
    obstacles_by_place_ = world::BoxGrid(entries);
}

void FootTraffic::add(Count& count, Place place) const {
    if (count.times++ == 0 || place.value > count.worst.value)
        count.worst = place;
    if (count.first.size() < 20)
        count.first.push_back(place);
}

/// On a lane for cars or a crossing, and not on the sidewalk.
bool FootTraffic::is_on_road(const Eigen::Vector3d& p,
                             std::vector<std::uint32_t>& crossings) const {
    constexpr double within = 0.2;  // [m] a foot over the kerb is none
    crossings.clear();
    bool on_pavement = false;
    for (const world::LaneMap::Found& found : lanes_->walkable_at(p)) {
        const world::LaneT& lane = town_->lanes[found.lane];
        if (lane.kind != world::LaneKind::crossing)
            on_pavement = true;
        else if (found.at.s > within && found.at.s < lane.length - within)
            crossings.push_back(found.lane);
    }
    if (!crossings.empty())
        return true;
    if (on_pavement)
        return false;
    const auto roads = lanes_->at(p);
    bool on_road = std::any_of(roads.begin(), roads.end(), [&](const world::LaneMap::Found& found) {
        return std::abs(found.at.t) < town_->lanes[found.lane].width / 2 - within;
    });
    // Where two lanes meet there is no kerb.
    std::vector<Eigen::Vector2d> middles;
    for (const world::LaneMap::Found& found : lanes_->at(p, within))
        middles.emplace_back(
            (world::point_at(town_->lanes[found.lane], found.at.s).position - p).head<2>());
    for (const Eigen::Vector2d& one : middles)
        for (const Eigen::Vector2d& other : middles)
            on_road = on_road || one.dot(other) < -0.5 * one.norm() * other.norm();
    // Between the kerb and where a crossing is said to begin.
    if (on_road)
        for (std::uint32_t i = 0; i < town_->lanes.size(); ++i)
            if (is_beside_crossing(town_->lanes[i], p))
                crossings.push_back(i);
    return on_road;
}

void FootTraffic::find_in_boxes(const world::WalkerState& walker,
                                const world::TickView& tick,
                                Walker& known) {
    const Eigen::Vector2d p = world::in_plan(walker.position());
    const double radius = radius_of(walker);
    for (const Body& body : bodies_in(tick)) {
        if (std::abs(body.z - walker.position().z()) > storey)
            continue;
        const double depth = depth_in(body.box, p, radius);
        if (depth > brushed)
            known.inside.push_back({tick_, walker.id(), body.id, depth, p.x(), p.y()});
    }
    for (const world::PropState& prop : tick.props()) {
        const world::PropModel& model = world::prop_models()[prop.model()];
        const Box2 box{world::in_plan(prop.position()),
                       level(prop.orientation()),
                       model.length / 2,
                       model.width / 2};
        const double depth = depth_in(box, p, radius);
        if (depth > brushed && std::abs(prop.position().z() - walker.position().z()) < storey)
            add(in_props, {tick_, walker.id(), prop.id(), depth, p.x(), p.y()});
    }
    const Eigen::Vector3d place = world::to_eigen(walker.position());
    world::Box here;
    here.take(p);
    for (const std::uint32_t i : obstacles_by_place_.near(here))
        if (const double depth = depth_in(obstacles_[i], place); depth > brushed)
            add(in_obstacles, {tick_, walker.id(), i, depth, p.x(), p.y()});
}

/// Somebody has stepped from the pavement onto the road.
void FootTraffic::enter(const world::WalkerState& walker, const world::TickView& tick) {
    std::vector<std::uint32_t> crossings;
    const Eigen::Vector3d p = world::to_eigen(walker.position());
    is_on_road(p, crossings);
    who_crossed.insert(walker.id());
    const Place place{tick_, walker.id(), 0, 0, p.x(), p.y()};
    if (crossings.empty()) {
        ++elsewhere;
        who_crossed_elsewhere.insert(walker.id());
        for (const Body& body : bodies_in(tick)) {
            if (body.speed < 1 || std::abs(body.z - p.z()) > storey)
                continue;
            Box2 swept = body.box;
            const double way = body.speed * foresight;
            swept.middle += way / 2 * swept.ahead;
            swept.half_length += way / 2;
            if (depth_in(swept, p.head<2>(), radius_of(walker)) < 0)
                continue;
            const double left =
                (p.head<2>() - body.box.middle).dot(body.box.ahead) - body.box.half_length;
            Place near = place;
            near.other = body.id;
            near.value = foresight - std::max(left, 0.0) / body.speed;
            add(without_gap, near);
        }
        return;
    }
    bool lit = false;
    std::uint64_t green = 0;  // last tick of any
    for (std::uint32_t i = 0; i < town_->signals.size(); ++i) {
        const world::SignalT& signal = town_->signals[i];
        if (!signal.for_walkers ||
            std::find(crossings.begin(), crossings.end(), signal.lane) == crossings.end())
            continue;
        lit = true;
        const auto at = green_at_.find(i);
        green = std::max(green, at == green_at_.end() ? 0 : at->second);
    }
    const double since = static_cast<double>(tick_ - green) * step_;
    if (!lit)
        ++on_unlit;
    else if (since <= 1)
        ++at_green;
    else
        add(at_red, {tick_, walker.id(), crossings.front(), since, p.x(), p.y()});
}

/// Who stays within a metre of where he was, and for how long.
void FootTraffic::see_stay(const world::WalkerState& walker, bool on_road, Walker& known) {
    constexpr double within = 1;         // [m]
    constexpr double long_stay = 60;     // [s]
    constexpr double long_on_road = 10;  // [s]
    const Eigen::Vector2d p = world::in_plan(walker.position());
    standing += !walker.down() && walker.speed() < 0.1F;
    if (known.seen == 0 || walker.down() || (p - known.stay).norm() > within) {
        known.stay = p;
        known.stay_since = tick_;
    }
    const auto ticks = tick_ - known.stay_since;
    const auto after = [&](double seconds) {
        return ticks == static_cast<std::uint64_t>(std::lround(seconds / step_));
    };
    const Place place{tick_, walker.id(), 0, static_cast<double>(ticks) * step_, p.x(), p.y()};
    if (after(long_stay))
        add(stood, place);
    if (on_road && after(long_on_road))
        add(stood_on_road, place);
}

/// Who turns to and fro.
void FootTraffic::see_swings(const world::WalkerState& walker, Walker& known) {
    constexpr double least = 0.35;  // [rad]
    constexpr unsigned many = 4;
    const auto yaw = static_cast<double>(walker.yaw());
    const double turn = known.seen == 0 ? 0 : world::wrap_angle(yaw - known.yaw);
    known.yaw = yaw;
    const auto second = static_cast<std::uint64_t>(std::lround(1 / step_));
    if (tick_ > known.turned_at + second)
        known.swings = 0;
    const double before = known.turn;
    known.turn = turn * before < 0 ? turn : before + turn;
    if (turn * before >= 0 || std::abs(before) < least)
        return;
    known.turned_at = tick_;
    if (++known.swings == many)
        add(dithers, {tick_, walker.id(), 0, many, walker.position().x(), walker.position().y()});
}

void FootTraffic::look_at(const world::WalkerState& walker, const world::TickView& tick) {
    const Eigen::Vector3d p = world::to_eigen(walker.position());
    ++walker_ticks;
    Walker& known = walkers_[walker.id()];
    const bool is_new = known.seen == 0;
    std::vector<std::uint32_t> crossings;
    const bool on_road = is_on_road(p, crossings);
    if (!is_new) {
        const double way = (p - known.place).head<2>().norm();
        this->way += way;
        const double most = static_cast<double>(walker.speed()) * step_ + 0.05;
        if (way > most)
            add(jumps, {tick_, walker.id(), 0, way - most, p.x(), p.y()});
        if (on_road && !known.on_road && !walker.down())
            enter(walker, tick);
    }
    if (!walker.down())
        find_in_boxes(walker, tick, known);
    // Who falls in the next ticks was hit, and no ghost.
    constexpr std::uint64_t falls_within = 5;
    std::erase_if(known.inside, [&](const Place& place) {
        if (!walker.down() && tick_ < place.tick + falls_within)
            return false;
        add(walker.down() ? hit : in_cars, place);
        return true;
    });
    see_stay(walker, on_road, known);
    see_swings(walker, known);
    known.place = p;
    known.on_road = on_road;
    known.down = walker.down();
    known.seen = tick_;
}

void FootTraffic::see(const world::TickView& tick) {
    tick_ = tick.index();
    const auto signals = tick.signals();
    for (std::size_t i = 0; i < signals.size(); ++i)
        if (signals[i] == world::SignalColor::green)
            green_at_[static_cast<std::uint32_t>(i)] = tick_;
    for (const world::WalkerState& walker : tick.walkers())
        look_at(walker, tick);
    std::erase_if(walkers_, [&](const auto& entry) {
        if (entry.second.seen == tick_)
            return false;
        removed += !entry.second.down;
        for (const Place& place : entry.second.inside)
            add(in_cars, place);
        return true;
    });
    const auto walkers = tick.walkers();
    for (std::size_t i = 0; i < walkers.size(); ++i)
        for (std::size_t j = i + 1; j < walkers.size(); ++j) {
            const double apart =
                (world::in_plan(walkers[i].position()) - world::in_plan(walkers[j].position()))
                    .norm();
            const double depth = radius_of(walkers[i]) + radius_of(walkers[j]) - apart;
            if (depth > brushed &&
                std::abs(walkers[i].position().z() - walkers[j].position().z()) < storey)
                add(in_others,
                    {tick_,
                     walkers[i].id(),
                     walkers[j].id(),
                     depth,
                     walkers[i].position().x(),
                     walkers[i].position().y()});
        }
}

std::string FootTraffic::text() const {
    std::string text = fmt::format("{:<34}{:>9}\n", "walker-ticks", walker_ticks);
    text += line("in a car, on his feet", in_cars);
    text += line("in a car, falls or lies", hit);
    text += line("in what stands there", in_obstacles);
    text += line("in a prop", in_props);
    text += line("in somebody else", in_others);
    text += line("jumps", jumps);
    text += fmt::format("{:<34}{:>9}\n", "onto a lit crossing at green", at_green);
    text += line("onto a lit crossing at red", at_red);
    text += fmt::format("{:<34}{:>9}\n", "onto a crossing without lights", on_unlit);
    text += fmt::format("{:<34}{:>9}\n", "onto the road elsewhere", elsewhere);
    text += line("onto the road before a car", without_gap);
    text += fmt::format("{:<34}{:>9}   of {} who crossed\n",
                        "who crossed elsewhere",
                        who_crossed_elsewhere.size(),
                        who_crossed.size());
    text += fmt::format("{:<34}{:>9}\n", "removed without being hit", removed);
    const auto ticks = static_cast<double>(std::max<std::uint64_t>(walker_ticks, 1));
    text += fmt::format("{:<34}{:>9.2f}\n", "mean speed [m/s]", way / (ticks * step_));
    text +=
        fmt::format("{:<34}{:>9.1f}\n", "stand [%]", 100 * static_cast<double>(standing) / ticks);
    text += line("within a metre for a minute", stood);
    text += line("on the road, there for 10 s", stood_on_road);
    text += line("turn to and fro", dithers);
    return text;
}

std::string FootTraffic::places() const {
    std::string text;
    const auto tell = [&](const char* name, const Count& count) {
        for (const Place& place : count.first)
            text += fmt::format("{}: {:.3f}: walker {} and {} in tick {} at {:.2f}, {:.2f}\n",
                                name,
                                place.value,
                                place.walker,
                                place.other,
                                place.tick,
                                place.x,
                                place.y);
    };
    tell("in a car, on his feet", in_cars);
    tell("in a car, falls or lies", hit);
    tell("in what stands there", in_obstacles);
    tell("in a prop", in_props);
    tell("in somebody else", in_others);
    tell("jumps", jumps);
    tell("onto a lit crossing at red", at_red);
    tell("onto the road before a car", without_gap);
    tell("within a metre for a minute", stood);
    tell("on the road, there for 10 s", stood_on_road);
    tell("turn to and fro", dithers);
    return text;
}

}  // namespace reprise::test
