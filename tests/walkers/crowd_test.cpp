#include "walkers/crowd.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"
#include "ground/obstacles.h"
#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "world/digest.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/units.h"

namespace reprise::walkers {
namespace {

constexpr double tick_seconds = 0.05;
constexpr std::uint64_t green_ticks = 200;  // as Town 1's lights: 10 s of 50 s

/// A crowd alone in a town of ours, under lights that change by the clock, without cars.
class Scene {
  public:
    explicit Scene(unsigned walkers, double jaywalkers = 0.1, std::uint64_t seed = 3)
        : Scene(test::own_town("town1").town, ground(), walkers, jaywalkers, seed) {}

    /// Both must outlive it.
    Scene(const world::TownT& town,
          WalkingGround& on,
          unsigned walkers,
          double jaywalkers,
          std::uint64_t seed)
        : town_(town),
          lanes_(town_) {
        episode.walkers = walkers;
        episode.walker_seed = seed;
        episode.jaywalkers = jaywalkers;
        crowd_.emplace(episode, town_, lanes_, on);
    }

    /// Made once: it is a function of the town.
    static WalkingGround& ground() {
        static WalkingGround made(test::own_town("town1").town);
        return made;
    }

    const std::vector<world::WalkerState>& step(const std::vector<world::EventT>& happened = {}) {
        next.tick.events.insert(next.tick.events.end(), happened.begin(), happened.end());
        next.tick.props = props;
        last_.emplace(world::seal(next, {}));
        OnFoot on_foot{next.tick.index + 1, {}, {}};
        crowd_->advance(last_->view(), on_foot);
        next = {};
        next.tick.index = on_foot.tick;
        next.tick.events = std::move(on_foot.events);
        next.traffic.walkers = std::move(on_foot.walkers);
        next.traffic.cars = cars;
        for (const world::SignalT& signal : town_.signals) {
            const std::uint64_t place = (next.tick.index + signal.index * 350) % 1000;
            next.tick.signals.push_back(place < green_ticks ? world::SignalColor::green
                                                            : world::SignalColor::red);
        }
        return next.traffic.walkers;
    }

    std::uint64_t digest() const {
        world::Hasher hasher;
        crowd_->add_to(hasher);
        return hasher.digest64();
    }

    bool jaywalks(std::uint32_t id) const {
        return draw_person(episode.walker_seed, id, episode.jaywalkers).jaywalks;
    }

    const world::TownT& town() const { return town_; }

    const world::LaneMap& lanes() const { return lanes_; }

  private:
    const world::TownT& town_;
    world::LaneMap lanes_;
    std::optional<world::SealedTick> last_;
    std::optional<Crowd> crowd_;

