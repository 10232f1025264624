#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "world/geometry2d.h"
#include "world/town.h"

/// What towns hold as points, and their distance from lanes: for checking what was placed by other
/// means.
namespace reprise::test {

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;
using world::PropKind;
using world::TownT;

/// The other route for all of these: no grid of distances, but sampled points and centre lines.
inline world::Loop box_points(
    const world::Vec3& middle, double yaw, double length, double width, double step) {
    world::Loop points;
    const Vector2d x(std::cos(yaw), std::sin(yaw));
    const Vector2d y(-x.y(), x.x());
    const int columns = std::max(1, static_cast<int>(std::ceil(length / step)));
    const int rows = std::max(1, static_cast<int>(std::ceil(width / step)));
    for (int i = 0; i <= columns; ++i)
        for (int k = 0; k <= rows; ++k)
            points.push_back(world::in_plan(middle) + x * (length * (1.0 * i / columns - 0.5)) +
                             y * (width * (1.0 * k / rows - 0.5)));
    return points;
}

inline world::Loop points_of(const world::Building& b, double step = 0.7) {
    return box_points(b.centre(), b.yaw(), b.length(), b.width(), step);
}

inline bool is_post(PropKind kind) {
    return kind <= PropKind::crossing_sign || kind == PropKind::street_light ||
           kind == PropKind::pole || kind == PropKind::bollard;
}

/// Where it stands on the ground: signs and lights reach farther above.
inline world::Loop foot_of(const world::Prop& prop) {
    const double length = is_post(prop.kind()) ? 0.1 : prop.length();
    const double width = is_post(prop.kind()) ? 0.1 : prop.width();
    return box_points(prop.position(), prop.yaw(), length, width, 0.4);
}

/// Distance of points from the centre lines of lanes, looked up by cells of 20 m.
class Lanes {
  public:
    template <typename Wanted>
    Lanes(const TownT& town, Wanted&& wanted) : town_(town) {
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
            const LaneT& lane = town.lanes[i];
            if (!wanted(lane))
                continue;
            for (double s = 0; s <= lane.length + 5; s += 5) {
                const Eigen::Vector3d p = world::point_at(lane, s).position;
                for (const double x : {-20.0, 0.0, 20.0})
                    for (const double y : {-20.0, 0.0, 20.0})
                        cells_[cell(p.head<2>() + Vector2d(x, y))].insert(i);
            }
        }
    }

    /// `margin` [m] for each lane near p: of its border, at most about 15.
    template <typename Visit>
    void for_each(const Vector2d& p, Visit&& visit) const {
        const auto found = cells_.find(cell(p));
        if (found == cells_.end())
            return;
        for (const std::uint32_t i : found->second) {
            const LaneT& lane = town_.lanes[i];
            double nearest = 1e9;
            for (std::size_t k = 1; k < lane.centre.size(); ++k) {
                const Vector2d from = world::in_plan(lane.centre[k - 1]);
                const Vector2d along = world::in_plan(lane.centre[k]) - from;
                const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
                nearest = std::min(nearest, (from + along * t - p).norm());
            }
            visit(lane, nearest);
        }
    }

    double border_distance(const Vector2d& p, double least_half = 0) const {
        double nearest = 15;
        for_each(p, [&](const LaneT& lane, double distance) {
            nearest = std::min(nearest, distance - std::max(lane.width / 2, least_half));
        });
        return nearest;
    }

  private:
    static std::pair<int, int> cell(const Vector2d& p) {
        return {static_cast<int>(std::floor(p.x() / 20)), static_cast<int>(std::floor(p.y() / 20))};
    }

    const TownT& town_;
    std::map<std::pair<int, int>, std::set<std::uint32_t>> cells_;
};

inline bool for_cars(const LaneT& lane) {
    return world::is_for_cars(lane);
}

inline bool any_road(const LaneT& lane) {
    return lane.kind != LaneKind::crossing && lane.kind != LaneKind::walking_area;
}

/// Own towns and maps, and networks of others when they are there.
inline const world::TownT* find_town(const std::string& name) {
    if (name.find('.') == std::string::npos)
        return &own_town(name).town;
    static std::map<std::string, Loaded> loaded;
    std::filesystem::path path = own_map(name);
    if (!std::filesystem::exists(path))
        path = real_map(name);
    if (!std::filesystem::exists(path))
        return nullptr;
    auto found = loaded.find(name);
    if (found == loaded.end())
        found = loaded.emplace(name, load(path)).first;
    return &found->second.town;
}

class AnyTown : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        town_ = find_town(GetParam());
        if (town_ == nullptr)
            GTEST_SKIP() << missing_map(real_map(GetParam()));
    }

    const TownT& town() const { return *town_; }

  private:
    const TownT* town_ = nullptr;
};

inline std::string short_name(const ::testing::TestParamInfo<const char*>& net) {
    const std::string name = net.param;
    return name.substr(0, name.find_first_of("/_."));
}

/// Our own towns and network, and two that nobody here made.
inline auto any_town() {
    return ::testing::Values(
        "town1", "town2", "quarter.net.xml", "Town04_sumo115.net.xml", "DRT/osm.net.xml");
}

}  // namespace reprise::test
