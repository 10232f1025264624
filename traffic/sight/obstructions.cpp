#include "traffic/sight/obstructions.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr double lost = 0.001;            // [m] more than rounding takes
constexpr double beside_the_lane = 0.2;   // [m] beyond its edge it takes no room of it
constexpr double foresight = 0.7;         // [s] of a walker's way
constexpr double least_walk = 0.3;        // [m/s] slower ones stand
constexpr double least_clearance = 0.1;   // [m] beside who stands
constexpr double along_its_lane = 0.8;    // cosine: who stands across a lane is not on its way
constexpr double turning_room = 15;       // [m] at the end of a street, where one turns around,
constexpr double behind_who_turns = 5.5;  // [m] to and fro
constexpr double halts_shortly = 5;       // [s] as everybody does
constexpr double halts_at_most = 30;      // [s] on its way; who stands for longer stays

// Who is off every lane by a step or more need not be looked at in every tick.
constexpr double small = 0.6;         // [m] half of what is looked at this way
constexpr double longest_step = 2.5;  // [m]
constexpr double most_clear = 2;      // [m]

/// Half the extent of a box in a direction.
double half_extent(const Footprint& box, const Eigen::Vector2d& direction) {
    return box.half_length * std::abs(box.direction.dot(direction)) +
           box.half_width * std::abs(world::cross(box.direction, direction));
}

bool is_dead_end(const world::LaneT& lane) {
    return !lane.links.empty() &&
           std::all_of(lane.links.begin(), lane.links.end(), [](const world::Link& link) {
               return link.turn() == world::Turn::around;
           });
}

}  // namespace

double Obstruction::begin_between(double from, double to) const {
    double low = corners[0].y();
    double high = corners[0].y();
    for (const Eigen::Vector2d& corner : corners) {
        low = std::min(low, corner.y());
        high = std::max(high, corner.y());
    }
    // As much as it takes beside its body.
    from -= left - high;
    to += low - right;
    double first = world::infinity;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d& one = corners[i];
        const Eigen::Vector2d& other = corners[(i + 1) % corners.size()];
        if (one.y() >= from && one.y() <= to)
            first = std::min(first, one.x());
        for (const double line : {from, to})
            if ((one.y() < line) != (other.y() < line))
                first = std::min(
                    first,
                    one.x() + (line - one.y()) / (other.y() - one.y()) * (other.x() - one.x()));
    }
    return first;
}

/// Null: is to be looked at.
const Obstructions::Off* Obstructions::still_off(const Footprint& footprint,
                                                 const Eigen::Vector2d& tip) const {
    const auto at = std::lower_bound(
        off_.begin(), off_.end(), footprint.id, [](const Off& one, std::uint32_t id) {
            return one.id < id;
        });
    const bool is_off = at != off_.end() && at->id == footprint.id &&
                        (footprint.centre - at->place).norm() < at->clear &&
                        (tip - at->tip).norm() < at->clear;
    return is_off ? &*at : nullptr;
}

void Obstructions::count_halts(std::span<const world::VehicleState> vehicles) {
    std::vector<Halt> halts;
    for (const world::VehicleState& vehicle : vehicles) {
        if (std::hypot(vehicle.velocity().x(), vehicle.velocity().y()) > least_walk)
            continue;
        const auto before = std::find_if(
            halts_.begin(), halts_.end(), [&](const Halt& one) { return one.id == vehicle.id(); });
        halts.push_back({vehicle.id(), before == halts_.end() ? 1 : before->ticks + 1});
    }
    halts_ = std::move(halts);
}

/// [s] by now; 0 of who drives, or is no vehicle with mass.
double Obstructions::stood(std::uint32_t id) const {
    const auto at =
        std::find_if(halts_.begin(), halts_.end(), [id](const Halt& one) { return one.id == id; });
    return at == halts_.end() ? 0 : at->ticks * step_;
}

void Obstructions::add_to(world::Hasher& hasher) const {
    for (const Halt& one : halts_) {
        if (one.ticks * step_ <= halts_shortly)
            continue;
        hasher.add(one.id);
        hasher.add(one.ticks * step_ > halts_at_most);
    }
}

/// [m] that one who stops behind it leaves: room to get around what will stand there for longer;
/// behind others that SUMO has a copy of, less than SUMO keeps.
double Obstructions::gap_behind(const Footprint& footprint, bool lasts) const {
    if (lasts)
        return 5.5;
    if (!footprint.drives)
        return 4;
    return stood(footprint.id) > halts_shortly ? 4.5 : 1.5;
}

