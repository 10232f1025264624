#include "towns/furnish/signs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;
using world::Prop;
using world::PropKind;
using world::Vec3;

constexpr double from_kerb = 0.6;
constexpr double sign_height = 2.4;  ///< of the plate's middle
constexpr double plate = 0.6;
constexpr double low_height = 1.7;  ///< the same, of one before another: drivers see both
constexpr double search = 6;
constexpr double near_crossing = 5;
constexpr double apart = 11;          ///< from 40 m away no sign hides one this far behind it
constexpr double after_start = 10;    ///< of a limit's sign
constexpr double facing_alike = 0.7;  ///< cosine of the angle between two ways

/// Makes the signs of one town. Roads are told by the kerb-side border of their driving lanes.
class Signs {
  public:
    explicit Signs(PlacementContext& context) : context_(context), town_(context.town) {}

    void take_known();
    void add_limits();
    void add_priorities();
    void add_crossings();

  private:
    bool knows(PropKind kind) const;
    bool near_another(const Vector2d& foot, double yaw, double within = apart) const;
    bool is_governed(std::uint32_t lane) const;
    Vector2d wish_at(std::uint32_t lane, double s) const;
    void add(PropKind kind, std::uint32_t lane, double s, int value, double height = sign_height);
    void add_limit(std::uint32_t lane);
    std::vector<std::uint32_t> roads() const;
    std::set<std::string> changed_limits() const;

    PlacementContext& context_;
    world::TownT& town_;
};

/// The whole figure that is painted on the sign: never above the limit, but for what is lost when
/// 30 km/h are written as 8.3 m/s.
int painted_limit(double speed) {
    constexpr double rounding = 0.2;  // [km/h]
    return static_cast<int>(std::floor(speed * 3.6 + rounding));
}

bool is_sign(PropKind kind) {
    return kind == PropKind::speed_limit_sign || kind == PropKind::stop_sign ||
           kind == PropKind::yield_sign || kind == PropKind::crossing_sign;
}

bool Signs::knows(PropKind kind) const {
    return std::any_of(context_.place.signs.begin(),
                       context_.place.signs.end(),
                       [&](const Prop& sign) { return sign.kind() == kind; });
}

/// The driving lane at the kerb of every road.
std::vector<std::uint32_t> Signs::roads() const {
    std::vector<std::uint32_t> found;
    for (const Roadside& roadside : context_.roadsides)
        if (roadside.kerb_side && roadside.driven != world::none)
            found.push_back(roadside.driven);
    return found;
}

void Signs::take_known() {
    for (const Prop& sign : context_.place.signs) {
        const Vector2d wish = world::in_plan(sign.position());
        const auto foot = context_.pole_place(wish, search, sign.position().z());
        if (!foot)
            continue;
        Prop kept = sign;
        kept.mutable_position() =
            Vec3(foot->x(), foot->y(), context_.ground(*foot, sign.position().z()));
        context_.solid.add_point(*foot, 0.05);
        town_.props.push_back(kept);
    }
}

/// Is there a sign for the same drivers so near that one would hide the other?
bool Signs::near_another(const Vector2d& foot, double yaw, double within) const {
    return std::any_of(town_.props.begin(), town_.props.end(), [&](const Prop& prop) {
        return is_sign(prop.kind()) && (world::in_plan(prop.position()) - foot).norm() < within &&
               std::cos(prop.yaw() - yaw) > facing_alike;
    });
}

/// Beside the lane.
Vector2d Signs::wish_at(std::uint32_t lane, double s) const {
    const world::LanePoint at = world::point_at(town_.lanes[lane], s);
    const double side = town_.left_hand ? 1 : -1;
    const Vector2d left = world::left_of(at.yaw);
    return at.position.head<2>() + left * (side * (town_.lanes[lane].width / 2 + from_kerb));
}

void Signs::add(PropKind kind, std::uint32_t lane, double s, int value, double height) {
    const world::LanePoint at = world::point_at(town_.lanes[lane], s);
    const auto foot = context_.pole_place(wish_at(lane, s), search, at.position.z());
    if (!foot)
        return;
    context_.solid.add_point(*foot, 0.05);
    town_.props.emplace_back(Vec3(foot->x(), foot->y(), context_.ground(*foot, at.position.z())),
                             at.yaw,
                             0.1,
                             plate,
                             height + std::max(0.0, context_.drop(*foot, at.position.z())),
                             0U,
                             static_cast<std::uint16_t>(value),
                             kind,
                             std::uint8_t{0});
}

