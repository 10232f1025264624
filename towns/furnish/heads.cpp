#include "towns/furnish/heads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "world/frames.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::LaneT;
using world::SignalHeadT;
using world::Vec3;

constexpr double height_at_kerb = 3.2;
constexpr double height_over_road = 5.2;  ///< lorries pass below
constexpr double walker_height = 2.3;
constexpr double pole_from_kerb = 0.6;  ///< of the middle of the pole
constexpr double longest_arm = 8;
constexpr double on_pole = 1.7;             ///< [m] beside its lane a housing needs no arm
constexpr double pole_search = 30;          ///< farther from its lane no pole makes sense
constexpr double signal_pole_radius = 0.1;  ///< [m]
constexpr double lowest = 2.1;              ///< [m] of a housing over its foot: heads pass below

/// Signals that one head shows: of one program, facing one lane.
struct Group {
    std::string program;
    std::uint32_t lane = world::none;
    std::vector<std::uint32_t> signals;
};

std::vector<Group> groups(const world::TownT& town) {
    std::map<std::pair<std::string, std::uint32_t>, std::size_t> places;
    std::vector<Group> found;
    for (std::uint32_t i = 0; i < town.signals.size(); ++i) {
        const world::SignalT& signal = town.signals[i];
        const auto [place, is_new] =
            places.try_emplace({signal.program, signal.lane}, found.size());
        if (is_new)
            found.push_back({signal.program, signal.lane, {}});
        found[place->second].signals.push_back(i);
    }
    return found;
}

/// Makes the heads of one town, approach by approach.
class Heads {
  public:
    explicit Heads(PlacementContext& context) : context_(context), town_(context.town) {}

    void take_known(std::vector<Group>& groups);
    void add(const Group& group);

  private:
    void add_over_lane(const Group& group);
    void add_at_crossing(const Group& group, bool at_end);
    Vector2d foot_beside(const LaneT& lane, double side);
    std::uint32_t outermost(std::uint32_t lane, bool inner) const;
    void stand(const Vector2d& foot);

    /// Puts the head's foot on the ground beside a road at height `z`, its housing as high over the
    /// road as it is over the foot.
    void set_up(SignalHeadT& head, const Vector2d& foot, double z) const {
        head.foot = Vec3(foot.x(), foot.y(), context_.ground(foot, z));
        const double drop = context_.drop(foot, z);
        if (drop != 0)
            head.height = std::max(lowest, head.height + drop);
    }

    PlacementContext& context_;
    world::TownT& town_;
    /// Poles that carry the heads of several lanes, by (edge, side of the road).
    std::map<std::pair<std::string, double>, Vector2d> poles_;
};

/// Heads that the place knows: they take their signals away from the groups.
void Heads::take_known(std::vector<Group>& groups) {
    for (const Place::Head& known : context_.place.heads) {
        const Vector2d foot = world::in_plan(known.foot);
        if (!context_.may_stand(foot, pole_margin))
            continue;
        std::vector<std::uint32_t> signals;
        bool for_walkers = false;
        for (Group& group : groups)
            std::erase_if(group.signals, [&](std::uint32_t i) {
                const world::SignalT& signal = town_.signals[i];
                const bool shown =
                    signal.program == known.program &&
                    std::find(known.links.begin(), known.links.end(), signal.index) !=
                        known.links.end();
                if (shown) {
                    signals.push_back(i);
                    for_walkers = signal.for_walkers;
                }
                return shown;
            });
        if (signals.empty())
            continue;
        std::sort(signals.begin(), signals.end());
        SignalHeadT head;
        head.signals = std::move(signals);
        head.yaw = known.yaw;
        head.arm = known.arm;
        head.height = known.height;
        set_up(head, foot, known.foot.z());
        head.for_walkers = for_walkers;
        stand(foot);
        town_.heads.push_back(std::move(head));
    }
}

void Heads::add(const Group& group) {
    if (group.signals.empty() || group.lane == world::none)
        return;
    if (town_.lanes[group.lane].kind == world::LaneKind::crossing) {
        add_at_crossing(group, true);
        add_at_crossing(group, false);
    } else {
        add_over_lane(group);
    }
}