  public:
    world::EpisodeT episode = test::episode();
    world::TickDraft next;
    std::vector<world::PropState> props;  ///< that stand there
    std::vector<world::CarState> cars;    ///< where traffic has them by the end of a step
};

Eigen::Vector3d place_of(const world::WalkerState& walker) {
    return world::to_eigen(walker.position());
}

/// Nobody's middle is in what stands there.
bool is_inside(const world::Obstacle& obstacle, const Eigen::Vector3d& p) {
    const Eigen::Vector2d gap = (p - obstacle.position).head<2>();
    const double top = obstacle.position.z() + 2 * obstacle.half.z() - obstacle.depth;
    if (p.z() > top || p.z() < obstacle.position.z() - 1)
        return false;
    if (obstacle.shape == world::Obstacle::Shape::cylinder)
        return gap.norm() < obstacle.half.x();
    const Eigen::Vector2d ahead = world::ahead_of(obstacle.yaw);
    return std::abs(gap.dot(ahead)) < obstacle.half.x() &&
           std::abs(world::cross(ahead, gap)) < obstacle.half.y();
}

/// `beyond` its ends, `within` its sides. [m]
bool is_on(const world::LaneT& crossing, const Eigen::Vector3d& p, double beyond, double within) {
    const Eigen::Vector2d from = world::in_plan(crossing.centre.front());
    const Eigen::Vector2d way = world::in_plan(crossing.centre.back()) - from;
    const Eigen::Vector2d ahead = way.normalized();
    const double along = ahead.dot(p.head<2>() - from);
    return along > -beyond && along < way.norm() + beyond &&
           std::abs(world::cross(ahead, p.head<2>() - from)) < crossing.width / 2 - within;
}

/// On one, or in the gap between its end and the sidewalk's round corner.
bool is_at_a_crossing(const world::TownT& town, const Eigen::Vector3d& p) {
    return std::any_of(town.lanes.begin(), town.lanes.end(), [&](const world::LaneT& lane) {
        return lane.kind == world::LaneKind::crossing && is_on(lane, p, 0.5, 0);
    });
}

TEST(Crowd, KeepsToTheRulesForTwoMinutes) {
    Scene scene(100);
    const ground::GroundMesh mesh = ground::build_ground(scene.town());
    const ground::GroundProbe probe(mesh);
    const std::vector<world::Obstacle> obstacles = ground::obstacles_of(scene.town());
    std::map<std::uint32_t, world::WalkerState> before;
    std::map<std::uint32_t, std::set<std::uint32_t>> crossings;  // that somebody is on
    int off_pavement = 0;
    int inside = 0;
    int at_red = 0;
    int overlaps = 0;
    int jumps = 0;
    int on_crossings = 0;
    double walked = 0;
    std::uint64_t walking = 0;
    std::vector<std::vector<world::SignalColor>> colors;
    for (int tick = 1; tick <= 2400; ++tick) {
        const auto& all = scene.step();
        colors.push_back(scene.next.tick.signals);
        ASSERT_EQ(all.size(), 100U);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const world::WalkerState& walker = all[i];
            const Eigen::Vector3d p = place_of(walker);
            // Where he may be. Once a second is enough to see it.
            if (tick % 20 == 0) {
                const auto below = probe.below(p + Eigen::Vector3d(0, 0, 0.5));
                ASSERT_TRUE(below);
                EXPECT_NEAR(below->z, p.z(), 0.02);
                if (!scene.jaywalks(walker.id()))
                    off_pavement += below->surface != ground::Surface::sidewalk &&
                                    scene.lanes().walkable_at(p).empty() &&
                                    !is_at_a_crossing(scene.town(), p);
                for (const world::Obstacle& obstacle : obstacles)
                    inside += is_inside(obstacle, p);
            }
            // Crossings with lights: stepped onto at green, or at most a second behind it.
            std::set<std::uint32_t> now;
            for (const auto& found : scene.lanes().walkable_at(p))
                if (scene.town().lanes[found.lane].kind == world::LaneKind::crossing &&
                    is_on(scene.town().lanes[found.lane], p, -0.1, 0.1))
                    now.insert(found.lane);
            bool stepped = false;
            bool lit = false;
            bool was_green = false;  // one of them: at corners they overlap
            for (const std::uint32_t lane : now) {
                stepped = stepped || (tick > 1 && !crossings[walker.id()].contains(lane));
                for (std::size_t s = 0; s < scene.town().signals.size(); ++s) {
                    const world::SignalT& signal = scene.town().signals[s];
                    if (signal.lane != lane || !signal.for_walkers)
                        continue;
                    lit = true;
                    for (std::size_t back = 0; back < 20 && back < colors.size(); ++back)
                        was_green = was_green || colors[colors.size() - 1 - back][s] ==
                                                     world::SignalColor::green;
                }
            }
            if (stepped && crossings[walker.id()].empty()) {
                ++on_crossings;
                at_red += lit && !was_green;
            }
            crossings[walker.id()] = std::move(now);
            // Others.
            for (std::size_t other = i + 1; other < all.size(); ++other) {
                const double room = (world::walker_models()[walker.model()].shoulder_width +
                                     world::walker_models()[all[other].model()].shoulder_width) /
                                    2;
                overlaps += (place_of(all[other]) - p).head<2>().norm() < room - 0.005;
            }
            // Himself before.
            if (const auto was = before.find(walker.id()); was != before.end()) {
                const double way = (p - place_of(was->second)).head<2>().norm();
                const double speed = static_cast<double>(walker.speed());
                jumps += way > speed * tick_seconds + 0.05;
                walked += way;
                walking += speed > 0.1;
            }
            before[walker.id()] = walker;
        }
    }
    EXPECT_EQ(off_pavement, 0);
    EXPECT_EQ(inside, 0);
    EXPECT_EQ(at_red, 0);
    EXPECT_EQ(overlaps, 0);
    EXPECT_EQ(jumps, 0);
    EXPECT_GT(on_crossings, 80) << "it is no proof where nobody crosses";
    EXPECT_GT(walked / (static_cast<double>(walking) * tick_seconds), 0.8) << "of those who walk";
    EXPECT_GT(static_cast<double>(walking), 0.6 * 100 * 2400) << "most are on their way";
}

/// Cars wait for who is there: nobody may stay for good.
TEST(Crowd, NobodyStandsOnACrossingForLong) {
    constexpr int patience = 320;  // [ticks]

    struct Seen {
        Eigen::Vector3d place;
        int tick = 0;
    };

    for (const std::uint64_t seed : {3U, 4U, 11U}) {
        Scene scene(100, 0.1, seed);
        std::map<std::uint32_t, Seen> seen;
        for (int tick = 1; tick <= 2400; ++tick)
            for (const world::WalkerState& walker : scene.step()) {
                const Eigen::Vector3d place = place_of(walker);
                const auto [known, is_new] = seen.try_emplace(walker.id(), Seen{place, tick});
                const auto& lanes = scene.town().lanes;
                const bool on_road = std::any_of(lanes.begin(), lanes.end(), [&](const auto& lane) {
                    return lane.kind == world::LaneKind::crossing && is_on(lane, place, -1, 0);
                });
                if (!on_road || (place - known->second.place).norm() > 1)
                    known->second = {place, tick};
                ASSERT_LT(tick - known->second.tick, patience)
                    << walker.id() << " of seed " << seed << " in tick " << tick;
            }
    }
}

/// The longest wait at the lights here is 40 s. Two who walk together may be parted, by a light or
/// as one of them changes his mind: who is there first does not stand until the other comes across
/// the town.
TEST(Crowd, NobodyStandsForMinutes) {
    constexpr int patience = 1300;  // [ticks]

    struct Seen {
        Eigen::Vector3d place;
        int tick = 0;
    };

    for (const std::uint64_t seed : {2U, 4U, 7U}) {
        Scene scene(100, 0.1, seed);
        std::map<std::uint32_t, Seen> seen;
        int longest = 0;
        for (int tick = 1; tick <= 12000; ++tick)
            for (const world::WalkerState& walker : scene.step()) {
                const auto [known, is_new] =
                    seen.try_emplace(walker.id(), Seen{place_of(walker), tick});
                if ((place_of(walker) - known->second.place).norm() > 0.5)
                    known->second = {place_of(walker), tick};
                longest = std::max(longest, tick - known->second.tick);
            }
        EXPECT_LT(longest, patience) << "seed " << seed;
    }
}

TEST(Crowd, LosesNobodyInTwoMinutes) {
    Scene scene(150);
    for (int i = 0; i < 2400; ++i) {
        scene.step();
        for (const world::EventT& event : scene.next.tick.events)
            EXPECT_NE(event.kind, world::EventKind::despawned)
                << "walker " << event.actor << " in tick " << scene.next.tick.index << " at "
                << event.position.x() << ", " << event.position.y();
    }
}

TEST(Crowd, GoesAroundWhatStandsOnThePavement) {
    Scene scene(60);
    const auto crate = world::find_prop_model("crate");
    ASSERT_TRUE(crate);
    const world::PropModel& model = world::prop_models()[*crate];
    std::uint32_t id = 10;
    for (const world::LaneT& lane : scene.town().lanes) {
        if (lane.kind != world::LaneKind::sidewalk || lane.length < 20)
            continue;
        const world::LanePoint at = world::point_at(lane, lane.length / 2);
        scene.props.emplace_back(world::to_vec3(at.position),
                                 world::Quat(1, 0, 0, 0),
                                 world::Vec3(0, 0, 0),
                                 world::Vec3(0, 0, 0),
                                 id++,
                                 *crate,
                                 std::uint16_t{0});
    }
    ASSERT_GT(scene.props.size(), 20U);
    int inside = 0;
    int beside = 0;
    for (int tick = 1; tick <= 1200; ++tick)
        for (const world::WalkerState& walker : scene.step())
            for (const world::PropState& prop : scene.props) {
                const Eigen::Vector2d gap =
                    world::in_plan(walker.position()) - world::in_plan(prop.position());
                // Whoever appears in the first tick may do so anywhere.
                inside += tick > 100 && std::abs(gap.x()) < model.length / 2 &&
                          std::abs(gap.y()) < model.width / 2;
                beside += gap.norm() < 2;
            }
    EXPECT_EQ(inside, 0);
    EXPECT_GT(beside, 500) << "it is no proof where nobody passes";
}

/// The map's edge comes within a hand's breadth of a pole: its outline may be a cell off.
TEST(Crowd, KeepsItsShouldersOffPolesOnThePavement) {
    world::TownT town = test::own_town("town1").town;
    std::vector<world::Obstacle> poles;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::sidewalk)
            continue;
        for (double s = 5; s < lane.length - 5; s += 7.33) {
            const world::LanePoint at = world::point_at(lane, s);
            const double left = 0.31 * (static_cast<double>(town.props.size() % 5) - 2);
            Eigen::Vector3d place = at.position;
            place.head<2>() += left * world::left_of(at.yaw);
            town.props.emplace_back(world::to_vec3(place),
                                    0.0,
                                    0.2,
                                    0.2,
                                    3.0,
                                    0U,
                                    std::uint16_t{0},
                                    world::PropKind::pole,
                                    std::uint8_t{0});
        }
    }
    for (const world::Obstacle& obstacle : ground::obstacles_of(town))
        if (obstacle.shape == world::Obstacle::Shape::cylinder && obstacle.radius < 0.2)
            poles.push_back(obstacle);
    WalkingGround ground(town);
    Scene scene(town, ground, 200, 0.1, 5);
    int touched = 0;
    int beside = 0;
    for (int tick = 1; tick <= 2400; ++tick)
        for (const world::WalkerState& walker : scene.step()) {
            const double radius = world::walker_models()[walker.model()].shoulder_width / 2;
            const Eigen::Vector2d p = world::in_plan(walker.position());
            auto pole = std::lower_bound(
                poles.begin(), poles.end(), p.x() - 1, [](const world::Obstacle& one, double x) {
                    return one.position.x() < x;
                });
            for (; pole != poles.end() && pole->position.x() < p.x() + 1; ++pole) {
                const double gap = (pole->position.head<2>() - p).norm() - pole->radius - radius;
                touched += tick > 100 && gap < 0;
                beside += gap < 0.3;
            }
        }
    EXPECT_EQ(touched, 0);
    EXPECT_GT(beside, 500) << "it is no proof where nobody passes";
}