/// All that come within `reach` [m], and some beside: looked for once for all that is a step away.
const Obstructions::Around& Obstructions::lanes_around(const Eigen::Vector3d& place,
                                                       std::uint32_t id,
                                                       double reach) {
    constexpr double spare = 1.5;  // [m]
    Around& around = around_[id % around_.size()];
    if ((place - around.place).norm() + reach <= around.reach)
        return around;
    around.place = place;
    around.reach = reach + spare;
    around.lanes.clear();
    for (const std::uint32_t lane : lanes_->near(place, around.reach))
        if (world::is_for_cars(town_->lanes[lane]))
            around.lanes.push_back({lane, world::project(town_->lanes[lane], place).distance});
    return around;
}

void Obstructions::add(const Footprint& footprint) {
    const Eigen::Vector3d place(footprint.centre.x(), footprint.centre.y(), footprint.z);
    const Eigen::Vector2d way = footprint.velocity.norm() < least_walk
                                    ? Eigen::Vector2d(0, 0)
                                    : Eigen::Vector2d(footprint.velocity * foresight);
    const double radius = std::hypot(footprint.half_length, footprint.half_width);
    const bool is_small = radius < small && way.norm() < longest_step;
    const Eigen::Vector2d tip = footprint.centre + way;
    if (const Off* off = is_small ? still_off(footprint, tip) : nullptr) {
        next_off_.push_back(*off);
        return;
    }
    const double reach = radius + beside_the_lane + way.norm();
    const double step = way.norm();
    double clear = most_clear;
    const std::size_t before = all_.size();
    const Around& around = lanes_around(place, footprint.id, reach + (is_small ? most_clear : 0));
    const double moved = (place - around.place).norm() + lost;
    for (const auto& [index, distance_before] : around.lanes) {
        const world::LaneT& lane = town_->lanes[index];
        // Too far to lie on it and, of who may be left alone for a while, to say for how long.
        const double least = distance_before - moved;
        const double room = lane.width / 2 + radius + 2 * beside_the_lane;
        const double beside = lane.width / 2 + reach + radius;
        if ((!is_small || least - step - room > clear) && least > 0 &&
            least * least > beside * beside + world::level_clearance * world::level_clearance)
            continue;
        const world::LaneProjection at = world::project(lane, place);
        if (is_small) {
            // Nearer than that no lane's surface is, at the place itself and at the tip.
            clear = std::min(clear, at.distance - room);
            // Else the tip is no nearer than others are, or he is too near to be left alone anyway.
            if (clear > 0 && at.distance - step - room < clear) {
                const Eigen::Vector3d p_tip(tip.x(), tip.y(), place.z());
                clear = std::min(clear, world::project(lane, p_tip).distance - room);
            }
        }
        if (std::abs(at.t) > lane.width / 2 + reach)
            continue;
        const world::LanePoint on = world::point_at(lane, at.s);
        if (std::abs(on.position.z() - place.z()) > world::level_clearance)
            continue;
        const Eigen::Vector2d ahead = world::ahead_of(on.yaw);
        if (footprint.is_needed && footprint.direction.dot(ahead) > 0)
            continue;
        const Eigen::Vector2d offset = footprint.centre - on.position.head<2>();
        const Eigen::Vector2d left = world::turned_left(ahead);
        const double s = at.s + offset.dot(ahead);
        const double t = offset.dot(left);
        const double half = half_extent(footprint, ahead);
        const double half_across = half_extent(footprint, left);
        const double aside = way.dot(left);
        Obstruction one;
        one.right = t - half_across + std::min(aside, 0.0);
        one.left = t + half_across + std::max(aside, 0.0);
        one.begin = s - half;
        one.end = s + half;
        const Eigen::Vector2d length(footprint.direction.dot(ahead),
                                     world::cross(ahead, footprint.direction));
        const Eigen::Vector2d along = footprint.half_length * length;
        const Eigen::Vector2d across = footprint.half_width * world::turned_left(length);
        const Eigen::Vector2d middle(s, t);
        one.corners = {middle + along + across,
                       middle + along - across,
                       middle - along - across,
                       middle - along + across};
        const double edge = lane.width / 2 + beside_the_lane;
        if (one.right > edge || one.left < -edge || one.end < 0 || one.begin > lane.length)
            continue;
        one.right -= footprint.clearance;
        one.left += footprint.clearance;
        one.lane = index;
        one.speed = std::max(footprint.velocity.dot(ahead), 0.0);
        one.z = place.z();
        const bool askew = std::abs(footprint.direction.dot(ahead)) < along_its_lane;
        one.lasts = footprint.velocity.norm() < least_walk &&
                    (!footprint.drives || footprint.boxed_in || askew ||
                     stood(footprint.id) > halts_at_most);
        one.spare = one.speed == 0 && footprint.velocity.norm() < least_walk
                        ? std::max(footprint.clearance - least_clearance, 0.0)
                        : 0;
        one.gap = gap_behind(footprint, one.lasts);
        if (footprint.drives && lane.length - one.begin < turning_room && is_dead_end(lane))
            one.gap = std::max(one.gap, behind_who_turns);
        one.drives = footprint.drives;
        one.boxed_in = footprint.boxed_in;
        one.id = footprint.id;
        all_.push_back(one);
    }
    if (all_.size() > before)
        places_.push_back(footprint.centre);
    else if (is_small && clear > 0)
        next_off_.push_back({footprint.id, footprint.centre, tip, clear});
}

