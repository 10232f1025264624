#include "traffic/signs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace reprise::traffic {

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
constexpr double search = 6;
constexpr double near_crossing = 5;

/// Makes the signs of one town. Roads are told by the kerb-side border of their driving lanes.
class Signs {
  public:
    explicit Signs(Land& land) : land_(land), town_(land.town) {}

    void take_known();
    void add_limits();
    void add_priorities();
    void add_crossings();

  private:
    bool knows(PropKind kind) const;
    void add(PropKind kind, std::uint32_t lane, double s, int value);
    std::vector<std::uint32_t> roads() const;
    std::set<std::string> changed_limits() const;

    Land& land_;
    world::TownT& town_;
};

/// The whole figure that is painted on the sign.
int painted_limit(double speed) {
    return static_cast<int>(std::lround(speed * 3.6 / 5)) * 5;
}

bool Signs::knows(PropKind kind) const {
    return std::any_of(land_.place.signs.begin(), land_.place.signs.end(), [&](const Prop& sign) {
        return sign.kind() == kind;
    });
}

/// The driving lane at the kerb of every road.
std::vector<std::uint32_t> Signs::roads() const {
    std::vector<std::uint32_t> found;
    for (const Roadside& roadside : land_.roadsides)
        if (roadside.kerb_side && roadside.driven != world::none)
            found.push_back(roadside.driven);
    return found;
}

void Signs::take_known() {
    for (const Prop& sign : land_.place.signs) {
        const Vector2d wish = world::in_plan(sign.position());
        const auto foot = land_.pole_place(wish, search);
        if (!foot)
            continue;
        Prop kept = sign;
        kept.mutable_position() =
            Vec3(foot->x(), foot->y(), land_.ground(*foot, sign.position().z()));
        land_.solid.add_point(*foot, 0.05);
        town_.props.push_back(kept);
    }
}

void Signs::add(PropKind kind, std::uint32_t lane, double s, int value) {
    const world::LanePoint at = world::point_at(town_.lanes[lane], s);
    const double side = town_.left_hand ? 1 : -1;
    const Vector2d left(-std::sin(at.yaw), std::cos(at.yaw));
    const Vector2d wish =
        at.position.head<2>() + left * (side * (town_.lanes[lane].width / 2 + from_kerb));
    const auto foot = land_.pole_place(wish, search);
    if (!foot)
        return;
    land_.solid.add_point(*foot, 0.05);
    town_.props.emplace_back(Vec3(foot->x(), foot->y(), land_.ground(*foot, at.position.z())),
                             at.yaw,
                             0.1,
                             plate,
                             sign_height,
                             0U,
                             static_cast<std::uint16_t>(value),
                             kind,
                             std::uint8_t{0});
}

/// Roads, by name, where drivers have not seen the limit yet: those who come straight on meet
/// another one; where nobody comes straight on, any who turn in do; and where the town begins.
std::set<std::string> Signs::changed_limits() const {
    struct Before {
        bool straight = false;
        bool straight_differs = false;
        bool differs = false;
    };

    std::map<std::string, Before> before;
    for (const LaneT& lane : town_.lanes) {
        if (lane.kind != LaneKind::driving)
            continue;
        for (const world::Link& link : lane.links) {
            if (link.turn() == world::Turn::around)
                continue;
            const LaneT& next = town_.lanes[link.to()];
            const bool differs = painted_limit(lane.speed_limit) != painted_limit(next.speed_limit);
            Before& seen = before[next.edge];
            seen.differs = seen.differs || differs;
            if (link.turn() == world::Turn::straight) {
                seen.straight = true;
                seen.straight_differs = seen.straight_differs || differs;
            }
        }
    }
    std::set<std::string> changed;
    for (const std::uint32_t road : roads()) {
        const auto seen = before.find(town_.lanes[road].edge);
        if (seen == before.end() ||
            (seen->second.straight ? seen->second.straight_differs : seen->second.differs))
            changed.insert(town_.lanes[road].edge);
    }
    return changed;
}

void Signs::add_limits() {
    if (knows(PropKind::speed_limit_sign))
        return;
    const std::set<std::string> changed = changed_limits();
    for (const std::uint32_t road : roads()) {
        const LaneT& lane = town_.lanes[road];
        if (changed.contains(lane.edge))
            add(PropKind::speed_limit_sign,
                road,
                std::min(10.0, lane.length / 2),
                painted_limit(lane.speed_limit));
    }
}

void Signs::add_priorities() {
    if (knows(PropKind::stop_sign) || knows(PropKind::yield_sign))
        return;
    for (const std::uint32_t road : roads()) {
        const LaneT& lane = town_.lanes[road];
        if (land_.right_of_way[road] == GiveWay::none)
            continue;
        add(land_.right_of_way[road] == GiveWay::stop ? PropKind::stop_sign : PropKind::yield_sign,
            road,
            std::max(lane.length - 1, lane.length / 2),
            0);
    }
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
            const world::LanePoint end = world::point_at(lane, lane.length);
            const world::LaneProjection on = world::project(crossing, end.position);
            const double across = world::point_at(crossing, on.s).yaw - end.yaw;
            if (on.distance < near_crossing && std::abs(std::cos(across)) < 0.5)
                add(PropKind::crossing_sign, road, std::max(lane.length - 4, lane.length / 2), 0);
        }
    }
}

}  // namespace

void place_signs(Land& land) {
    Signs signs(land);
    signs.take_known();
    signs.add_limits();
    signs.add_priorities();
    signs.add_crossings();
}

}  // namespace reprise::traffic