/// [m] of somebody's middle from a vehicle's side; far for who is not level with it, or only with
/// its bow, before which there may be no room to get away.
double distance_from_side(const world::WalkerState& walker, const world::CarState& vehicle) {
    constexpr double bow = 1.5;  // [m]
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const Eigen::Vector2d gap =
        world::in_plan(walker.position()) - world::in_plan(vehicle.position());
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(vehicle.yaw()));
    const double along = gap.dot(ahead);
    if (along < -model.rear_overhang || along > model.length - model.rear_overhang - bow)
        return world::infinity;
    return std::abs(world::cross(ahead, gap)) - model.width / 2;
}

/// A bus's tail comes over the kerb while it turns, as here a whole bus does that rolls along it.
TEST(Crowd, NobodyWalksIntoWhatRollsOverTheKerb) {
    Scene scene(200);
    constexpr double speed = 1.2;
    const auto model = *world::find_vehicle_model("bus");
    int inside = 0;
    int beside = 0;
    for (int tick = 1; tick <= 1600; ++tick) {
        scene.cars.clear();
        std::uint32_t id = 10;
        for (const world::LaneT& lane : scene.town().lanes) {
            if (lane.kind != world::LaneKind::sidewalk || lane.length < 40)
                continue;
            const double s = 4 + tick * tick_seconds * speed;
            if (s > lane.length - 12)
                continue;
            const world::LanePoint at = world::point_at(lane, s);
            const Eigen::Vector2d p = at.position.head<2>() + 2.1 * world::left_of(at.yaw);
            world::CarState car = test::car_at(id++, p.x(), p.y(), at.yaw, speed);
            car.mutate_model(model);
            scene.cars.push_back(car);
        }
        for (const world::WalkerState& walker : scene.step())
            for (const world::CarState& car : scene.cars) {
                const double across = distance_from_side(walker, car);
                inside += tick > 100 && across < 0.1;
                beside += across < 1.5;
            }
    }
    EXPECT_LT(inside, 6) << "27 ticks for who walks back to where he was once he is out of reach";
    EXPECT_GT(beside, 500) << "it is no proof where nobody passes";
}