/// The driving lane at the kerb of this lane's road, or at its inner side.
std::uint32_t Heads::outermost(std::uint32_t lane, bool inner) const {
    const bool to_left = inner != town_.left_hand;
    for (;;) {
        const std::uint32_t next = to_left ? town_.lanes[lane].left : town_.lanes[lane].right;
        if (next == world::none)
            return lane;
        lane = next;
    }
}

/// The place nearest to the lane's end on that side (+1: left) where a pole may stand.
Vector2d Heads::foot_beside(const LaneT& lane, double side) {
    const auto [pole, is_new] = poles_.try_emplace({lane.edge, side});
    if (!is_new)
        return pole->second;
    const world::LanePoint end = world::point_at(lane, lane.length);
    const Vector2d wish = end.position.head<2>() +
                          world::left_of(end.yaw) * (side * (lane.width / 2 + pole_from_kerb)) -
                          world::ahead_of(end.yaw) * 0.3;
    pole->second = context_.pole_place(wish, pole_search, end.position.z()).value_or(wish);
    stand(pole->second);
    return pole->second;
}

void Heads::add_over_lane(const Group& group) {
    const LaneT& lane = town_.lanes[group.lane];
    const world::LanePoint end = world::point_at(lane, lane.length);
    const Vector2d middle = end.position.head<2>();
    const double kerb_side = town_.left_hand ? 1 : -1;
    const LaneT& outer = town_.lanes[outermost(group.lane, false)];
    const LaneT& inner = town_.lanes[outermost(group.lane, true)];
    Vector2d foot = foot_beside(outer, kerb_side);
    double arm = world::left_of(end.yaw).dot(middle - foot);
    // Wide one-way roads have a second pole on their inner side.
    if (std::abs(arm) > longest_arm && inner.opposite == world::none) {
        foot = foot_beside(inner, -kerb_side);
        arm = world::left_of(end.yaw).dot(middle - foot);
    }
    SignalHeadT head;
    head.signals = group.signals;
    head.yaw = end.yaw;
    const bool needs_arm = std::abs(arm) > lane.width / 2 + on_pole;
    head.arm = needs_arm ? arm : 0;
    head.height = needs_arm ? height_over_road : height_at_kerb;
    set_up(head, foot, end.position.z());
    town_.heads.push_back(std::move(head));
}

void Heads::add_at_crossing(const Group& group, bool at_end) {
    const LaneT& crossing = town_.lanes[group.lane];
    const world::LanePoint point = world::point_at(crossing, at_end ? crossing.length : 0);
    // Walkers look at the lamp behind the road; it stands on their right.
    const double yaw = at_end ? point.yaw : point.yaw + std::numbers::pi;
    const Vector2d ahead = world::ahead_of(yaw);
    const Vector2d wish =
        point.position.head<2>() + ahead * 0.5 - world::left_of(yaw) * (crossing.width / 2 + 0.4);
    const Vector2d foot = context_.pole_place(wish, pole_search, point.position.z()).value_or(wish);
    SignalHeadT head;
    head.signals = group.signals;
    head.yaw = world::wrap_angle(yaw);
    head.height = walker_height;
    head.for_walkers = true;
    set_up(head, foot, point.position.z());
    stand(foot);
    town_.heads.push_back(std::move(head));
}

void Heads::stand(const Vector2d& foot) {
    context_.solid.add_point(foot, signal_pole_radius);
}

}  // namespace

void place_heads(PlacementContext& context) {
    std::vector<Group> wanted = groups(context.town);
    Heads heads(context);
    heads.take_known(wanted);
    for (const Group& group : wanted)
        heads.add(group);
    std::stable_sort(context.town.heads.begin(),
                     context.town.heads.end(),
                     [](const SignalHeadT& p, const SignalHeadT& q) {
                         return p.signals.front() < q.signals.front();
                     });
}

}  // namespace reprise::towns
