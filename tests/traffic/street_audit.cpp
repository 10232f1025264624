#include "tests/traffic/street_audit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "world/frames.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"

namespace reprise::test {

namespace {

constexpr double touch = 0.05;       ///< [m] of rounding, and of boxes that pass a corner
constexpr double level_apart = 2.5;  ///< [m]
constexpr double wall_top = 0.4;     ///< [m] what is lower stops no bumper
constexpr double look_back = 6;      ///< [s]
constexpr double reaction = 1;       ///< [s] of an attentive driver
constexpr double braking = 6;        ///< [m/s2] firm, on dry asphalt
constexpr double beside = 0.3;       ///< [m] at each side that a way takes
constexpr double moving = 0.5;       ///< [m/s]
constexpr std::size_t listed = 12;   ///< of a kind

double corner_reach(double half_length, double half_width) {
    return std::hypot(half_length, half_width);
}

}  // namespace

StreetAudit::StreetAudit(const world::TownT& town,
                         std::span<const world::Obstacle> walls,
                         double step)
    : town_(&town),
      walls_(walls),
      step_(step) {
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
        world::Box box;
        box.take(walls[i].position.head<2>(), walls[i].radius);
        entries.push_back({box, i});
    }
    wall_grid_ = world::BoxGrid(entries);
}

std::vector<StreetAudit::Body> StreetAudit::bodies_of(const world::TickView& tick) {
    std::vector<Body> bodies;
    const auto add = [&](std::uint32_t id,
                         Kind kind,
                         const world::Vec3& p,
                         double yaw,
                         double speed,
                         const world::Extent& extent) -> Body& {
        const Eigen::Vector2d ahead = world::ahead_of(yaw);
        bodies.push_back({id,
                          kind,
                          world::in_plan(p) + ahead * extent.middle(),
                          ahead,
                          (extent.front - extent.rear) / 2,
                          extent.half_width,
                          p.z(),
                          speed});
        return bodies.back();
    };
    const auto yaw_of = [](const world::Quat& turned) {
        const Eigen::Vector3d x = world::to_eigen(turned).toRotationMatrix().col(0);
        return std::atan2(x.y(), x.x());
    };
    for (const auto& car : tick.cars()) {
        const world::VehicleModel& model = world::vehicle_models()[car.model()];
        Body& body = add(car.id(),
                         Kind::car,
                         car.position(),
                         double{car.yaw()},
                         double{car.speed()},
                         world::extent_of(model));
        body.lane = car.lane();
        body.model = model.name;
    }
    for (const auto& vehicle : tick.vehicles()) {
        const auto* measured = world::find(tick.measurements(), vehicle.id());
        Body& body = add(vehicle.id(),
                         Kind::car,
                         vehicle.position(),
                         yaw_of(vehicle.orientation()),
                         measured == nullptr ? 0 : measured->speed(),
                         world::extent_of(world::vehicle_models()[vehicle.model()]));
        body.has_mass = true;
        body.model = world::vehicle_models()[vehicle.model()].name;
        body.lane = measured == nullptr ? world::none : measured->lane();
    }
    for (const auto& walker : tick.walkers())
        if (!walker.down())
            add(walker.id(),
                Kind::walker,
                walker.position(),
                double{walker.yaw()},
                double{walker.speed()},
                world::extent_of(world::walker_models()[walker.model()]));
    for (const auto& prop : tick.props())
        add(prop.id(),
            Kind::prop,
            prop.position(),
            yaw_of(prop.orientation()),
            0,
            world::extent_of(world::prop_models()[prop.model()]));
    std::sort(bodies.begin(), bodies.end(), [](const Body& one, const Body& other) {
        return one.id < other.id;
    });
    return bodies;
}

/// How deep two boxes lie in each other; negative: a gap that some axis shows. [m]
double StreetAudit::depth_of(const Body& one, const Body& other) {
    double least = 1e9;
    for (const Eigen::Vector2d& axis :
         {one.ahead, world::turned_left(one.ahead), other.ahead, world::turned_left(other.ahead)}) {
        const auto reach = [&axis](const Body& box) {
            return box.half_length * std::abs(box.ahead.dot(axis)) +
                   box.half_width * std::abs(world::cross(box.ahead, axis));
        };
        const double apart = std::abs((other.middle - one.middle).dot(axis));
        least = std::min(least, reach(one) + reach(other) - apart);
    }
    return least;
}

