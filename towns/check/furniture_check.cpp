// Must: find every signal without a lamp, every spawn point that is none, and everything that
//   stands in the way.
// Assumes: nothing; indices out of range are faults like others.
// Goes: all that stands is a footprint in plan with a height; lanes look up what is near.
// Keeps: for each criterion the faults, in the order of the town.
#include "towns/check/furniture_check.h"

#include <cmath>
#include <map>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

constexpr double for_cars = 0.9;      ///< [m] kept clear on both sides of a centre line
constexpr double headroom = 4.0;      ///< [m] over a lane; what begins higher up is no obstacle
constexpr double spawn_reach = 0.05;  ///< [m] of a spawn point from its place on the lane
constexpr double trunk_radius = 0.3;  ///< [m]

using Place = Criterion::Place;

/// Something that stands in town.
struct Footprint {
    std::string name;
    world::Loop loop;   ///< one point: round
    double radius = 0;  ///< [m] around the loop
    double low = 0;     ///< [m] world
    double high = 0;
};

world::Loop rectangle(const world::Vec3& centre, double yaw, double length, double width) {
    const Eigen::Vector2d along = world::ahead_of(yaw) * length / 2;
    const Eigen::Vector2d across = world::left_of(yaw) * width / 2;
    const Eigen::Vector2d middle = world::in_plan(centre);
    return {middle - along - across,
            middle + along - across,
            middle + along + across,
            middle - along + across};
}

/// Do people walk and drive around its pole only?
bool is_on_a_pole(world::PropKind kind) {
    switch (kind) {
        case world::PropKind::speed_limit_sign:
        case world::PropKind::stop_sign:
        case world::PropKind::yield_sign:
        case world::PropKind::crossing_sign:
        case world::PropKind::street_light:
        case world::PropKind::pole:
            return true;
        default:
            return false;
    }
}

void add_buildings(const world::TownT& town, std::vector<Footprint>& standing) {
    for (std::size_t i = 0; i < town.buildings.size(); ++i) {
        const world::Building& b = town.buildings[i];
        const double low = b.centre().z();
        standing.push_back({numbered("building", i),
                            rectangle(b.centre(), b.yaw(), b.length(), b.width()),
                            0,
                            low,
                            low + b.height()});
    }
    for (std::size_t i = 0; i < town.drawn_buildings.size(); ++i) {
        const world::DrawnBuildingT& b = town.drawn_buildings[i];
        const double low = b.outline.empty() ? 0 : b.outline[0].z();
        standing.push_back(
            {numbered("drawn building", i), world::in_plan(b.outline), 0, low, low + b.height});
    }
}

void add_furniture(const world::TownT& town, std::vector<Footprint>& standing) {
    const auto add_round =
        [&](std::string name, const world::Vec3& foot, double radius, double height) {
            standing.push_back(
                {std::move(name), {world::in_plan(foot)}, radius, foot.z(), foot.z() + height});
        };
    for (std::size_t i = 0; i < town.trees.size(); ++i)
        add_round(
            numbered("plant", i), town.trees[i].position(), trunk_radius, town.trees[i].height());
    for (std::size_t i = 0; i < town.heads.size(); ++i)
        add_round(
            numbered("signal head", i), town.heads[i].foot, pole_radius, town.heads[i].height);
    for (std::size_t i = 0; i < town.props.size(); ++i) {
        const world::Prop& prop = town.props[i];
        const std::string name = numbered(EnumNamePropKind(prop.kind()), i);
        const double low = prop.position().z();
        if (is_on_a_pole(prop.kind()))
            add_round(name, prop.position(), pole_radius, prop.height());
        else
            standing.push_back({name,
                                rectangle(prop.position(), prop.yaw(), prop.length(), prop.width()),
                                0,
                                low,
                                low + prop.height()});
    }
}

/// Everything that stands, by place.
class Standing {
  public:
    explicit Standing(const world::TownT& town) {
        add_buildings(town, things_);
        add_furniture(town, things_);
        std::vector<world::BoxGrid::Entry> entries;
        for (std::uint32_t i = 0; i < things_.size(); ++i)
            if (!things_[i].loop.empty())
                entries.push_back({world::box_around(things_[i].loop, things_[i].radius), i});
        by_place_ = world::BoxGrid(entries);
    }

    std::size_t size() const { return things_.size(); }

