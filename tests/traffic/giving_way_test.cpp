#include "traffic/sight/giving_way.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"
#include "traffic/sight/way_ahead.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using test::spawn;
using test::Stage;
using test::vehicle_on;
using world::CommandKind;
using world::none;

constexpr std::uint32_t comer_id = 1;
constexpr std::uint32_t turner_id = 2;

BodyBox body(std::uint16_t model_index, const world::Vec3& position, const Eigen::Vector2d& ahead) {
    const world::VehicleModel& model = world::vehicle_models()[model_index];
    return {world::in_plan(position) + (model.length / 2 - model.rear_overhang) * ahead,
            ahead,
            model.length / 2,
            model.width / 2};
}

/// A lane from which one turns left, and waits inside for who comes towards it on another.
struct LeftTurn {
    std::uint32_t from = none;
    std::uint32_t to = none;
    std::uint32_t oncoming = none;
    std::uint32_t straight = none;  ///< the oncoming one's lane inside
};

std::vector<LeftTurn> left_turns(const world::TownT& town) {
    std::vector<LeftTurn> turns;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        for (const world::Link& link : town.lanes[i].links) {
            if (link.turn() != world::Turn::left || link.via() == none || town.lanes[i].length < 40)
                continue;
            const world::LaneT& inside = town.lanes[link.via()];
            if (inside.links.empty() || inside.links.front().via() == none)
                continue;
            for (std::uint32_t k = 0; k < town.lanes.size(); ++k)
                for (const world::Link& other : town.lanes[k].links) {
                    const double towards =
                        world::ahead_of(world::point_at(town.lanes[k], town.lanes[k].length).yaw)
                            .dot(world::ahead_of(
                                world::point_at(town.lanes[i], town.lanes[i].length).yaw));
                    if (other.turn() == world::Turn::straight && other.via() != none &&
                        town.lanes[other.via()].junction == inside.junction && towards < -0.9 &&
                        town.lanes[k].length > 60)
                        turns.push_back({i, link.to(), k, other.via()});
                }
        }
    return turns;
}

/// One that drives on along the lanes of a way, whatever is there.
class Comer {
  public:
    Comer(const world::TownT& town, const LeftTurn& turn, double before, double speed)
        : town_(&town),
          turn_(turn),
          lane_(turn.oncoming),
          s_(town.lanes[turn.oncoming].length - before),
          speed_(speed) {}

    /// With its left lamp on; nothing once it has left the junction.
    std::vector<world::VehicleState> next() {
        if (lane_ == none)
            return {};
        world::VehicleState state = vehicle_on(town_->lanes[lane_], comer_id, s_, speed_);
        state.mutate_lamps(world::lamp_left);
        s_ += speed_ * 0.05;
        while (lane_ != none && s_ > town_->lanes[lane_].length)
            go_on();
        return {state};
    }

  private:
    void go_on() {
        s_ -= town_->lanes[lane_].length;
        const auto& links = town_->lanes[lane_].links;
        if (lane_ == turn_.oncoming)
            lane_ = turn_.straight;
        else
            lane_ = links.front().via();
    }

    const world::TownT* town_;
    LeftTurn turn_;
    std::uint32_t lane_;
    double s_;      ///< [m]
    double speed_;  ///< [m/s]
};

bool touch(const world::CarState& car, const world::VehicleState& vehicle) {
    const world::Quat& q = vehicle.orientation();
    return overlap(
        body(car.model(), car.position(), world::ahead_of(static_cast<double>(car.yaw()))),
        body(vehicle.model(), vehicle.position(), world::ahead_of(2 * std::atan2(q.z(), q.w()))));
}

/// SUMO believes the lamp, and lets who comes for the turn that it shows.
TEST(GivingWay, WhoTurnsLeftWaitsForWhoDrivesStraightOnWithItsLampOn) {
    int waited = 0;
    int crossed_first = 0;
    for (const char* name : {"town1", "town2"}) {
        const auto& loaded = own_town(name);
        for (const LeftTurn& turn : left_turns(loaded.town))
            for (const double speed : {8.0, 16.0})
                for (double before = 20; before < 110; before += 10) {
                    const world::LaneT& from = loaded.town.lanes[turn.from];
                    Stage stage(loaded, 0);
                    Comer comer(loaded.town, turn, before, speed);
                    stage.step({spawn(turner_id, turn.from, from.length - 15, 8)});
                    world::CommandT order = test::command(CommandKind::set_route, turner_id);
                    order.lanes = {turn.to};
                    stage.step({order});
                    const auto has_turned = [&] { return stage.car(turner_id)->lane() == turn.to; };
                    bool comes = true;
                    for (int i = 0; i < 1200 && !has_turned(); ++i) {
                        const auto vehicles = comer.next();
                        comes = !vehicles.empty();
                        stage.step({}, vehicles);
                        ASSERT_NE(stage.car(turner_id), nullptr);
                        ASSERT_FALSE(comes && touch(*stage.car(turner_id), vehicles.front()))
                            << name << " " << from.name << ", " << before << " m before at "
                            << speed << " m/s";
                    }
                    ASSERT_TRUE(has_turned()) << name << " " << from.name << " waits for ever";
                    ++(comes ? crossed_first : waited);
                }
    }
    EXPECT_GT(waited, 100);
    EXPECT_GT(crossed_first, 20);
}

}  // namespace
}  // namespace reprise::traffic