/// A bus swings out over a pavement's end, as far as leaves room behind those who stand beside it:
/// where somebody stands in the corner there, he lets them out.
TEST(Crowd, WhoStandsInACornerBehindSomebodyLetsHimOut) {
    constexpr double speed = 0.6;
    constexpr double round = 20;  // [s] then another bus comes
    const auto model = *world::find_vehicle_model("bus");
    int inside = 0;
    int beside = 0;
    for (const std::uint64_t seed : {4U, 6U, 9U}) {
        Scene scene(test::own_town("town1").town, Scene::ground(), 600, 0.1, seed);
        for (int tick = 1; tick <= 1200; ++tick) {
            const double time = std::fmod(tick * tick_seconds, round);
            scene.cars.clear();
            std::uint32_t id = 10;
            for (const world::LaneT& lane : scene.town().lanes) {
                if (lane.kind != world::LaneKind::sidewalk || lane.length < 30)
                    continue;
                const world::LanePoint at = world::point_at(lane, lane.length - 15);
                const double left = std::max(1.65, 2.6 - 0.08 * time);
                const Eigen::Vector2d p = at.position.head<2>() + left * world::left_of(at.yaw) +
                                          speed * (time - 6) * world::ahead_of(at.yaw);
                world::CarState car = test::car_at(id++, p.x(), p.y(), at.yaw, speed);
                car.mutate_model(model);
                scene.cars.push_back(car);
            }
            const bool has_come = time > 5;
            for (const world::WalkerState& walker : scene.step())
                for (const world::CarState& car : scene.cars) {
                    const double across = distance_from_side(walker, car);
                    inside += has_come && across < 0.18;
                    beside += has_come && across < 1.5;
                }
        }
    }
    EXPECT_EQ(inside, 0) << "ticks";
    EXPECT_GT(beside, 500) << "it is no proof where nobody passes";
}

