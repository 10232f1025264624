#include "scripting/words/where.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/places.h"
#include "scripting/words/handles.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/units.h"

namespace reprise::scripting {

namespace {

constexpr double farthest_beside = 50;             // [m] from a lane's centre line
constexpr double farthest_town = 1'000;            // [m] from any road
constexpr double reach_of_traffic = 4;             // [m] of its bumper from a lane's centre line
constexpr std::uint64_t road_search_cost = 2'000;  // [instructions] of a road by its place

constexpr std::array relations{"ahead_of", "behind", "beside"};

Eigen::Vector3d point_on(const world::LaneT& lane, double s, double offset) {
    const world::LanePoint at = world::point_at(lane, s);
    return at.position + offset * Eigen::Vector3d(-std::sin(at.yaw), std::cos(at.yaw), 0);
}

Place place_on(const world::TownT& town, std::uint32_t lane, double s, double offset) {
    return {lane,
            s,
            offset,
            point_on(town.lanes[lane], s, offset),
            world::point_at(town.lanes[lane], s).yaw};
}

/// [m] from the reference point to the bumpers.
double front_of(const Actor& actor) {
    if (actor.is_walker())
        return world::walker_models()[actor.model].shoulder_width / 2;
    if (actor.is_prop())
        return world::prop_models()[actor.model].length / 2;
    const world::VehicleModel& model = world::vehicle_models()[actor.model];
    return model.length - model.rear_overhang;
}

double rear_of(const Actor& actor) {
    return actor.is_walker() || actor.is_prop()
               ? front_of(actor)
               : world::vehicle_models()[actor.model].rear_overhang;
}

// --- On a lane.

Place read_lane(Run& run, lua_State* L, const Fields& fields, const Actor& actor) {
    const std::string name = *fields.text("lane");
    const std::string& who = fields.who();
    std::uint32_t index = 0;
    try {
        index = run.lane_named(L, name);
    } catch (const world::Error& error) {
        refuse(who, error.what());
    }
    const world::LaneT& lane = run.town.lanes[index];
    if (drives(actor) && !world::is_for_cars(lane))
        refuse(who, not_for_cars(run.town, lane));
    const double s = fields.number("s").value_or(0);
    if (s < 0 || s > lane.length)
        refuse(who,
               fmt::format("'s' must be in [0, {:.2f}], the length of '{}', got {}",
                           lane.length,
                           name,
                           number_text(s)));
    const double offset = fields.number("offset").value_or(0);
    if (offset != 0 && actor.driver == world::Driver::traffic)
        refuse(who,
               fmt::format("'offset' has no effect on '{}': driver = 'traffic' keeps to the middle "
                           "of its lane; leave it out, or take driver = 'autopilot'",
                           actor.name));
    // Who drives begins on its lane; who is put down may stand beside it.
    const double farthest = drives(actor) ? lane.width / 2 : farthest_beside;
    if (std::abs(offset) > farthest)
        refuse(who,
               fmt::format("'offset' must be in [-{:.2f}, {:.2f}]{}, got {}",
                           farthest,
                           farthest,
                           drives(actor) ? ", half the width of '" + name + "'" : "",
                           number_text(offset)));
    return place_on(run.town, index, s, offset);
}

// --- At a pose.

/// The nearest lane in plan, and how far its surface is.
struct NearLane {
    double outside = world::infinity;  ///< [m] from its edge; 0: on it
    double height = 0;
    std::uint32_t lane = world::none;
};

NearLane near_lane(const world::TownT& town, std::uint32_t index, double x, double y) {
    const world::LaneT& lane = town.lanes[index];
    // Twice: the nearest place of a line is looked for in space.
    Eigen::Vector3d p_world(x, y, world::point_at(lane, lane.length / 2).position.z());
    for (int i = 0; i < 2; ++i)
        p_world.z() = world::point_at(lane, world::project(lane, p_world).s).position.z();
    const world::LaneProjection at = world::project(lane, p_world);
    return {std::max(0.0, at.distance - lane.width / 2), p_world.z(), index};
}

/// Autopilots and SUMO's cars follow lanes: there must be one.
void want_lane(Run& run, const Fields& fields, const Actor& actor, const Place& place) {
    const bool traffic = actor.driver == world::Driver::traffic;
    if (!traffic && actor.driver != world::Driver::autopilot)
        return;
    const Eigen::Vector3d ahead(std::cos(place.yaw), std::sin(place.yaw), 0);
    const auto found =
        traffic
            ? run.lanes.best(place.p_world + front_of(actor) * ahead, place.yaw, reach_of_traffic)
            : run.lanes.best(place.p_world, place.yaw);
    if (found)
        return;
    std::string nearest;
    if (const auto other = run.lanes.best(place.p_world, place.yaw, farthest_beside))
        nearest = fmt::format(
            "; '{}' is {:.1f} m away", run.town.lanes[other->lane].name, other->at.distance);
    else if (const auto across = run.lanes.best(place.p_world, place.yaw + world::degree * 180))
        nearest =
            fmt::format("; '{}' there leads the other way", run.town.lanes[across->lane].name);
    refuse(fields.who(),
           fmt::format("'{}' at ({:.2f}, {:.2f}) heading {:.1f} degrees would be on no lane that "
                       "leads its way{}: driver = '{}' follows lanes",
                       actor.name,
                       place.p_world.x(),
                       place.p_world.y(),
                       place.yaw / world::degree,
                       nearest,
                       traffic ? "traffic" : "autopilot"));
}

Place read_pose(Run& run, lua_State* L, const Fields& fields, const Actor& actor) {
    const std::string& who = fields.who();
    const auto x = fields.number("x");
    const auto y = fields.number("y");
    if (!x || !y)
        refuse(who,
               fmt::format("'{}' is missing: a pose needs x, y and heading_deg", x ? "y" : "x"));
    const auto heading = fields.number("heading_deg");
    if (!heading && !actor.is_walker())
        refuse(who, "'heading_deg' is missing: a pose needs x, y and heading_deg");
    const auto height = road_height(run, L, *x, *y, fields.number("z"));
    if (!height)
        refuse(who,
               fmt::format("({}, {}) is more than 1 km from every road of {}",
                           number_text(*x),
                           number_text(*y),
                           run.town.name));
    Place place;
    place.p_world = {*x, *y, *height};
    place.yaw = world::wrap_angle(heading.value_or(0) * world::degree);
    want_lane(run, fields, actor, place);
    return place;
}

// --- By another actor.

/// The other one's body, in the tick or as it is to come.
std::optional<Body> body_to_be(Run& run, const Actor& other) {
    if (other.presence == Actor::Presence::here && other.displaced_at != run.now())
        return run.look_at(other);
    if (!other.p_world_asked)
        return std::nullopt;
    Body body;
    body.position = *other.p_world_asked;
    body.yaw = other.asked.yaw;
    body.front = front_of(other);
    body.rear = rear_of(other);
    if (const auto found = run.lanes.best(body.position, body.yaw))
        body.lane = found->lane;
    return body;
}

std::uint32_t next_of(const world::Link& link) {
    return link.via() != world::none ? link.via() : link.to();
}

/// Straight on comes first, then the lower index.
std::optional<std::uint32_t> lane_behind(const world::TownT& town, std::uint32_t lane) {
    std::optional<std::uint32_t> found;
    for (const world::Link& link : town.lanes[lane].links)
        if (next_of(link) != world::none && (!found || link.turn() == world::Turn::straight)) {
            found = next_of(link);
            if (link.turn() == world::Turn::straight)
                break;
        }
    return found;
}

std::optional<std::uint32_t> lane_before(const world::TownT& town, std::uint32_t lane) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t index = 0; index < town.lanes.size(); ++index)
        for (const world::Link& link : town.lanes[index].links) {
            if (next_of(link) != lane || !world::is_for_cars(town.lanes[index]))
                continue;
            if (link.turn() == world::Turn::straight)
                return index;
            if (!found)
                found = index;
        }
    return found;
}