void StreetAudit::see(const world::TickView& tick) {
    tick_ = tick.index();
    std::vector<Body> bodies = bodies_of(tick);
    if (tick.tick->events() != nullptr)
        for (const world::Event* event : *tick.tick->events()) {
            if (event->kind() == world::EventKind::ran_red_light)
                last_red_[event->actor()] = tick_;
            if (event->kind() == world::EventKind::wrecked)
                wrecked_.try_emplace(event->actor(), tick_);
            if (event->kind() == world::EventKind::collision)
                met_.insert(std::minmax(event->actor(), event->other()));
        }
    measure(bodies);
    find_intrusions(bodies);
    for (const Body& body : bodies)
        if (body.kind != Kind::prop)
            find_walls(body);
    past_.push_front(std::move(bodies));
    if (static_cast<double>(past_.size()) * step_ > look_back + 3)
        past_.pop_back();
    for (const world::Crash& crash : story_.hear(tick))
        judge(crash);
    if (tick_ % static_cast<std::uint64_t>(std::llround(60 / step_)) == 0)
        end_minute();
}

void StreetAudit::finish() {
    for (const world::Crash& crash : story_.open())
        judge(crash);
    // Boxes touch a tick before bodies do.
    for (Intrusion& intrusion : intrusions_)
        intrusion.is_wreck = met_.contains(std::minmax(intrusion.who, intrusion.other));
    if (!minutes_.empty() && minutes_.back().car_ticks == 0)
        minutes_.pop_back();
}

void StreetAudit::find_intrusions(std::span<const Body> bodies) {
    std::vector<const Body*> by_x;
    for (const Body& body : bodies)
        by_x.push_back(&body);
    std::sort(by_x.begin(), by_x.end(), [](const Body* one, const Body* other) {
        return std::pair(one->middle.x(), one->id) < std::pair(other->middle.x(), other->id);
    });
    constexpr double farthest = 22;  // [m] two lorries one behind the other
    static constexpr const char* names[]{"car", "walker", "prop"};
    for (std::size_t i = 0; i < by_x.size(); ++i)
        for (std::size_t j = i + 1;
             j < by_x.size() && by_x[j]->middle.x() - by_x[i]->middle.x() < farthest;
             ++j) {
            const Body* who = by_x[i];
            const Body* other = by_x[j];
            if (who->kind > other->kind)
                std::swap(who, other);
            if (who->kind != Kind::car || std::abs(who->z - other->z) > level_apart ||
                std::abs(who->middle.y() - other->middle.y()) > farthest)
                continue;  // people brush past each other
            const double depth = depth_of(*who, *other);
            if (depth > touch)
                note(*who,
                     other->id,
                     fmt::format("car in {}", names[static_cast<std::size_t>(other->kind)]),
                     depth);
        }
}

/// In the middle of whom a wall stands; of a car also its corners.
void StreetAudit::find_walls(const Body& body) {
    world::Box box;
    box.take(body.middle, corner_reach(body.half_length, body.half_width));
    for (const std::uint32_t index : wall_grid_.near(box)) {
        const world::Obstacle& wall = walls_[index];
        if (std::abs(wall.position.z() - body.z) > level_apart || 2 * wall.half.z() < wall_top)
            continue;
        const Eigen::Vector2d to = wall.position.head<2>();
        double depth = 0;
        if (wall.shape == world::Obstacle::Shape::prism) {
            world::Loop loop;
            for (const Eigen::Vector3d& corner : wall.corners)
                loop.push_back(to + Eigen::Rotation2Dd(wall.yaw) * corner.head<2>());
            const Eigen::Vector2d along = body.ahead * body.half_length * 0.95;
            const Eigen::Vector2d left = world::turned_left(body.ahead) * body.half_width * 0.9;
            for (const Eigen::Vector2d& p : {Eigen::Vector2d(body.middle),
                                             Eigen::Vector2d(body.middle + along + left),
                                             Eigen::Vector2d(body.middle + along - left),
                                             Eigen::Vector2d(body.middle - along + left),
                                             Eigen::Vector2d(body.middle - along - left)})
                if (world::contains(loop, p))
                    depth = std::max(depth, 0.1);
        } else {
            const bool is_round = wall.shape == world::Obstacle::Shape::cylinder;
            Body standing;
            standing.middle = to;
            standing.ahead = world::ahead_of(wall.yaw);
            standing.half_length = is_round ? wall.half.x() * 0.7 : wall.half.x();
            standing.half_width = is_round ? wall.half.x() * 0.7 : wall.half.y();
            depth = depth_of(body, standing);
        }
        if (depth > touch)
            note(body,
                 0,
                 body.kind == Kind::car ? "car in a wall or pole" : "walker in a wall or pole",
                 depth,
                 fmt::format("{}; {:.2f} m wide at {:.1f}, {:.1f}",
                             lane_of(body),
                             2 * wall.radius,
                             to.x(),
                             to.y()));
    }
}

