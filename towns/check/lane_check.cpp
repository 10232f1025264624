// Must: find lanes that no car can follow without another one's way: roads that lie on each other,
//   lanes of two lengths, lanes that turn back.
// Assumes: nothing of who wrote the network.
// Goes: places on each centre line, every two metres; who else has a lane there is looked up by
//   place.
// Keeps: for each criterion the worst lanes.
#include "towns/check/lane_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/lane_starts.h"
#include "world/town.h"
#include "world/units.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double covered_limit = 0.5;  ///< [%]
constexpr double place_spacing = 2;    ///< [m] between places on a lane
constexpr double inside = 0.5;      ///< [m] from the other lane's edge: more than a joint's slack
constexpr double shared = 0.2;      ///< [m] between centre lines of one lane with two directions
constexpr double at_junction = 40;  ///< [m] roads at a sharp angle have parted so far behind it
constexpr double ratio_limit = 1.25;
constexpr double short_lane = 10;  ///< [m] whose ratio says little
constexpr double degrees = 180 / 3.14159265358979323846;

/// Finds the lanes for cars at a place.
class LanesByPlace {
  public:
    explicit LanesByPlace(const world::TownT& town) : town_(&town) {
        std::vector<world::BoxGrid::Entry> entries;
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
            const world::LaneT& lane = town.lanes[i];
            if (lane.kind != world::LaneKind::driving)
                continue;
            for (std::size_t k = 0; k + 1 < lane.centre.size(); ++k) {
                world::Box box;
                box.take(world::in_plan(lane.centre[k]), lane.width / 2);
                box.take(world::in_plan(lane.centre[k + 1]), lane.width / 2);
                entries.push_back({box, static_cast<std::uint32_t>(pieces_.size())});
                pieces_.push_back({i, k});
            }
        }
        by_place_ = world::BoxGrid(entries);
    }

    /// Calls `visit(lane, p)`, with the nearest place of a piece of its centre line, for all that
    /// cover a place at its height.
    template <typename Visit>
    void for_each_over(const Eigen::Vector3d& place, Visit&& visit) const {
        world::Box box;
        box.take(place.head<2>());
        for (const std::uint32_t i : by_place_.near(box)) {
            const auto& [lane, k] = pieces_[i];
            const Eigen::Vector3d from = world::to_eigen(town_->lanes[lane].centre[k]);
            const Eigen::Vector3d along = world::to_eigen(town_->lanes[lane].centre[k + 1]) - from;
            const double squared = along.head<2>().squaredNorm();
            const double share =
                squared > 0 ? (place - from).head<2>().dot(along.head<2>()) / squared : 0;
            const Eigen::Vector3d nearest = from + std::clamp(share, 0.0, 1.0) * along;
            const double aside = (nearest - place).head<2>().norm();
            if (std::abs(nearest.z() - place.z()) < world::level_spacing &&
                aside < town_->lanes[lane].width / 2 - inside)
                visit(lane, aside);
        }
    }

  private:
    struct Piece {
        std::uint32_t lane;
        std::size_t from;  ///< point of its centre line
    };

    const world::TownT* town_;
    std::vector<Piece> pieces_;
    world::BoxGrid by_place_;
};

/// [lane] The junctions that it leads out of.
std::vector<std::set<std::uint32_t>> junctions_behind(const world::TownT& town) {
    std::vector<std::set<std::uint32_t>> behind(town.lanes.size());
    for (const world::LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links)
            if (lane.junction != world::none && link.to() < behind.size())
                behind[link.to()].insert(lane.junction);
    return behind;
}

/// Do two lanes meet at a junction near this place?
bool meet_near(const world::TownT& town,
               const std::vector<std::set<std::uint32_t>>& behind,
               std::uint32_t one,
               std::uint32_t other,
               const Vector2d& place) {
    const auto ends = [&](std::uint32_t lane) {
        std::vector<std::pair<std::uint32_t, Vector2d>> found;
        const world::LaneT& it = town.lanes[lane];
        if (it.junction != world::none)
            found.emplace_back(it.junction, world::in_plan(it.centre.back()));
        for (const std::uint32_t junction : behind[lane])
            found.emplace_back(junction, world::in_plan(it.centre.front()));
        return found;
    };
    for (const auto& [junction, end] : ends(one))
        for (const auto& [met, start] : ends(other))
            if (junction == met && (end - place).norm() < at_junction)
                return true;
    return false;
}