/// Roads, by name, that are entered from a road with another limit; and where the town begins.
std::set<std::string> Signs::changed_limits() const {
    std::set<std::string> entered, changed;
    for (const LaneT& lane : town_.lanes) {
        if (lane.kind != LaneKind::driving)
            continue;
        for (const world::Link& link : lane.links) {
            if (link.turn() == world::Turn::around)
                continue;
            const LaneT& next = town_.lanes[link.to()];
            entered.insert(next.edge);
            if (painted_limit(lane.speed_limit) != painted_limit(next.speed_limit))
                changed.insert(next.edge);
        }
    }
    for (const std::uint32_t road : roads())
        if (!entered.contains(town_.lanes[road].edge))
            changed.insert(town_.lanes[road].edge);
    return changed;
}

/// Near the road's start; earlier where another sign would be too near; on short roads before it,
/// but low.
void Signs::add_limit(std::uint32_t road) {
    const LaneT& lane = town_.lanes[road];
    const double wanted = std::min(after_start, lane.length / 2);
    for (double s = wanted; s > 0; s -= 2)
        if (!near_another(wish_at(road, s), world::point_at(lane, s).yaw)) {
            add(PropKind::speed_limit_sign, road, s, painted_limit(lane.speed_limit));
            return;
        }
    add(PropKind::speed_limit_sign,
        road,
        std::min(wanted, 1.0),
        painted_limit(lane.speed_limit),
        low_height);
}

void Signs::add_limits() {
    if (knows(PropKind::speed_limit_sign))
        return;
    const std::set<std::string> changed = changed_limits();
    for (const std::uint32_t road : roads())
        if (changed.contains(town_.lanes[road].edge))
            add_limit(road);
}

void Signs::add_priorities() {
    if (knows(PropKind::stop_sign) || knows(PropKind::yield_sign))
        return;
    for (const std::uint32_t road : roads()) {
        const LaneT& lane = town_.lanes[road];
        if (context_.right_of_way[road] == GiveWay::none)
            continue;
        const double s = std::max(lane.length - 1, lane.length / 2);
        const bool crowded = near_another(wish_at(road, s), world::point_at(lane, s).yaw);
        add(context_.right_of_way[road] == GiveWay::stop ? PropKind::stop_sign
                                                         : PropKind::yield_sign,
            road,
            s,
            0,
            crowded ? low_height : sign_height);
    }
}

/// Does a light or another sign make drivers give way at the lane's end?
bool Signs::is_governed(std::uint32_t index) const {
    constexpr double reach = 15;
    const LaneT& lane = town_.lanes[index];
    const world::LanePoint end = world::point_at(lane, lane.length);
    return context_.right_of_way[index] != GiveWay::none ||
           std::any_of(lane.links.begin(),
                       lane.links.end(),
                       [](const world::Link& link) { return link.signal() != world::none; }) ||
           std::any_of(town_.props.begin(), town_.props.end(), [&](const Prop& prop) {
               return (prop.kind() == PropKind::stop_sign || prop.kind() == PropKind::yield_sign) &&
                      (world::in_plan(prop.position()) - end.position.head<2>()).norm() < reach &&
                      std::cos(prop.yaw() - end.yaw) > facing_alike;
           });
}

void Signs::add_crossings() {
    std::vector<char> lit(town_.lanes.size(), 0);
    for (const world::SignalT& signal : town_.signals)
        if (signal.lane != world::none)
            lit[signal.lane] = 1;
    std::map<std::uint32_t, std::vector<std::uint32_t>> roads_into;
    for (const std::uint32_t road : roads())
        roads_into[town_.lanes[road].junction].push_back(road);
    for (std::uint32_t i = 0; i < town_.lanes.size(); ++i) {
        const LaneT& crossing = town_.lanes[i];
        if (crossing.kind != LaneKind::crossing || crossing.junction == world::none || lit[i] != 0)
            continue;
        for (const std::uint32_t road : roads_into[crossing.junction]) {
            const LaneT& lane = town_.lanes[road];
            const double warning = std::max(lane.length - 4, lane.length / 2);
            const world::LanePoint end = world::point_at(lane, lane.length);
            const world::LaneProjection on = world::project(crossing, end.position);
            const double across = world::point_at(crossing, on.s).yaw - end.yaw;
            if (on.distance < near_crossing && std::abs(std::cos(across)) < 0.5 &&
                !is_governed(road) && !near_another(wish_at(road, warning), end.yaw, 2 * apart))
                add(PropKind::crossing_sign, road, warning, 0);
        }
    }
}

}  // namespace

void place_signs(PlacementContext& context) {
    Signs signs(context);
    signs.take_known();
    signs.add_priorities();
    signs.add_crossings();
    signs.add_limits();
}

}  // namespace reprise::towns
