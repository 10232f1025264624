#include "scripting/run/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/units.h"

namespace reprise::scripting {

namespace {

constexpr double longest_body = 20;  ///< [m]
constexpr double quarter_turn = std::numbers::pi / 2;

using world::LaneT;
using world::none;
using world::TownT;

Neighbour::Kind kind_of(std::uint16_t vehicle_model) {
    return world::vehicle_models()[vehicle_model].body == world::BodyStyle::bicycle
               ? Neighbour::Kind::bicycle
               : Neighbour::Kind::vehicle;
}

/// Half of the shadow that a box throws on a line at that angle to its length.
double half_shadow(double half_length, double half_width, double angle) {
    return half_length * std::abs(std::cos(angle)) + half_width * std::abs(std::sin(angle));
}

/// A lane in plan: how far it is from being straight.
struct Chord {
    Eigen::Vector2d start{0, 0};
    Eigen::Vector2d along{1, 0};
    double deviation = 0;  ///< [m] of its points from the line
    double bend = 0;       ///< sine of the largest angle to it
};

Chord chord_of(const LaneT& lane) {
    Chord chord;
    chord.start = world::in_plan(lane.centre.front());
    chord.along = (world::in_plan(lane.centre.back()) - chord.start).normalized();
    for (std::size_t i = 1; i < lane.centre.size(); ++i) {
        const Eigen::Vector2d point = world::in_plan(lane.centre[i]);
        const Eigen::Vector2d segment = point - world::in_plan(lane.centre[i - 1]);
        const double off = std::abs(world::cross(chord.along, point - chord.start));
        chord.deviation = std::max(chord.deviation, off);
        const double sine = chord.along.dot(segment) > 0
                                ? std::abs(world::cross(chord.along, segment)) / segment.norm()
                                : 1;
        chord.bend = std::max(chord.bend, sine);
    }
    return chord;
}

/// A strip along one lane.
struct Strip {
    const LaneT* lane = nullptr;
    double start = 0;  ///< [m] from the vehicle's position to the lane's start
    double aside = 0;  ///< [m] of the strip's middle, left of the centre line
    double half_width = 0;
    world::Box box;  ///< of the lane
    Chord chord;
};

/// Along and from the vehicle's position, what of the box lies in the strip.
struct Extent {
    double middle = 0;
    double near_end = 0;
};

/// False: it lies in no part of the strip, however the lane bends. Spares the search for its place
/// along the lane, which costs ten times as much.
bool may_reach_into(const Strip& strip, const Body& other) {
    constexpr double rounding = 1e-3;  // [m]
    const Chord& chord = strip.chord;
    const Eigen::Vector2d ahead = world::ahead_of(other.yaw);
    const double half_length = (other.front + other.rear) / 2;
    const Eigen::Vector2d centre =
        other.position.head<2>() + (other.front - other.rear) / 2 * ahead;
    const double turned = std::min(std::abs(world::cross(chord.along, ahead)) + chord.bend, 1.0);
    const double across = half_length * turned + other.half_width;
    const double along = half_length + other.half_width;
    return std::abs(world::cross(chord.along, centre - chord.start)) <=
           chord.deviation + std::abs(strip.aside) + strip.half_width + across +
               along * chord.bend + rounding;
}

std::optional<Extent> extent_in(const Strip& strip, const Body& other) {
    const Eigen::Vector3d centre = other.centre();
    const world::LaneProjection at = world::project(*strip.lane, centre);
    const world::LanePoint point = world::point_at(*strip.lane, at.s);
    const Eigen::Vector3d offset = centre - point.position;
    const double overshoot = offset.head<2>().dot(world::ahead_of(point.yaw));
    const double half_length = (other.front + other.rear) / 2;
    const double angle = other.yaw - point.yaw;
    const double across = half_shadow(half_length, other.half_width, angle + quarter_turn);
    const double along = half_shadow(half_length, other.half_width, angle);
    if (std::abs(at.t - strip.aside) > strip.half_width + across ||
        std::abs(offset.z()) > world::level_clearance || std::abs(overshoot) > along)
        return std::nullopt;
    const double middle = strip.start + at.s + overshoot;
    return Extent{middle, middle - along};
}

bool is_near(const world::Box& box, const Body& other) {
    const double reach = other.front + other.rear + other.half_width;
    const double x = other.position.x();
    const double y = other.position.y();
    return x > box.low.x() - reach && x < box.high.x() + reach && y > box.low.y() - reach &&
           y < box.high.y() + reach;
}

double turn_of(const world::Link& link) {
    switch (link.turn()) {
        case world::Turn::straight:
            return 0;
        case world::Turn::partially_left:
        case world::Turn::partially_right:
            return 1;
        case world::Turn::left:
        case world::Turn::right:
            return 2;
        case world::Turn::around:
            break;
    }
    return 3;
}

/// The lane behind this one.
std::uint32_t next_lane(const TownT& town,
                        const LaneT& lane,
                        std::span<const world::Route::Piece> route) {
    const auto is_on_route = [&](std::uint32_t index) {
        return index != none &&
               std::any_of(route.begin(), route.end(), [&](const world::Route::Piece& piece) {
                   return piece.lane == index ||
                          (town.lanes[index].kind == world::LaneKind::driving &&
                           town.lanes[piece.lane].edge == town.lanes[index].edge);
               });
    };
    const world::Link* best = nullptr;
    for (const world::Link& link : lane.links) {
        if (is_on_route(link.to()) || is_on_route(link.via()))
            return link.via() != none ? link.via() : link.to();
        if (best == nullptr || turn_of(link) < turn_of(*best))
            best = &link;
    }
    return best == nullptr ? none : best->via() != none ? best->via() : best->to();
}

/// Off every lane: straight on.
std::optional<InTheWay> straight_ahead(std::span<const Neighbour> all,
                                       const Body& body,
                                       std::uint32_t id,
                                       double range) {
    std::optional<InTheWay> nearest;
    for (const Neighbour& other : all) {
        const Eigen::Vector3d offset = other.body.centre() - body.position;
        const double half_length = (other.body.front + other.body.rear) / 2;
        const double angle = other.body.yaw - body.yaw;
        const double along = offset.head<2>().dot(world::ahead_of(body.yaw));
        const double aside = offset.head<2>().dot(world::left_of(body.yaw));
        const double reach = half_shadow(half_length, other.body.half_width, angle);
        if (other.id == id || along < (body.front - body.rear) / 2 ||
            std::abs(offset.z()) > world::level_clearance ||
            std::abs(aside) >
                body.half_width +
                    half_shadow(half_length, other.body.half_width, angle + quarter_turn))
            continue;
        const double gap = std::max(0.0, along - reach - body.front);
        if (gap <= range && (!nearest || gap < nearest->gap))
            nearest = InTheWay{gap, other};
    }
    return nearest;
}

/// The lanes that it will cover.
std::vector<Strip> strips_ahead(const TownT& town,
                                const Body& body,
                                std::span<const world::Route::Piece> route,
                                double range) {
    const world::LaneProjection here = world::project(town.lanes[body.lane], body.position);
    std::vector<Strip> strips;
    double start = -here.s;
    for (std::uint32_t index = body.lane; index != none && start < range + body.front;
         index = next_lane(town, town.lanes[index], route)) {
        const LaneT& lane = town.lanes[index];
        world::Box box;
        for (const world::Vec3& point : lane.centre)
            box.take(world::in_plan(point), lane.width);
        strips.push_back({&lane, start, here.t, body.half_width, box, chord_of(lane)});
        start += lane.length;
    }
    return strips;
}

/// Of those whose position fulfils this: vehicles with mass, cars, walkers, props.
template <typename Wanted>
void add_neighbours(const world::TickView& tick, Wanted wanted, std::vector<Neighbour>& all) {
    for (const world::VehicleState& vehicle : tick.vehicles())
        if (wanted(vehicle.position()))
            all.push_back(
                {body_of(tick, vehicle), vehicle.id(), vehicle.model(), kind_of(vehicle.model())});
    for (const world::CarState& car : tick.cars())
        if (wanted(car.position()))
            all.push_back({body_of(car), car.id(), car.model(), kind_of(car.model())});
    for (const world::WalkerState& walker : tick.walkers())
        if (wanted(walker.position()))
            all.push_back({body_of(walker), walker.id(), walker.model(), Neighbour::Kind::walker});
    for (const world::PropState& prop : tick.props())
        if (wanted(prop.position()))
            all.push_back({body_of(prop), prop.id(), prop.model(), Neighbour::Kind::prop});
}

/// Who may reach into one of the strips.
std::vector<Neighbour> neighbours_near(const world::TickView& tick,
                                       const std::vector<Strip>& strips,
                                       const Body& body,
                                       double range) {
    // No way is shorter than the straight line.
    const double reach = range + body.front + longest_body;
    constexpr double beside = longest_body + 5;  // see is_near
    world::Box box;
    for (const Strip& strip : strips)
        box.take(strip.box);
    std::vector<Neighbour> within;
    add_neighbours(
        tick,
        [&](const world::Vec3& position) {
            return position.x() > box.low.x() - beside && position.x() < box.high.x() + beside &&
                   position.y() > box.low.y() - beside && position.y() < box.high.y() + beside &&
                   (world::to_eigen(position) - body.position).squaredNorm() < reach * reach;
        },
        within);
    return within;
}

}  // namespace

const char* name_of(Neighbour::Kind kind) {
    switch (kind) {
        case Neighbour::Kind::vehicle:
            return "vehicle";
        case Neighbour::Kind::bicycle:
            return "bicycle";
        case Neighbour::Kind::prop:
            return "prop";
        case Neighbour::Kind::walker:
            break;
    }
    return "walker";
}

const char* model_name(const Neighbour& neighbour) {
    if (neighbour.kind == Neighbour::Kind::prop)
        return world::prop_models()[neighbour.model].name;
    return neighbour.kind == Neighbour::Kind::walker
               ? world::walker_models()[neighbour.model].name
               : world::vehicle_models()[neighbour.model].name;
}

std::vector<Neighbour> everybody(const world::TickView& tick) {
    std::vector<Neighbour> all;
    all.reserve(count_everybody(tick));
    add_neighbours(
        tick, [](const world::Vec3&) { return true; }, all);
    return all;
}

std::size_t count_everybody(const world::TickView& tick) {
    return tick.vehicles().size() + tick.cars().size() + tick.walkers().size() +
           tick.props().size();
}

std::optional<InTheWay> find_ahead(const TownT& town,
                                   const world::TickView& tick,
                                   const Body& body,
                                   std::uint32_t id,
                                   std::span<const world::Route::Piece> route,
                                   double range) {
    if (body.lane == none)
        return straight_ahead(everybody(tick), body, id, range);
    const std::vector<Strip> strips = strips_ahead(town, body, route, range);
    const std::vector<Neighbour> within = neighbours_near(tick, strips, body, range);
    const double own_middle = (body.front - body.rear) / 2;
    const Neighbour* nearest = nullptr;
    double least = 0;
    for (const Strip& strip : strips) {
        for (const Neighbour& other : within) {
            if (other.id == id || !is_near(strip.box, other.body) ||
                !may_reach_into(strip, other.body))
                continue;
            const auto extent = extent_in(strip, other.body);
            if (!extent || extent->middle < own_middle)
                continue;
            const double gap = std::max(0.0, extent->near_end - body.front);
            if (gap <= range && (nearest == nullptr || gap < least)) {
                nearest = &other;
                least = gap;
            }
        }
        // Whoever is on the lanes behind is farther, but for those who reach onto this one.
        if (nearest != nullptr && least + body.front < strip.start + strip.lane->length - 20)
            break;
    }
    return nearest == nullptr ? std::nullopt : std::optional(InTheWay{least, *nearest});
}

}  // namespace reprise::scripting