/// What other roads cover of a lane.
struct Covered {
    std::string name;
    Vector2d place = Vector2d::Zero();  ///< the first one
    double metres = 0;
};

Covered covered_of(const world::TownT& town,
                   std::uint32_t index,
                   const LanesByPlace& by_place,
                   const std::vector<std::set<std::uint32_t>>& behind) {
    const world::LaneT& lane = town.lanes[index];
    const world::LaneStarts starts(lane);
    const int count = std::max(1, static_cast<int>(lane.length / place_spacing));
    const double piece = lane.length / count;
    Covered covered{lane.name};
    for (int k = 0; k < count; ++k) {
        const Eigen::Vector3d at = starts.at(lane, (k + 0.5) * piece).position;
        bool is_under = false;
        by_place.for_each_over(at, [&](std::uint32_t other, double aside) {
            is_under = is_under || (town.lanes[other].edge != lane.edge && aside > shared &&
                                    !meet_near(town, behind, index, other, at.head<2>()));
        });
        if (!is_under)
            continue;
        covered.place = covered.metres == 0 ? Vector2d(at.head<2>()) : covered.place;
        covered.metres += piece;
    }
    return covered;
}

Criterion check_covered(const world::TownT& town) {
    const LanesByPlace by_place(town);
    const auto behind = junctions_behind(town);
    std::vector<Covered> worst;
    double total = 0, under = 0;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::driving)
            continue;
        Covered here = covered_of(town, i, by_place, behind);
        total += town.lanes[i].length;
        under += here.metres;
        if (here.metres > 0)
            worst.push_back(std::move(here));
    }
    const double share = total > 0 ? 100 * under / total : 0;
    Criterion criterion;
    criterion.name = "lanes under other roads";
    criterion.looked_at = fmt::format("{:.0f} m of {:.0f}", under, total);
    criterion.figure = share;
    criterion.limit = covered_limit;
    criterion.unit = "%";
    std::stable_sort(worst.begin(), worst.end(), [](const Covered& one, const Covered& other) {
        return one.metres > other.metres;
    });
    for (std::size_t i = 0; i < worst.size() && !criterion.passed(); ++i)
        criterion.worst.push_back({worst[i].name, worst[i].place, 100 * worst[i].metres / total});
    return criterion;
}

Criterion check_lengths(const world::TownT& town) {
    Measured ratio("drawn over SUMO's length", ratio_limit, "times");
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving &&
            std::max(lane.length, lane.sumo_length) > short_lane)
            ratio.take(lane.name,
                       world::in_plan(lane.centre.front()),
                       std::max(lane.length / lane.sumo_length, lane.sumo_length / lane.length));
    const std::string looked_at = std::to_string(ratio.count()) + " lanes";
    return std::move(ratio).verdict(looked_at);
}

Criterion check_kinks(const world::TownT& town) {
    Measured turns("kinks in lanes", sharpest_turn * degrees, "deg");
    std::size_t lanes = 0;
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        ++lanes;
        std::vector<Vector2d> line;
        for (const world::Vec3& point : lane.centre)
            line.push_back(world::in_plan(point));
        for (std::size_t k = 1; k + 1 < line.size(); ++k)
            turns.take(lane.name, line[k], turn_at(line, k) * degrees);
    }
    const std::string looked_at =
        std::to_string(turns.count()) + " bends in " + std::to_string(lanes) + " lanes";
    return std::move(turns).verdict(looked_at);
}

}  // namespace

double turn_at(const std::vector<Vector2d>& line, std::size_t i) {
    const Vector2d before = line[i] - line[i - 1];
    const Vector2d after = line[i + 1] - line[i];
    return std::abs(std::atan2(world::cross(before, after), before.dot(after)));
}

std::vector<Criterion> check_lanes(const world::TownT& town) {
    return {check_covered(town), check_lengths(town), check_kinks(town)};
}

}  // namespace reprise::towns
