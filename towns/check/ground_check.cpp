// Must: find every place where a car would fall, jump or hit a kerb, by measuring, not by trusting
//   how the mesh was made.
// Assumes: the mesh is the town's own.
// Goes: plumb lines along every centre line and beside it; distances of centre line segments to
//   raised triangles in plan.
// Keeps: for each criterion the worst places, by lane.
#include "towns/check/ground_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include "ground/mesh/ground_probe.h"
#include "ground/mesh/ribbon.h"
#include "towns/check/island_check.h"
#include "world/frames.h"
#include "world/lane_starts.h"
#include "world/town.h"
#include "world/units.h"

namespace reprise::towns {

namespace {

constexpr double step = 0.5;           ///< [m] between plumb lines along a lane
constexpr double track = 0.8;          ///< [m] from the centre line to the wheels
constexpr double ground_limit = 0.05;  ///< [m]
constexpr double bank_limit = 0.12;
constexpr double kerb_limit = 0.9;  ///< [m]
constexpr double gap_limit = 0.05;  ///< [m]
constexpr double above = 1.0;       ///< [m] plumb lines start: under the next bridge, over kerbs
constexpr double no_road = 1.0;     ///< [m] said of a place over terrain or nothing
constexpr double most_holes_looked_for = 400000;

std::string places_on_lanes(std::size_t places, std::size_t lanes) {
    return std::to_string(places) + " places on " + std::to_string(lanes) + " lanes";
}

/// Plumb lines under one lane.
struct LaneLevels {
    Measured centre{"ground under lanes", ground_limit, "m"};
    Measured wheels{"ground under wheels", ground_limit, "m"};
    Measured bank{"bank of the road", bank_limit, "m/m"};
    std::size_t lanes = 0;
};

/// Distance of the road below `p` from `p`, either way.
double off_level(const ground::GroundProbe& probe, const Eigen::Vector3d& p) {
    const auto hit = probe.below(p + above * Eigen::Vector3d::UnitZ());
    return hit && hit->surface != ground::Surface::terrain ? hit->z - p.z() : -no_road;
}

/// Lanes for cars that join it, at either end. [lane]
std::vector<std::vector<std::uint32_t>> joined_lanes(const world::TownT& town) {
    std::vector<std::vector<std::uint32_t>> joined(town.lanes.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        for (const world::Link& link : town.lanes[i].links) {
            const std::uint32_t next = link.via() != world::none ? link.via() : link.to();
            if (!world::is_for_cars(town.lanes[i]) || !world::is_for_cars(town.lanes[next]))
                continue;
            joined[i].push_back(next);
            joined[next].push_back(i);
        }
    return joined;
}

/// As off_level, beside the centre line. Where lanes meet at an angle the inner wheel is on the
/// other lane already, which may be a slope: the nearer height counts there.
double off_wheel(const world::TownT& town,
                 const ground::GroundProbe& probe,
                 const Eigen::Vector3d& wheel,
                 std::span<const std::uint32_t> joined) {
    double best = off_level(probe, wheel);
    for (const std::uint32_t other : joined) {
        const world::LaneProjection on = world::project(town.lanes[other], wheel);
        const double z = world::point_at(town.lanes[other], on.s).position.z();
        const double off = off_level(probe, {wheel.x(), wheel.y(), z});
        if (std::abs(z - wheel.z()) < above && std::abs(off) < std::abs(best))
            best = off;
    }
    return best;
}

/// What a wheel feels of being `off` its lane's level: the greatest step of the ground on the way
/// from below the middle. Who crosses a slope is banked, and how much he may be is a criterion of
/// its own; what is steeper than that is a step.
double felt(const ground::GroundProbe& probe,
            const Eigen::Vector3d& middle,
            const Eigen::Vector3d& wheel,
            double off) {
    if (std::abs(off) <= ground_limit)
        return std::abs(off);
    constexpr int count = 4;  // about a tyre's width each
    const double start = off_level(probe, middle);
    double last = start;
    double greatest = 0;
    for (int i = 1; i <= count; ++i) {
        const double next = off_level(probe, middle + (wheel - middle) * i / count);
        greatest = std::max(greatest, std::abs(next - last));
        last = next;
    }
    if (std::abs(last - start) > bank_limit * track)
        return std::abs(off);
    return std::min(std::abs(off), greatest);
}

void measure_lane(const world::TownT& town,
                  const world::LaneT& lane,
                  std::span<const std::uint32_t> joined,
                  const ground::GroundProbe& probe,
                  LaneLevels& levels) {
    ++levels.lanes;
    const world::LaneStarts starts(lane);
    const int count = 1 + static_cast<int>(lane.length / step);
    for (int i = 0; i <= count; ++i) {
        // The very ends belong to the next lane as much as to this one.
        const double s =
            std::clamp(i * lane.length / count, 0.01, std::max(0.01, lane.length - 0.01));
        const world::LanePoint at = starts.at(lane, s);
        const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
        const double middle = off_level(probe, at.position);
        const bool at_end = s < track || s > lane.length - track;
        const auto beside = at_end ? joined : std::span<const std::uint32_t>();
        const Eigen::Vector3d to_left = at.position + track * left;
        const Eigen::Vector3d to_right = at.position - track * left;
        const double left_wheel = off_wheel(town, probe, to_left, beside);
        const double right_wheel = off_wheel(town, probe, to_right, beside);
        const Eigen::Vector2d place = at.position.head<2>();
        levels.centre.take(lane.name, place, std::abs(middle));
        levels.wheels.take(lane.name,
                           place,
                           std::max(felt(probe, at.position, to_left, left_wheel),
                                    felt(probe, at.position, to_right, right_wheel)));
        levels.bank.take(lane.name, place, std::abs(left_wheel - right_wheel) / (2 * track));
    }
}

void check_levels(const world::TownT& town,
                  const ground::GroundProbe& probe,
                  std::vector<Criterion>& criteria) {
    LaneLevels levels;
    const auto joined = joined_lanes(town);
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (world::is_for_cars(town.lanes[i]))
            measure_lane(town, town.lanes[i], joined[i], probe, levels);
    const std::string looked_at = places_on_lanes(levels.centre.count(), levels.lanes);
    criteria.push_back(std::move(levels.centre).verdict(looked_at));
    criteria.push_back(std::move(levels.wheels).verdict(looked_at));
    criteria.push_back(std::move(levels.bank).verdict(looked_at));
}

/// Height of a triangle near a place: its plane's, within its own heights.
double height_near(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector2d& p) {
    constexpr double least_area = 1e-3;  // [m2] from above; kerb faces have none
    const auto [low, high] = std::minmax({triangle[0].z(), triangle[1].z(), triangle[2].z()});
    const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (normal.z() / 2 < least_area)
        return (low + high) / 2;
    const Eigen::Vector2d slope = -normal.head<2>() / normal.z();
    return std::clamp(triangle[0].z() + slope.dot(p - triangle[0].head<2>()), low, high);
}

/// The raised triangle nearest to a short segment of a centre line; `reach` when none is nearer.
double clear_width(const ground::GroundMesh& ground,
                   const ground::GroundProbe& probe,
                   const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to,
                   double reach) {
    world::Box box;
    box.take(from.head<2>(), reach);
    box.take(to.head<2>(), reach);
    const Eigen::Vector3d middle = (from + to) / 2;
    double least = reach;
    for (const std::uint32_t i : probe.near(box)) {
        if (ground.surfaces[i] != ground::Surface::kerb &&
            ground.surfaces[i] != ground::Surface::sidewalk)
            continue;
        const auto& [first, second, third] = ground.triangles[i];
        const std::array<Eigen::Vector3d, 3> triangle = {
            ground.vertices[first], ground.vertices[second], ground.vertices[third]};
        if (std::abs(height_near(triangle, middle.head<2>()) - middle.z()) >= world::level_spacing)
            continue;
        world::Loop outline;
        for (const Eigen::Vector3d& p : triangle)
            outline.push_back(p.head<2>());
        least = std::min(least, world::distance_to(outline, from.head<2>(), to.head<2>()));
    }
    return least;
}

Criterion check_kerbs(const world::TownT& town,
                      const ground::GroundMesh& ground,
                      const ground::GroundProbe& probe) {
    constexpr double reach = 3.0;    // [m]
    constexpr double longest = 4.0;  // [m] piece of a centre line
    Measured clear("kerbs clear of lanes", kerb_limit, "m", true);
    std::size_t lanes = 0;
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        ++lanes;
        // On a slope a long piece has no one height to compare.
        const auto line = ground::with_more_points(ground::clean_line(lane.centre), longest);
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            clear.take(lane.name,
                       ((line[i] + line[i + 1]) / 2).head<2>(),
                       clear_width(ground, probe, line[i], line[i + 1], reach));
    }
    return std::move(clear).verdict(std::to_string(lanes) + " lanes");
}

/// Is there something under every place of the town's box?
Criterion check_holes(const world::TownT& town, const ground::GroundProbe& probe) {
    const Eigen::Vector2d low = world::in_plan(town.low);
    const Eigen::Vector2d size = world::in_plan(town.high) - low;
    const double spacing = std::max(1.0, std::sqrt(size.prod() / most_holes_looked_for));
    std::vector<Criterion::Place> holes;
    std::size_t looked = 0;
    for (double x = 0; x <= size.x(); x += spacing)
        for (double y = 0; y <= size.y(); y += spacing) {
            const Eigen::Vector2d p = low + Eigen::Vector2d(x, y);
            ++looked;
            if (!probe.below({p.x(), p.y(), std::numeric_limits<double>::max()}))
                holes.push_back({"ground", p, 1});
        }
    return none_of("holes in the ground", std::move(holes), std::to_string(looked) + " places");
}

/// From lane to lane along every link, through the lanes inside the junction.
Criterion check_joints(const world::TownT& town) {
    Measured gaps("lanes join", gap_limit, "m");
    const auto take = [&](const world::LaneT& lane, const world::LaneT& next) {
        const Eigen::Vector3d end = world::to_eigen(lane.centre.back());
        gaps.take(lane.name + " -> " + next.name,
                  end.head<2>(),
                  (world::to_eigen(next.centre.front()) - end).norm());
    };
    for (const world::LaneT& lane : town.lanes)
        if (world::is_for_cars(lane))
            for (const world::Link& link : lane.links) {
                const std::uint32_t next = link.via() != world::none ? link.via() : link.to();
                if (world::is_for_cars(town.lanes[next]))
                    take(lane, town.lanes[next]);
            }
    const std::string looked_at = std::to_string(gaps.count()) + " joints";
    return std::move(gaps).verdict(looked_at);
}

}  // namespace

std::vector<Criterion> check_ground(const world::TownT& town, const ground::GroundMesh& ground) {
    const ground::GroundProbe probe(ground);
    std::vector<Criterion> criteria;
    check_levels(town, probe, criteria);
    criteria.push_back(check_kerbs(town, ground, probe));
    criteria.push_back(check_islands(ground, probe));
    criteria.push_back(check_holes(town, probe));
    criteria.push_back(check_joints(town));
    return criteria;
}

world::Digest128 digest_of(const ground::GroundMesh& mesh) {
    world::Hasher hasher;
    for (const Eigen::Vector3d& vertex : mesh.vertices)
        hasher.add_bytes(vertex.data(), 3 * sizeof(double));
    hasher.add(std::span(mesh.triangles));
    hasher.add(std::span(mesh.surfaces));
    return hasher.digest128();
}

}  // namespace reprise::towns
