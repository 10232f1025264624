// What it must do: stand houses and trees beside the roads of any network, clear of what is driven
//   and walked on; the same ones for the same network and name.
// What it assumes: roads are lanes with a width; the ground beside a road is as high as the road.
// How it goes: walks along the outer border of every road and draws, at each place, a house behind
//   the border; keeps it when it is clear. Then the same with trees, and some behind the houses.
// What it keeps: the obstacles so far (Clearance), which every new house and tree joins.
#include "traffic/scenery.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "traffic/clearance.h"
#include "traffic/lanes.h"
#include "world/digest.h"
#include "world/random.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

namespace {

using world::LaneKind;
using world::LaneT;
using world::Purpose;
using world::TownT;
using world::Vec3;

constexpr double building_clearance = 3;
constexpr double tree_clearance = 1.5;
constexpr double most_buildings = 3000;
constexpr double most_trees = 4000;

/// The outer border of a road: a polyline in driving direction, and the side where it is free land.
struct Border {
    LaneT line;       ///< only its centre line and length are filled
    double side = 0;  ///< +1: free land on the left, -1: on the right
};

bool is_road(const LaneT& lane) {
    return !lane.edge.empty() && lane.edge.front() != ':' && lane.kind != LaneKind::internal &&
           lane.kind != LaneKind::crossing && lane.kind != LaneKind::walking_area;
}

Border border_of(const LaneT& lane, double side) {
    Border border;
    border.side = side;
    border.line.centre = offset_line(lane.centre, side * lane.width / 2);
    for (std::size_t i = 1; i < border.line.centre.size(); ++i) {
        const Vec3& p = border.line.centre[i - 1];
        const Vec3& q = border.line.centre[i];
        border.line.length += std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    }
    return border;
}

/// Both sides of one-way roads, the kerb side of others. In the order of the lanes.
std::vector<Border> borders(const TownT& town) {
    const double kerb_side = town.left_hand ? 1 : -1;
    std::vector<Border> found;
    for (const LaneT& lane : town.lanes) {
        if (!is_road(lane))
            continue;
        if (lane.index == 0)
            found.push_back(border_of(lane, kerb_side));
        const bool innermost = (town.left_hand ? lane.right : lane.left) == world::none;
        if (lane.kind == LaneKind::driving && innermost && lane.opposite == world::none)
            found.push_back(border_of(lane, -kerb_side));
    }
    return found;
}

/// Draws for one kind of thing, one after the other.
class Draws {
  public:
    Draws(std::uint64_t seed, Purpose purpose) : seed_(seed), purpose_(purpose) {}

    double between(double low, double high) {
        return low + (high - low) * world::draw(seed_, 0, purpose_, count_++);
    }

    std::uint32_t style() { return static_cast<std::uint32_t>(between(0, 65536)); }

  private:
    std::uint64_t seed_;
    Purpose purpose_;
    std::uint64_t count_ = 0;
};

/// A place beside the border at s, `away` metres out. Seen along the road.
struct Site {
    Eigen::Vector2d position;
    double z = 0;
    double yaw = 0;
};

Site site(const Border& border, double s, double away) {
    const world::LanePoint at = world::point_at(border.line, s);
    const Eigen::Vector2d left(-std::sin(at.yaw), std::cos(at.yaw));
    return {at.position.head<2>() + left * (border.side * away), at.position.z(), at.yaw};
}

Clearance obstacles(const TownT& town) {
    Clearance clearance(8);
    for (const LaneT& lane : town.lanes) {
        if (lane.outline.empty())
            clearance.add_line(lane.centre, lane.width / 2);
        else
            clearance.add_polygon(lane.outline);
    }
    for (const world::JunctionT& junction : town.junctions)
        clearance.add_polygon(junction.outline);
    return clearance;
}

/// Share of the candidates to keep, so that a large network ends near the cap instead of filling
/// its first roads only.
double share(const std::vector<Border>& all, double spacing, double most) {
    double length = 0;
    for (const Border& border : all)
        length += border.line.length;
    return std::min(1.0, most * spacing / std::max(length, 1.0));
}

/// A house with its near corner at s that is clear of everything; a small one near the road where a
/// large one has no room.
std::optional<Footprint> draw_footprint(const Border& border,
                                        double s,
                                        Draws& draws,
                                        const Clearance& clearance) {
    for (const bool small : {false, true}) {
        Footprint footprint;
        footprint.length = draws.between(8, small ? 11 : 25);
        footprint.width = draws.between(8, small ? 9 : 16);
        const double setback = draws.between(4, small ? 5 : 12);
        const Site at = site(border, s + footprint.length / 2, setback + footprint.width / 2);
        footprint.centre = at.position;
        footprint.yaw = at.yaw;
        if (clearance.of(footprint) >= building_clearance)
            return footprint;
    }
    return std::nullopt;
}

void place_buildings(const std::vector<Border>& all,
                     std::uint64_t seed,
                     Clearance& clearance,
                     TownT& town) {
    Draws draws(seed, Purpose::building);
    const double kept = share(all, 20, most_buildings);
    for (const Border& border : all) {
        double s = draws.between(2, 8);
        while (s < border.line.length - 2) {
            const bool wanted = draws.between(0, 1) < kept;
            const std::optional<Footprint> found =
                wanted ? draw_footprint(border, s, draws, clearance) : std::nullopt;
            if (!found) {
                s += wanted ? 3 : 18;
                continue;
            }
            clearance.add_footprint(*found);
            // Height follows the footprint: towers are not thin.
            const double height =
                std::min(draws.between(6, 30), 2.2 * std::min(found->length, found->width));
            town.buildings.emplace_back(
                Vec3(found->centre.x(), found->centre.y(), site(border, s, 0).z),
                found->yaw,
                found->length,
                found->width,
                height,
                draws.style(),
                0U);
            s += found->length + draws.between(3, 9);
        }
    }
}

/// A tree's crown stays as far from everything as its trunk allows.
void place_tree(const Site& at, Draws& draws, Clearance& clearance, TownT& town) {
    const double height = draws.between(4, 12);
    const double wanted_crown = height * draws.between(0.22, 0.35);
    const std::uint32_t style = draws.style();
    const double room = clearance.of({at.position, 0, 0, 0});
    const double crown = std::min(wanted_crown, room);
    if (room < tree_clearance || crown < 1.2)
        return;
    // Later trees may touch this crown, not stand under it.
    clearance.add_footprint({at.position, 0, crown, crown});
    town.trees.emplace_back(Vec3(at.position.x(), at.position.y(), at.z), height, crown, style, world::PlantKind::any);
}

void place_trees(const std::vector<Border>& all,
                 std::uint64_t seed,
                 Clearance& clearance,
                 TownT& town) {
    Draws draws(seed, Purpose::tree);
    const double kept = share(all, 10, most_trees);
    for (const Border& border : all) {
        // A row beside the road, and single ones further back, where houses leave room.
        for (double s = draws.between(3, 12); s < border.line.length; s += draws.between(6, 14)) {
            const bool back = draws.between(0, 1) < 0.4;
            const double away = back ? draws.between(6, 28) : draws.between(1.7, 3.5);
            if (draws.between(0, 1) < kept)
                place_tree(site(border, s, away), draws, clearance, town);
        }
    }
}

}  // namespace

void place_scenery(TownT& town) {
    const std::uint64_t seed = world::digest128(town.name).low();
    const std::vector<Border> all = borders(town);
    Clearance clearance = obstacles(town);
    place_buildings(all, seed, clearance, town);
    place_trees(all, seed, clearance, town);
}

}  // namespace reprise::traffic