    /// Calls `visit(thing)` for all that stands nearer than `clear` to a segment of a way.
    template <typename Visit>
    void for_each_on(const world::Vec3& from,
                     const world::Vec3& to,
                     double clear,
                     Visit&& visit) const {
        world::Box box;
        box.take(world::in_plan(from), clear);
        box.take(world::in_plan(to), clear);
        const double road = std::min(from.z(), to.z());
        for (const std::uint32_t i : by_place_.near(box)) {
            const Footprint& thing = things_[i];
            const bool is_on_level = thing.low < road + headroom && thing.high > road;
            if (is_on_level &&
                world::distance_to(thing.loop, world::in_plan(from), world::in_plan(to)) -
                        thing.radius <
                    clear)
                visit(thing);
        }
    }

  private:
    std::vector<Footprint> things_;
    world::BoxGrid by_place_;
};

Criterion check_ways(const world::TownT& town, const Standing& standing) {
    std::map<std::string, Place> faults;
    for (const world::LaneT& lane : town.lanes) {
        const bool is_sidewalk =
            lane.kind == world::LaneKind::sidewalk || lane.kind == world::LaneKind::crossing;
        if (!world::is_for_cars(lane) && !is_sidewalk)
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i)
            standing.for_each_on(lane.centre[i],
                                 lane.centre[i + 1],
                                 is_sidewalk ? walker_clearance : for_cars,
                                 [&](const Footprint& thing) {
                                     const std::string name = thing.name + " on " + lane.name;
                                     faults.try_emplace(name, Place{name, thing.loop[0], 1});
                                 });
    }
    std::vector<Place> listed;
    for (const auto& [name, place] : faults)
        listed.push_back(place);
    return none_of(
        "things in the way", std::move(listed), std::to_string(standing.size()) + " things");
}

/// A group is what one lane (or crossing) sees of one program.
Criterion check_heads(const world::TownT& town) {
    std::vector<bool> is_shown(town.signals.size(), false);
    for (const world::SignalHeadT& head : town.heads)
        for (const std::uint32_t signal : head.signals)
            if (signal < is_shown.size())
                is_shown[signal] = true;
    std::map<std::string, Place> dark;
    std::map<std::string, int> groups;
    for (std::size_t i = 0; i < town.signals.size(); ++i) {
        const world::SignalT& signal = town.signals[i];
        std::string name = signal.program + " for ";
        if (signal.lane < town.lanes.size())
            name += town.lanes[signal.lane].name;
        else
            name += "walkers, link " + std::to_string(signal.index);
        ++groups[name];
        if (!is_shown[i])
            dark.try_emplace(name, Place{name, world::in_plan(signal.position), 1});
    }
    std::vector<Place> listed;
    for (const auto& [name, place] : dark)
        listed.push_back(place);
    return none_of(
        "signals without a head", std::move(listed), std::to_string(groups.size()) + " groups");
}

/// What is wrong with a spawn point; "": nothing.
std::string fault_of(const world::TownT& town, const world::SpawnPoint& point) {
    if (point.lane() >= town.lanes.size())
        return "no such lane";
    const world::LaneT& lane = town.lanes[point.lane()];
    if (lane.kind != (point.for_walkers() ? world::LaneKind::sidewalk : world::LaneKind::driving))
        return "is not for " + std::string(point.for_walkers() ? "walkers" : "cars");
    if (!(point.s() >= 0 && point.s() <= lane.length))
        return "beyond the lane's end";
    // A walker's stands on the sidewalk, a kerb above the lane's line.
    const Eigen::Vector3d off =
        world::to_eigen(point.position()) - world::point_at(lane, point.s()).position;
    const double aside = off.head<2>().norm();
    const double reach = point.for_walkers() ? lane.width / 2 : spawn_reach;
    return aside <= reach && std::abs(off.z()) <= 0.25 ? "" : "not on its lane";
}

Criterion check_spawn_points(const world::TownT& town, const Standing& standing) {
    std::vector<Place> faults;
    for (std::size_t i = 0; i < town.spawn_points.size(); ++i) {
        const world::SpawnPoint& point = town.spawn_points[i];
        std::string fault = fault_of(town, point);
        standing.for_each_on(point.position(),
                             point.position(),
                             point.for_walkers() ? walker_clearance : for_cars,
                             [&](const Footprint& thing) { fault = thing.name + " stands there"; });
        if (!fault.empty())
            faults.push_back(
                {numbered("spawn point", i) + ": " + fault, world::in_plan(point.position()), 1});
    }
    if (town.spawn_points.empty())
        faults.push_back({"there is no spawn point", world::in_plan(town.low), 1});
    return none_of("bad spawn points",
                   std::move(faults),
                   std::to_string(town.spawn_points.size()) + " points");
}

}  // namespace

std::vector<Criterion> check_furniture(const world::TownT& town) {
    const Standing standing(town);
    return {check_heads(town), check_spawn_points(town, standing), check_ways(town, standing)};
}

}  // namespace reprise::towns