/// Along the road from there, straight on over junctions.
Place along_road(Run& run,
                 lua_State* L,
                 const std::string& who,
                 const Actor& other,
                 std::uint32_t lane,
                 double s) {
    const world::TownT& town = run.town;
    const bool ahead = s > 0;
    for (int lanes = 0; s < 0 || s > town.lanes[lane].length; ++lanes) {
        run.vm.charge(L, ahead ? 50 : town.lanes.size() * 5);
        const double left = ahead ? s - town.lanes[lane].length : -s;
        const auto next = ahead ? lane_behind(town, lane) : lane_before(town, lane);
        if (!next || lanes > 1'000)
            refuse(who,
                   fmt::format("the road {} '{}' ends {:.2f} m too early, with lane '{}'",
                               ahead ? "ahead of" : "behind",
                               other.name,
                               left,
                               town.lanes[lane].name));
        s = ahead ? left : town.lanes[*next].length - left;
        lane = *next;
    }
    return place_on(town, lane, s, 0);
}

std::string relation_of(const Fields& fields) {
    std::string said;
    for (const char* relation : relations) {
        if (!fields.has(relation))
            continue;
        if (!said.empty())
            refuse(fields.who(), fmt::format("give '{}' or '{}', not both", said, relation));
        said = relation;
    }
    return said;
}

/// The lane of the other one, or the one beside it.
std::uint32_t lane_of_relation(Run& run,
                               const Fields& fields,
                               const std::string& relation,
                               const Actor& other,
                               const Body& body) {
    const std::string& who = fields.who();
    const std::vector<std::string> sides{"left", "right", "same"};
    const std::string side = fields.text("lane").value_or("same");
    if (std::find(sides.begin(), sides.end(), side) == sides.end())
        refuse(who,
               fmt::format("'lane' must be 'left', 'right' or 'same' of '{}' with '{}', got '{}'{}",
                           other.name,
                           relation,
                           side,
                           world::did_you_mean(side, sides)));
    if (body.lane == world::none)
        refuse(who, "'" + other.name + "' is on no lane");
    const world::LaneT& here = run.town.lanes[body.lane];
    if (side == "same")
        return body.lane;
    const std::uint32_t beside = side == "left" ? here.left : here.right;
    if (beside == world::none || run.town.lanes[beside].kind != world::LaneKind::driving)
        refuse(
            who,
            fmt::format("no lane to the {} of '{}', where '{}' is", side, here.name, other.name));
    return beside;
}

Place read_related(Run& run, lua_State* L, const Fields& fields, const Actor& actor) {
    const std::string& who = fields.who();
    const std::string relation = relation_of(fields);
    for (const char* key : {"s", "offset", "x", "y", "z", "heading_deg"})
        if (fields.has(key))
            refuse(who, fmt::format("'{}' has no effect with '{}'", key, relation));
    fields.push(relation.c_str());
    const Actor& other = actor_at(run, L, -1, (who + ": " + relation).c_str());
    lua_pop(L, 1);
    if (other.id == actor.id)
        refuse(who, fmt::format("'{}' = '{}' is the actor itself", relation, other.name));
    const auto body = body_to_be(run, other);
    if (!body)
        refuse(who, fmt::format("'{}' has no place yet: wait_ticks(1) first", other.name));
    const std::uint32_t lane = lane_of_relation(run, fields, relation, other, *body);
    const double s = world::project(run.town.lanes[lane], body->position).s;
    const auto gap = fields.number("gap");
    if (relation == "beside") {
        if (gap)
            refuse(who, "'gap' has no effect with 'beside': both rear axles are abreast");
        if (lane == body->lane)
            refuse(who, "'beside' needs lane = 'left' or lane = 'right'");
        return place_on(run.town, lane, s, 0);
    }
    if (!gap)
        refuse(who,
               fmt::format("'gap' is missing: metres from bumper to bumper, {} = {}, gap = 30",
                           relation,
                           other.name));
    if (*gap < 0 || *gap > 10'000)
        refuse(who, fmt::format("'gap' must be in [0, 10000] m, got {}", number_text(*gap)));
    const double way = relation == "ahead_of" ? body->front + *gap + rear_of(actor)
                                              : -(body->rear + *gap + front_of(actor));
    return along_road(run, L, who, other, lane, s + way);
}

}  // namespace

bool drives(const Actor& actor) {
    return !actor.is_walker() && !actor.is_prop() && actor.driver != world::Driver::parked;
}

void Place::say(world::CommandT& command) const {
    command.lane = lane;
    command.s = s;
    command.offset = offset;
    if (lane != world::none)
        return;
    command.has_pose = true;
    command.target = world::to_vec3(p_world);
    command.heading = yaw;
}

bool push_related(const Fields& fields) {
    for (const char* relation : relations) {
        if (!fields.mentions(relation))
            continue;
        fields.push(relation);
        return true;
    }
    return false;
}

std::optional<double> road_height(
    Run& run, lua_State* L, double x, double y, std::optional<double> near) {
    run.vm.charge(L, road_search_cost);
    for (const double reach : {0.0, 20.0, 200.0, farthest_town}) {
        NearLane best;
        for (const std::uint32_t index : run.lanes.near({x, y, near.value_or(0)}, reach)) {
            const NearLane lane = near_lane(run.town, index, x, y);
            const bool level = lane.outside == best.outside;
            const bool better =
                level && (near ? std::abs(lane.height - *near) < std::abs(best.height - *near)
                               : lane.height > best.height);
            if (lane.outside < best.outside || better)
                best = lane;
        }
        if (best.lane != world::none && best.outside <= reach)
            return best.height;
    }
    return std::nullopt;
}

std::optional<Place> read_place(Run& run, lua_State* L, const Fields& fields, const Actor& actor) {
    if (!relation_of(fields).empty())
        return read_related(run, L, fields, actor);
    if (fields.has("gap"))
        refuse(fields.who(), "'gap' needs 'ahead_of' or 'behind'");
    const bool pose =
        fields.has("x") || fields.has("y") || fields.has("z") || fields.has("heading_deg");
    if (fields.has("lane")) {
        if (pose)
            refuse(fields.who(), "give a lane or a pose (x, y, heading_deg), not both");
        return read_lane(run, L, fields, actor);
    }
    if (fields.has("s") || fields.has("offset"))
        refuse(fields.who(), "'s' and 'offset' need a 'lane'");
    if (pose)
        return read_pose(run, L, fields, actor);
    return std::nullopt;
}

Footprint footprint_at(const Actor& actor, const Place& place) {
    if (actor.is_walker()) {
        const double half = world::walker_models()[actor.model].shoulder_width / 2;
        return {place.p_world, place.yaw, half, half};
    }
    if (actor.is_prop()) {
        const world::PropModel& prop = world::prop_models()[actor.model];
        return {place.p_world, place.yaw, prop.length / 2, prop.width / 2};
    }
    const world::VehicleModel& model = world::vehicle_models()[actor.model];
    const double middle = model.length / 2 - model.rear_overhang;
    return {place.p_world + middle * Eigen::Vector3d(std::cos(place.yaw), std::sin(place.yaw), 0),
            place.yaw,
            model.length / 2,
            model.width / 2};
}

void want_free_place(Run& run, lua_State* L, const std::string& who, const Actor& actor) {
    run.vm.charge(L, run.actors.next_id());
    const std::size_t most = actor.is_prop() ? most_props_in_a_place : most_in_a_place;
    if (!actor.is_walker() &&
        run.actors.count_near(*actor.p_world_asked, place_radius, actor.is_prop()) >= most)
        refuse(who,
               fmt::format("more than {} {} within {:.0f} m: they would stand in each other",
                           most,
                           actor.is_prop() ? "props" : "vehicles",
                           place_radius));
    const auto [other, depth] = run.actors.obstructor(run.last, actor.asked, actor.id);
    if (other != nullptr)
        refuse(who,
               fmt::format("'{}' would stand in '{}', which line {} spawned: they reach {:.2f} m "
                           "into each other; move one of them by 's' or 'offset'",
                           actor.name,
                           other->name,
                           other->line,
                           depth));
}

}  // namespace reprise::scripting
