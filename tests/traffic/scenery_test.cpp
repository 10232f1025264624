#include "traffic/scenery.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/traffic/stage.h"
#include "traffic/clearance.h"
#include "world/building_models.h"
#include "world/plan.h"

namespace reprise::traffic {
namespace {

namespace fs = std::filesystem;

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;
using world::Loop;
using world::PropKind;
using world::TownT;

/// The other route for all of these: no grid of distances, but sampled points and centre lines.
Loop box_points(const world::Vec3& middle, double yaw, double length, double width, double step) {
    Loop points;
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

Loop points_of(const world::Building& b, double step = 0.7) {
    return box_points(b.centre(), b.yaw(), b.length(), b.width(), step);
}

bool is_post(PropKind kind) {
    return kind <= PropKind::crossing_sign || kind == PropKind::street_light ||
           kind == PropKind::pole;
}

/// Where it stands on the ground: signs and lights reach farther above.
Loop foot_of(const world::Prop& prop) {
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

bool for_cars(const LaneT& lane) {
    return world::is_for_cars(lane);
}

bool any_road(const LaneT& lane) {
    return lane.kind != LaneKind::crossing && lane.kind != LaneKind::walking_area;
}

/// Own towns, and networks of others when they are there.
const TownT* find_town(const std::string& name) {
    if (name.find('.') == std::string::npos)
        return &test::own_town(name).town;
    static std::map<std::string, test::Loaded> loaded;
    fs::path path = fs::path(REPRISE_SOURCE_DIR) / "../shared/maps" / name;
    if (!fs::exists(path))
        path = fs::path("/usr/share/sumo/tools/game") / name;
    if (!fs::exists(path))
        return nullptr;
    auto found = loaded.find(name);
    if (found == loaded.end())
        found = loaded.emplace(name, test::load(path)).first;
    return &found->second.town;
}

class AnyScenery : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        town_ = find_town(GetParam());
        if (town_ == nullptr)
            GTEST_SKIP() << "skipped: no map " << GetParam();
    }

    const TownT& town() const { return *town_; }

  private:
    const TownT* town_ = nullptr;
};

std::string short_name(const ::testing::TestParamInfo<const char*>& net) {
    const std::string name = net.param;
    return name.substr(0, name.find_first_of("/_"));
}

INSTANTIATE_TEST_SUITE_P(
    Towns,
    AnyScenery,
    ::testing::Values("town1", "town2", "Town04_sumo115.net.xml", "DRT/osm.net.xml"),
    short_name);

TEST_P(AnyScenery, EverySignalHasItsHeads) {
    std::vector<int> heads(town().signals.size(), 0);
    for (const world::SignalHeadT& head : town().heads)
        for (const std::uint32_t signal : head.signals) {
            ASSERT_LT(signal, heads.size());
            ++heads[signal];
            EXPECT_EQ(head.for_walkers, town().signals[signal].for_walkers);
            EXPECT_EQ(town().signals[signal].lane, town().signals[head.signals[0]].lane);
        }
    for (std::size_t i = 0; i < heads.size(); ++i)
        EXPECT_EQ(heads[i], town().signals[i].for_walkers ? 2 : 1) << i;
}

TEST_P(AnyScenery, HousingsHangBesideOrOverTheirLanes) {
    for (const world::SignalHeadT& head : town().heads) {
        const LaneT& lane = town().lanes[town().signals[head.signals[0]].lane];
        if (head.for_walkers || head.arm == 0)
            continue;
        const Vector2d left(-std::sin(head.yaw), std::cos(head.yaw));
        const Vector2d housing = world::in_plan(head.foot) + left * head.arm;
        const world::Vec3& end = lane.centre.back();
        EXPECT_LT(std::abs(left.dot(housing - world::in_plan(end))), 0.1) << lane.name;
        EXPECT_GE(head.height, 4.5) << "lorries pass below";
    }
}

TEST_P(AnyScenery, NothingStandsOnALaneOrTurningPath) {
    const Lanes lanes(town(), for_cars);
    for (const world::Prop& prop : town().props) {
        const double margin = is_post(prop.kind()) ? 0.2 : 0.49;
        for (const Vector2d& p : foot_of(prop)) {
            // Cars parked on a wide lane leave a path beside them.
            if (prop.kind() == PropKind::parked_vehicle)
                lanes.for_each(p, [&](const LaneT& lane, double distance) {
                    EXPECT_GE(distance, 1.25) << lane.name;
                });
            else
                EXPECT_GE(lanes.border_distance(p, 1.25), margin - 1e-3)
                    << static_cast<int>(prop.kind()) << " at " << p.transpose();
        }
    }
    for (const world::SignalHeadT& head : town().heads)
        EXPECT_GE(lanes.border_distance(world::in_plan(head.foot), 1.25), 0.29);
    for (const world::Tree& tree : town().trees)
        EXPECT_GE(lanes.border_distance(world::in_plan(tree.position()), 1.25), 0.5);
}

TEST_P(AnyScenery, CrownsLeaveRoomForLorries) {
    const Lanes lanes(town(), for_cars);
    for (const world::Tree& tree : town().trees) {
        const double over =
            tree.crown_radius() - lanes.border_distance(world::in_plan(tree.position()));
        if (over > 0.01) {
            EXPECT_GE(tree.height() - 2 * tree.crown_radius(), 4.5 - 1e-6);
        }
    }
}

TEST_P(AnyScenery, SidewalksStayWideEnough) {
    struct Blocked {
        Loop loop;
        Vector2d middle;
        double radius;
    };

    std::map<std::pair<int, int>, std::vector<Blocked>> cells;
    const auto cell = [](const Vector2d& p) {
        return std::pair{static_cast<int>(std::floor(p.x() / 10)),
                         static_cast<int>(std::floor(p.y() / 10))};
    };
    const auto block = [&](const Vector2d& middle, double yaw, double length, double width) {
        const Blocked one{
            corners({middle, yaw, length, width}), middle, std::hypot(length, width) / 2 + 2};
        std::set<std::pair<int, int>> touched;
        for (const double x : {-1.0, 0.0, 1.0})
            for (const double y : {-1.0, 0.0, 1.0})
                touched.insert(cell(middle + Vector2d(x, y) * (one.radius + 8)));
        for (const auto& at : touched)
            cells[at].push_back(one);
    };
    for (const world::Prop& p : town().props)
        block(world::in_plan(p.position()),
              p.yaw(),
              is_post(p.kind()) ? 0.15 : p.length(),
              is_post(p.kind()) ? 0.15 : p.width());
    for (const world::SignalHeadT& head : town().heads)
        block(world::in_plan(head.foot), 0, 0.2, 0.2);
    for (const world::Tree& tree : town().trees)
        block(world::in_plan(tree.position()), 0, 0.6, 0.6);

    for (const LaneT& lane : town().lanes) {
        if (lane.kind != LaneKind::sidewalk || lane.width < 1.9)
            continue;
        // At its ends it widens to a walking area.
        for (double s = 1; s < lane.length - 1; s += 0.5) {
            const world::LanePoint at = world::point_at(lane, s);
            const auto near = cells.find(cell(at.position.head<2>()));
            if (near == cells.end())
                continue;
            double run = 0;
            double widest = 0;
            for (double t = -lane.width / 2; t <= lane.width / 2; t += 0.05) {
                const Vector2d p =
                    at.position.head<2>() + Vector2d(-std::sin(at.yaw), std::cos(at.yaw)) * t;
                const bool taken =
                    std::any_of(near->second.begin(), near->second.end(), [&](const Blocked& b) {
                        return (p - b.middle).norm() < b.radius && world::contains(b.loop, p);
                    });
                run = taken ? 0 : run + 0.05;
                widest = std::max(widest, run);
            }
            EXPECT_GE(widest, 1.1) << lane.name << " at " << s;
        }
    }
}

TEST_P(AnyScenery, BuildingsStandClearOfRoadsAndOfEachOther) {
    const Lanes roads(town(), any_road);
    std::map<std::pair<int, int>, std::vector<std::size_t>> cells;
    const auto cell = [](const world::Building& b, int x, int y) {
        return std::pair{static_cast<int>(std::floor(b.centre().x() / 50)) + x,
                         static_cast<int>(std::floor(b.centre().y() / 50)) + y};
    };
    for (std::size_t i = 0; i < town().buildings.size(); ++i)
        cells[cell(town().buildings[i], 0, 0)].push_back(i);
    for (std::size_t i = 0; i < town().buildings.size(); ++i) {
        const world::Building& one = town().buildings[i];
        for (const Vector2d& p : points_of(one, 1.5)) {
            ASSERT_GE(roads.border_distance(p), 0.39) << i;
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (const std::size_t k : cells[cell(one, x, y)]) {
                        const world::Building& b = town().buildings[k];
                        const Loop loop =
                            corners({world::in_plan(b.centre()), b.yaw(), b.length(), b.width()});
                        ASSERT_TRUE(k == i || !world::contains(loop, p)) << i << " and " << k;
                    }
        }
    }
}

TEST_P(AnyScenery, FrontsFaceTheStreet) {
    const Lanes roads(town(), any_road);
    int along_streets = 0;
    int facing = 0;
    for (const world::Building& b : town().buildings) {
        const Vector2d to_back = Vector2d(-std::sin(b.yaw()), std::cos(b.yaw())) * (b.width() / 2);
        const double front = roads.border_distance(world::in_plan(b.centre()) - to_back);
        const double back = roads.border_distance(world::in_plan(b.centre()) + to_back);
        if (std::min(front, back) > 9)
            continue;
        ++along_streets;
        facing += front < back + 0.5 ? 1 : 0;
    }
    // A few stand between two streets and are nearer to the one behind.
    EXPECT_GE(facing, 0.93 * along_streets);
    EXPECT_GT(along_streets, 0);
}

TEST_P(AnyScenery, SightTrianglesOfUnlitJunctionsAreFree) {
    for (const LaneT& lane : town().lanes) {
        const bool yields = std::any_of(lane.links.begin(),
                                        lane.links.end(),
                                        [](const world::Link& link) { return link.yields(); });
        if (lane.kind != LaneKind::driving || lane.junction == world::none || !yields ||
            town().junctions[lane.junction].lit)
            continue;
        const world::LanePoint end = world::point_at(lane, lane.length);
        const Vector2d kerb =
            end.position.head<2>() + Vector2d(-std::sin(end.yaw), std::cos(end.yaw)) *
                                         ((town().left_hand ? 0.5 : -0.5) * lane.width);
        const auto stands_off = [&](const Loop& points) {
            return std::all_of(points.begin(), points.end(), [&](const Vector2d& p) {
                return (p - kerb).norm() >= 8 - 1e-6;
            });
        };
        for (const world::Building& b : town().buildings)
            if ((world::in_plan(b.centre()) - kerb).norm() < 40) {
                ASSERT_TRUE(stands_off(points_of(b))) << lane.name;
            }
        for (const world::Prop& prop : town().props)
            if (!is_post(prop.kind()) && prop.height() > 1) {
                ASSERT_TRUE(stands_off(foot_of(prop))) << lane.name;
            }
        for (const world::Tree& tree : town().trees)
            if (tree.height() > 1) {
                ASSERT_TRUE(stands_off({world::in_plan(tree.position())})) << lane.name;
            }
    }
}

TEST_P(AnyScenery, SpawnPointsLieOnTheirLanesAwayFromJunctions) {
    const auto& all = town().spawn_points;
    ASSERT_FALSE(all.empty());
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const auto& p, const auto& q) {
        return std::tuple(p.for_walkers(), p.lane(), p.s()) <
               std::tuple(q.for_walkers(), q.lane(), q.s());
    }));
    for (const world::SpawnPoint& point : all) {
        const LaneT& lane = town().lanes[point.lane()];
        EXPECT_EQ(lane.kind, point.for_walkers() ? LaneKind::sidewalk : LaneKind::driving);
        const world::LaneProjection on = world::project(
            lane, {point.position().x(), point.position().y(), point.position().z()});
        EXPECT_LT(std::abs(on.t), point.for_walkers() ? lane.width / 2 - 0.2 : 0.01);
        if (!point.for_walkers()) {
            EXPECT_GE(point.s(), 12);
            EXPECT_LE(point.s(), lane.length - 15);
        }
    }
}

TEST(Scenery, Town1IsATown) {
    const TownT& town = test::own_town("town1").town;
    EXPECT_GE(town.buildings.size(), 150U);
    EXPECT_LE(town.buildings.size(), 500U);
    std::set<std::uint32_t> models;
    for (const world::Building& building : town.buildings) {
        ASSERT_GE(building.model(), 1U);
        ASSERT_LE(building.model(), world::building_models().size());
        models.insert(building.model());
    }
    EXPECT_GE(models.size(), 20U);
    std::set<world::PlantKind> plants;
    for (const world::Tree& tree : town.trees)
        plants.insert(tree.kind());
    EXPECT_GE(plants.size(), 8U);
    std::set<PropKind> props;
    for (const world::Prop& prop : town.props)
        props.insert(prop.kind());
    EXPECT_GE(props.size(), 12U);
}

TEST(Scenery, AnotherNameBuildsAnotherTown) {
    Network renamed = test::own_town("town2").network;
    renamed.name = "elsewhere";
    EXPECT_NE(read_town(renamed).buildings, test::own_town("town2").town.buildings);
}

}  // namespace
}  // namespace reprise::traffic
