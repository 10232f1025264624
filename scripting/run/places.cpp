#include "scripting/run/places.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "scripting/lua/text.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

using world::LaneKind;
using world::LaneT;
using world::none;
using world::TownT;

bool is_driving(const TownT& town, std::uint32_t lane) {
    return lane != none && town.lanes[lane].kind == LaneKind::driving;
}

bool is_straight(const LaneT& lane) {
    constexpr double tightest = 500;  // [m]
    for (double s = 0; s < lane.length; s += 5)
        if (world::curve_radius(lane, s) < tightest)
            return false;
    return true;
}

/// What the lanes of an edge have to do with each other.
struct EdgeFacts {
    std::int64_t driving_lanes = 0;
    bool sidewalk = false;
};

std::map<std::string, EdgeFacts> edge_facts(const TownT& town) {
    std::map<std::string, EdgeFacts> facts;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind == LaneKind::driving)
            ++facts[lane.edge].driving_lanes;
        if (lane.kind == LaneKind::sidewalk)
            facts[lane.edge].sidewalk = true;
    }
    return facts;
}

/// "its lanes are 'a_1' (driving), 'a_0' (sidewalk)", those for cars first.
std::string lanes_of(std::vector<const LaneT*> lanes) {
    std::stable_sort(lanes.begin(), lanes.end(), [](const LaneT* a, const LaneT* b) {
        return a->kind == LaneKind::driving && b->kind != LaneKind::driving;
    });
    std::string text;
    for (const LaneT* lane : lanes)
        text += fmt::format("{}'{}' ({})",
                            text.empty() ? "" : ", ",
                            lane->name,
                            lane->kind == LaneKind::driving    ? "driving"
                            : lane->kind == LaneKind::sidewalk ? "sidewalk"
                                                               : "not for cars");
    return (lanes.size() == 1 ? "its lane is " : "its lanes are ") + text;
}

std::string hint_of(const std::string& name, const std::vector<std::string>& names) {
    const std::string hint = world::did_you_mean(name, names);
    return hint.empty() ? "; reprise list lanes shows them" : hint;
}

bool fits(const std::optional<bool>& wish, bool is) {
    return !wish || *wish == is;
}

}  // namespace

std::vector<std::uint32_t> fitting_lanes(const TownT& town, const LaneWish& wish) {
    const auto facts = edge_facts(town);
    std::vector<std::uint32_t> found;
    for (std::uint32_t index = 0; index < town.lanes.size(); ++index) {
        const LaneT& lane = town.lanes[index];
        if (lane.kind != LaneKind::driving || lane.length < wish.length)
            continue;
        const EdgeFacts& edge = facts.at(lane.edge);
        const bool rightmost = !is_driving(town, lane.right);
        if (fits(wish.left, is_driving(town, lane.left)) && fits(wish.right, !rightmost) &&
            fits(wish.sidewalk, edge.sidewalk && rightmost) &&
            (!wish.lanes || *wish.lanes == edge.driving_lanes) &&
            (!wish.straight || *wish.straight == is_straight(lane)))
            found.push_back(index);
    }
    // A lane that ends in a dead end only when there is no other: who starts there has a future.
    std::vector<std::uint32_t> leading_on;
    for (const std::uint32_t index : found)
        if (!town.lanes[index].links.empty())
            leading_on.push_back(index);
    return leading_on.empty() ? found : leading_on;
}

std::string describe(const LaneWish& wish) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    const auto add_flag = [&](const char* key, const std::optional<bool>& flag) {
        if (flag)
            add(fmt::format("{} = {}", key, *flag));
    };
    if (wish.length > 0)
        add("length = " + number_text(wish.length));
    add_flag("left", wish.left);
    add_flag("right", wish.right);
    add_flag("sidewalk", wish.sidewalk);
    add_flag("straight", wish.straight);
    if (wish.lanes)
        add(fmt::format("lanes = {}", *wish.lanes));
    return text;
}

std::string not_for_cars(const TownT& town, const LaneT& lane) {
    const char* what = lane.kind == LaneKind::sidewalk       ? "is a sidewalk"
                       : lane.kind == LaneKind::crossing     ? "is a crossing"
                       : lane.kind == LaneKind::walking_area ? "is a walking area"
                                                             : "is not a lane for cars";
    const LaneT* beside = nullptr;
    const auto apart = [&](const LaneT& other) { return std::abs(other.index - lane.index); };
    for (const LaneT& other : town.lanes)
        if (other.edge == lane.edge && other.kind == LaneKind::driving &&
            (beside == nullptr || apart(other) < apart(*beside)))
            beside = &other;
    return fmt::format(
        "'{}' {}, no lane for cars{}",
        lane.name,
        lane.kind == LaneKind::other ? "is for others" : what,
        beside == nullptr ? "" : "; beside it lies '" + beside->name + "' (driving)");
}

std::uint32_t lane_named(const TownT& town, const std::string& name) {
    if (const auto lane = world::find_lane(town, name))
        return *lane;
    std::vector<std::string> names;
    std::vector<const LaneT*> of_edge;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind == LaneKind::driving)
            names.push_back(lane.name);
        if (lane.edge == name)
            of_edge.push_back(&lane);
    }
    if (!of_edge.empty())
        throw world::Error(
            fmt::format("'{}' is an edge of {}: {}", name, town.name, lanes_of(of_edge)));
    throw world::Error(fmt::format("no lane '{}' in {}{}", name, town.name, hint_of(name, names)));
}

StopLanes stop_named(const TownT& town, const std::string& name) {
    if (const auto lane = world::find_lane(town, name))
        return {*lane};
    StopLanes lanes;
    for (std::uint32_t index = 0; index < town.lanes.size(); ++index)
        if (town.lanes[index].edge == name && town.lanes[index].kind == LaneKind::driving)
            lanes.push_back(index);
    if (!lanes.empty())
        return lanes;
    std::vector<std::string> names;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind != LaneKind::driving)
            continue;
        names.push_back(lane.name);
        names.push_back(lane.edge);
    }
    throw world::Error(
        fmt::format("no lane or edge '{}' in {}{}", name, town.name, hint_of(name, names)));
}

Eigen::Vector3d across_road(const TownT& town, std::uint32_t lane, const Eigen::Vector3d& p_world) {
    const LaneT& here = town.lanes[lane];
    const world::LaneProjection from = world::project(here, p_world);
    double left = here.width / 2;
    double right = here.width / 2;
    std::uint32_t leftmost = lane;
    while (is_driving(town, town.lanes[leftmost].left)) {
        leftmost = town.lanes[leftmost].left;
        left += town.lanes[leftmost].width;
    }
    for (std::uint32_t other = town.lanes[leftmost].opposite; is_driving(town, other);
         other = town.lanes[other].right)
        left += town.lanes[other].width;
    for (std::uint32_t other = here.right; is_driving(town, other); other = town.lanes[other].right)
        right += town.lanes[other].width;

    const double middle = (left - right) / 2;
    const double offset = from.t < middle ? left + 1 : -right - 1;
    const world::LanePoint at = world::point_at(here, from.s);
    return at.position + offset * Eigen::Vector3d(-std::sin(at.yaw), std::cos(at.yaw), 0);
}

}  // namespace reprise::scripting