bool Obstructions::any_near(const Eigen::Vector2d& p_world, double reach) const {
    constexpr double rounding = 1e-6;  // [m]
    const double last = p_world.x() + reach + rounding;
    auto place = std::lower_bound(places_.begin(),
                                  places_.end(),
                                  p_world.x() - reach - rounding,
                                  [](const Eigen::Vector2d& one, double x) { return one.x() < x; });
    for (; place != places_.end() && place->x() <= last; ++place)
        if ((*place - p_world).squaredNorm() < reach * reach)
            return true;
    return false;
}

/// Who comes towards one who passes something leaves him the road that he needs until he is back
/// in his own lane; from when he begins, for who comes round a corner then.
void Obstructions::add_needed_road(std::span<const Car> cars) {
    constexpr double to_come_back = 10;  // [m] and what a longer car's tail needs
    constexpr double car_length = 5;     // [m]
    constexpr double piece = 2.5;        // [m]
    for (const Car& car : cars) {
        if (!passes_or_comes_back(car) || (car.pass && car.pass->joins) || car.lane == world::none)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[car.model];
        const world::LaneT& lane = town_->lanes[car.pass ? car.pass->lane : car.lane];
        const double front = world::project(lane, car.trail.front()).s;
        const double back = std::max(front, car.pass ? car.pass->end : 0.0) + to_come_back +
                            std::max(model.length - car_length, 0.0);
        const bool goes_aside = car.offset_order && car.offset_order->change.to != 0;
        Footprint road;
        road.half_length = piece / 2;
        road.half_width = model.width / 2;
        road.velocity.setZero();
        road.drives = true;
        road.is_needed = true;
        road.id = car.id;
        for (double s = front + piece / 2; s < std::min(back, lane.length); s += piece) {
            const world::LanePoint at = world::point_at(lane, s);
            road.direction = world::ahead_of(at.yaw);
            road.centre =
                at.position.head<2>() + (goes_aside ? car.offset_order->change.to : car.offset) *
                                            world::turned_left(road.direction);
            road.z = at.position.z();
            add(road);
        }
    }
}

void Obstructions::look(const world::TickView& last, std::span<const Car> cars) {
    count_halts(last.vehicles());
    gather_footprints(last, cars, footprints_);
    for (const Obstruction& one : all_)
        is_obstructed_[one.lane] = false;
    all_.clear();
    places_.clear();
    next_off_.clear();
    for (const Footprint& footprint : footprints_)
        add(footprint);
    add_needed_road(cars);
    std::stable_sort(next_off_.begin(), next_off_.end(), [](const Off& one, const Off& other) {
        return one.id < other.id;
    });
    std::swap(off_, next_off_);
    std::stable_sort(
        all_.begin(), all_.end(), [](const Obstruction& one, const Obstruction& other) {
            return std::tie(one.lane, one.begin) < std::tie(other.lane, other.begin);
        });
    for (const Obstruction& one : all_)
        is_obstructed_[one.lane] = true;
    std::sort(places_.begin(),
              places_.end(),
              [](const Eigen::Vector2d& one, const Eigen::Vector2d& other) {
                  return one.x() < other.x();
              });
}

std::span<const Obstruction> Obstructions::on(std::uint32_t lane) const {
    if (!is_obstructed_[lane])
        return {};
    const auto first = std::lower_bound(
        all_.begin(), all_.end(), lane, [](const Obstruction& one, std::uint32_t wanted) {
            return one.lane < wanted;
        });
    auto last = first;
    while (last != all_.end() && last->lane == lane)
        ++last;
    return {first, last};
}

}  // namespace reprise::traffic