/// A car that has stopped on a crossing, to turn over the corner where they wait, waits for them.
TEST(Crowd, WhoWaitsBesideACarThatStandsInAJunctionStepsBack) {
    constexpr double gap = 0.3;  // [m] from the kerb to its flank
    Scene scene(300);
    const auto& lanes = scene.town().lanes;
    const auto internal =
        static_cast<std::uint32_t>(std::find_if(lanes.begin(),
                                                lanes.end(),
                                                [](const world::LaneT& lane) {
                                                    return lane.kind == world::LaneKind::internal;
                                                }) -
                                   lanes.begin());
    std::uint32_t id = 10;
    for (const world::LaneT& lane : lanes) {
        if (lane.kind != world::LaneKind::crossing)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[0];
        const Eigen::Vector2d end = world::in_plan(lane.centre.front());
        const Eigen::Vector2d over = (world::in_plan(lane.centre.back()) - end).normalized();
        const Eigen::Vector2d ahead = world::turned_left(over);
        const Eigen::Vector2d p =
            end + (gap + model.width / 2) * over - (model.length / 2 - model.rear_overhang) * ahead;
        scene.cars.push_back(test::car_at(id++, p.x(), p.y(), std::atan2(ahead.y(), ahead.x())));
        scene.cars.back().mutate_lane(internal);
    }
    std::map<std::uint32_t, int> beside;  // [ticks] by id
    int waited = 0;
    for (int tick = 1; tick <= 2000; ++tick)
        for (const world::WalkerState& walker : scene.step())
            for (const world::CarState& car : scene.cars) {
                const double across = distance_from_side(walker, car);
                waited += across > 1 && across < 1.6 && walker.speed() < 0.1F;
                if (across > 0.25 && across < 0.8 && walker.speed() < 0.1F)
                    ++beside[walker.id()];
            }
    const auto most =
        std::max_element(beside.begin(), beside.end(), [](const auto& one, const auto& other) {
            return one.second < other.second;
        });
    ASSERT_NE(most, beside.end());
    EXPECT_LT(most->second, 500) << "of 2,000 ticks; without it 1,817";
    EXPECT_GT(waited, 10'000) << "it is no proof where nobody waits";
}

/// Before every crossing without lights, on the lane that leads there; without those at lights.
void stop_cars_at_crossings(Scene& scene) {
    const world::TownT& town = scene.town();
    const WalkerLights lights(town);
    const RoadTraffic traffic(town, scene.lanes());
    const world::VehicleModel& model = world::vehicle_models()[0];
    std::uint32_t id = 10;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& crossing = town.lanes[i];
        if (crossing.kind != world::LaneKind::crossing || !lights.of_crossing(i).empty())
            continue;
        for (const Conflict& conflict : traffic.conflicts(world::to_eigen(crossing.centre.front()),
                                                          world::to_eigen(crossing.centre.back())))
            for (const auto& [index, distance] : conflict.approaches) {
                const world::LaneT& lane = town.lanes[index];
                const double s = std::min(lane.length - 0.5, distance - 3);
                if (lane.kind != world::LaneKind::driving || distance - s > 6 ||
                    std::any_of(lane.links.begin(), lane.links.end(), [](const auto& link) {
                        return link.signal() != world::none;
                    }))
                    continue;
                const world::LanePoint at = world::point_at(lane, s);
                const Eigen::Vector2d p =
                    at.position.head<2>() -
                    (model.length - model.rear_overhang) * world::ahead_of(at.yaw);
                scene.cars.push_back(test::car_at(id++, p.x(), p.y(), at.yaw));
                scene.cars.back().mutate_lane(index);
                scene.cars.back().mutate_lane_s(static_cast<float>(s));
            }
    }
}