void StreetAudit::note(const Body& who,
                       std::uint32_t other,
                       const std::string& what,
                       double depth,
                       const std::string& details) {
    const std::uint64_t apart = static_cast<std::uint64_t>(1 / step_);
    const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(who.id, other);
    const auto [open, is_new] = open_.try_emplace(key, intrusions_.size());
    if (is_new || intrusions_[open->second].last + apart < tick_) {
        open->second = intrusions_.size();
        intrusions_.push_back({who.id, other, what, tick_, tick_, depth, who.middle, details});
    }
    Intrusion& intrusion = intrusions_[open->second];
    intrusion.last = tick_;
    if (depth >= intrusion.depth)
        intrusion.details = details;
    intrusion.depth = std::max(intrusion.depth, depth);
}

std::string StreetAudit::lane_of(const Body& body) const {
    const std::string what = body.model;
    return body.lane < town_->lanes.size() ? what + " on " + town_->lanes[body.lane].name : what;
}

void StreetAudit::measure(std::span<const Body> bodies) {
    if (minutes_.empty())
        minutes_.emplace_back();
    for (const Body& body : bodies) {
        if (body.kind != Kind::car)
            continue;
        const double way = std::abs(body.speed) * step_;
        minutes_.back().driven += way;
        ++minutes_.back().car_ticks;
        way_[body.id] += way;
    }
}

void StreetAudit::end_minute() {
    Minute& minute = minutes_.back();
    for (const Body& body : past_.front())
        if (const auto way = way_.find(body.id); body.kind == Kind::car && way != way_.end()) {
            ++minute.cars;
            minute.standing += way->second < 2 ? 1 : 0;
        }
    way_.clear();
    minutes_.emplace_back();
}

const StreetAudit::Body* StreetAudit::find(std::size_t back, std::uint32_t id) const {
    if (back >= past_.size())
        return nullptr;
    const auto& bodies = past_[back];
    const auto at = std::lower_bound(
        bodies.begin(), bodies.end(), id, [](const Body& body, std::uint32_t wanted) {
            return body.id < wanted;
        });
    return at != bodies.end() && at->id == id ? &*at : nullptr;
}

/// As far as ticks tell it: who moved, who was ahead, who had a light against it.
std::string StreetAudit::fault_of(const Body& driver, const Body& other, std::uint64_t tick) const {
    const auto ran_red = [&](std::uint32_t id) {
        const auto at = last_red_.find(id);
        return at != last_red_.end() && at->second <= tick &&
               static_cast<double>(tick - at->second) * step_ < look_back;
    };
    if (ran_red(driver.id))
        return "it ran a red light";
    if (ran_red(other.id))
        return "the other ran a red light";
    if (std::abs(driver.speed) < moving)
        return "it stood; the other came";
    const Eigen::Vector2d to = other.middle - driver.middle;
    const bool is_ahead = to.dot(driver.ahead) > 0;
    if (other.kind == Kind::walker) {
        const bool on_crossing =
            std::any_of(town_->lanes.begin(), town_->lanes.end(), [&](const world::LaneT& lane) {
                return lane.kind == world::LaneKind::crossing && lane.centre.size() > 1 &&
                       world::distance_to({world::in_plan(lane.centre.front()),
                                           world::in_plan(lane.centre.back())},
                                          other.middle,
                                          other.middle) < lane.width / 2;
            });
        return on_crossing ? "the other was on a crossing: it had to let him pass"
                           : "the other crossed away from crossings";
    }
    if (std::abs(other.speed) < moving)
        return is_ahead ? "the other stood in its way" : "the other stood, and it backed into it";
    const double turned = driver.ahead.dot(other.ahead);
    if (turned > 0.7)
        return is_ahead ? "it ran into who drove ahead of it" : "the other ran into its back";
    if (turned < -0.7)
        return driver.lane == other.lane ? "head on, in one lane" : "head on";
    const Eigen::Vector2d seen = other.middle - driver.middle;
    return world::cross(driver.ahead, seen) > 0 ? "ways cross; the other came from the left"
                                                : "ways cross; the other came from the right";
}

/// Nobody drove it any more.
bool StreetAudit::is_wreck(std::uint32_t id, std::uint64_t tick) const {
    const auto at = wrecked_.find(id);
    return at != wrecked_.end() && at->second < tick;
}

/// Looks back along the way that the driver took: since when was the other within it, and could it
/// have stopped in the room that there was?
void StreetAudit::judge(const world::Crash& crash) {
    const auto began = static_cast<std::size_t>(tick_ - std::min(tick_, crash.tick));
    const std::size_t before = began + 1;  // the crash itself moves both
    Collision found;
    found.crash = crash;
    const Body* one = find(before, crash.actor);
    const Body* two = find(before, crash.other);
    if (one == nullptr || (two != nullptr && two->kind == Kind::car &&
                           std::abs(two->speed) > std::abs(one->speed) && one->kind == Kind::car))
        std::swap(one, two);
    if (one != nullptr && two != nullptr && two->kind == Kind::car &&
        (one->kind != Kind::car || is_wreck(one->id, crash.tick)))
        std::swap(one, two);
    if (one != nullptr && is_wreck(one->id, crash.tick)) {
        found.fault = "a wreck that rolled or was pushed: nobody drove it";
        collisions_.push_back(found);
        return;
    }
    if (one == nullptr) {
        found.fault = "too long ago to tell";
        collisions_.push_back(found);
        return;
    }
    if (one->lane < town_->lanes.size())
        found.lane = town_->lanes[one->lane].name;
    if (two == nullptr && crash.other != 0) {
        found.fault = "the other appeared where it drove";
        collisions_.push_back(found);
        return;
    }
    if (two == nullptr) {
        found.fault = std::abs(one->speed) < moving ? "it stood" : "it left its way";
        found.avoidable = std::abs(one->speed) >= moving;
        collisions_.push_back(found);
        return;
    }
    found.fault = fault_of(*one, *two, crash.tick);
    double way = 0;
    std::vector<const Body*> trail{one};
    if (const Body* there = find(began, one->id))
        trail.push_back(there);
    for (std::size_t back = before; static_cast<double>(back - before) * step_ < look_back;
         ++back) {
        const Body* driver = find(back, one->id);
        const Body* other = find(back, two->id);
        if (driver == nullptr || other == nullptr)
            break;
        const bool in_way =
            back == before || std::any_of(trail.begin(), trail.end(), [&](const Body* place) {
                Body wide = *place;
                wide.half_width += beside;
                wide.half_length += beside;
                return depth_of(wide, *other) > 0;
            });
        if (!in_way)
            break;
        trail.push_back(driver);
        way += std::abs(driver->speed) * step_;
        found.seen_for = static_cast<double>(back - before) * step_;
        found.room = way;
        const double speed = std::abs(driver->speed);
        // Who drives on ahead needs only to be followed.
        const double closing =
            std::max(0.0, speed - std::max(0.0, other->speed * driver->ahead.dot(other->ahead)));
        found.needed = closing * reaction + closing * closing / (2 * braking);
    }
    found.avoidable =
        std::abs(one->speed) >= moving && found.seen_for > reaction && found.needed < found.room;
    collisions_.push_back(found);
}

std::string StreetAudit::text() const {
    std::string text = "minute  mean speed  cars  stood\n";
    for (std::size_t i = 0; i < minutes_.size(); ++i) {
        const Minute& minute = minutes_[i];
        text += fmt::format(
            "{:>6}{:>8.2f} m/s{:>6}{:>7}{}\n",
            i + 1,
            minute.driven / std::max(1e-9, static_cast<double>(minute.car_ticks) * step_),
            minute.cars,
            minute.standing,
            is_gridlock(minute) ? "  GRIDLOCK" : "");
    }
    std::map<std::string, std::vector<const Intrusion*>> kinds;
    for (const Intrusion& intrusion : intrusions_)
        kinds[intrusion.what + (intrusion.is_wreck ? ", of a crash" : "")].push_back(&intrusion);
    text += "one in another:";
    text += kinds.empty() ? " none\n" : "\n";
    for (auto& [what, all] : kinds) {
        std::sort(all.begin(), all.end(), [](const Intrusion* one, const Intrusion* other) {
            return one->depth > other->depth;
        });
        text += fmt::format("  {} {}\n", all.size(), what);
        for (std::size_t i = 0; i < std::min<std::size_t>(listed, all.size()); ++i)
            text += fmt::format(
                "      {} and {}: {:.2f} m, {:.2f} s to {:.2f} s, at {:.1f}, {:.1f} {}\n",
                all[i]->who,
                all[i]->other,
                all[i]->depth,
                static_cast<double>(all[i]->first) * step_,
                static_cast<double>(all[i]->last) * step_,
                all[i]->place.x(),
                all[i]->place.y(),
                all[i]->details);
    }
    text += fmt::format("collisions: {}, avoidable by an attentive driver: {}\n",
                        collisions_.size(),
                        std::count_if(collisions_.begin(), collisions_.end(), [](const auto& one) {
                            return one.avoidable;
                        }));
    for (const Collision& one : collisions_)
        text += fmt::format(
            "  {:8.2f} s  {}; on {}; {}; in its way for {:.2f} s, {:.1f} m of room, "
            "{:.1f} m to stop: {}\n",
            static_cast<double>(one.crash.tick) * step_,
            to_line(one.crash),
            one.lane.empty() ? "no lane" : one.lane,
            one.fault,
            one.seen_for,
            one.room,
            one.needed,
            one.avoidable ? "AVOIDABLE" : "not to be avoided");
    return text;
}

}  // namespace reprise::test