/// At a crossing that people keep coming to a queue of cars would never get over it.
TEST(Crowd, WhoComesToACrossingLetsOneGoWhoHasStoodThereForLong) {
    constexpr int for_long = 300;  // ticks
    Scene scene(300);
    stop_cars_at_crossings(scene);
    ASSERT_GT(scene.cars.size(), 10U);
    const WalkerLights lights(scene.town());
    std::vector<const world::LaneT*> unlit;
    for (std::uint32_t i = 0; i < scene.town().lanes.size(); ++i)
        if (scene.town().lanes[i].kind == world::LaneKind::crossing &&
            lights.of_crossing(i).empty())
            unlit.push_back(&scene.town().lanes[i]);
    std::map<std::uint32_t, int> stood;  // [ticks] by id
    int early = 0;                       // ticks
    int waited = 0;
    int longest = 0;
    for (int tick = 1; tick <= 2400; ++tick)
        for (const world::WalkerState& walker : scene.step()) {
            const Eigen::Vector3d p = place_of(walker);
            const bool waits =
                walker.speed() < 0.1F &&
                std::any_of(unlit.begin(), unlit.end(), [&](const world::LaneT* crossing) {
                    return is_on(*crossing, p, 1, -0.5) && !is_on(*crossing, p, -1, 0);
                });
            int& ticks = stood[walker.id()];
            ticks = waits ? ticks + 1 : 0;
            (tick < for_long ? early : waited) += waits;
            longest = std::max(longest, ticks);
        }
    EXPECT_EQ(early, 0);
    EXPECT_GT(waited, 8'000) << "ticks of all; without it 1,627";
    EXPECT_LT(longest, 220) << "who does not go is not waited for";
}

TEST(Crowd, IsTheSameForTheSameSeedAndAnotherForAnother) {
    Scene one(60);
    Scene same(60);
    Scene other(60, 0.1, 4);
    for (int tick = 0; tick < 300; ++tick) {
        one.step();
        same.step();
        other.step();
        ASSERT_EQ(one.digest(), same.digest()) << "tick " << tick;
        ASSERT_NE(one.digest(), other.digest());
    }
    EXPECT_EQ(one.next.traffic.walkers, same.next.traffic.walkers);
}

TEST(Crowd, WhoIsHitLiesIsTakenAwayAndReplacedElsewhere) {
    Scene scene(20);
    scene.step();
    const world::WalkerState victim = scene.next.traffic.walkers[7];
    world::EventT hit;
    hit.kind = world::EventKind::collision;
    hit.actor = 1;
    hit.other = victim.id();
    scene.step({hit});
    EXPECT_TRUE(scene.next.traffic.walkers[7].down());
    const Eigen::Vector3d where = place_of(scene.next.traffic.walkers[7]);
    int lay = 0;
    bool gone = false;
    for (int tick = 0; tick < 260 && !gone; ++tick) {
        scene.step();
        const auto& all = scene.next.traffic.walkers;
        EXPECT_EQ(all.size(), 20U);
        const world::WalkerState* found = world::find(all, victim.id());
        gone = found == nullptr;
        if (gone)
            break;
        ++lay;
        EXPECT_TRUE(found->down());
        EXPECT_EQ(place_of(*found), where);
    }
    ASSERT_TRUE(gone);
    EXPECT_GE(lay * tick_seconds, 4.9);
    EXPECT_LE(lay * tick_seconds, 10.1);
    const world::WalkerState& fresh = scene.next.traffic.walkers.back();
    EXPECT_EQ(fresh.id(), first_walker_id + 20);
    EXPECT_FALSE(fresh.down());
    std::vector<world::EventKind> kinds;
    for (const world::EventT& event : scene.next.tick.events)
        kinds.push_back(event.kind);
    EXPECT_EQ(kinds, (std::vector{world::EventKind::despawned, world::EventKind::spawned}));
}

TEST(Crowd, JaywalkersCrossWhereThereIsNoCrossing) {
    Scene scene(40, 1);
    const ground::GroundMesh mesh = ground::build_ground(scene.town());
    const ground::GroundProbe probe(mesh);
    int on_road = 0;
    for (int tick = 1; tick <= 1200; ++tick)
        for (const world::WalkerState& walker : scene.step())
            if (tick % 20 == 0) {
                const auto below = probe.below(place_of(walker) + Eigen::Vector3d(0, 0, 0.5));
                on_road += below && below->surface == ground::Surface::road;
            }
    EXPECT_GT(on_road, 10);
}

TEST(Crowd, SaysHowManyATownHasRoomFor) {
    const world::TownT nothing = [] {
        world::TownT town = test::straight_road();
        for (world::LaneT& lane : town.lanes)
            if (lane.kind == world::LaneKind::sidewalk)
                lane.kind = world::LaneKind::other;
        return town;
    }();
    const world::LaneMap lanes(nothing);
    WalkingGround ground(nothing);
    world::EpisodeT episode = test::episode();
    episode.walkers = 5;
    Crowd crowd(episode, nothing, lanes, ground);
    const world::SealedTick last = test::tick_with({}, {}, {}, 0);
    OnFoot next{1, {}, {}};
    crowd.advance(last.view(), next);
    EXPECT_TRUE(next.walkers.empty());
    ASSERT_EQ(next.events.size(), 1U);
    EXPECT_EQ(next.events[0].text,
              "walkers: 5 were asked for, " + nothing.name + " has room for 0");
}

}  // namespace
}  // namespace reprise::walkers
